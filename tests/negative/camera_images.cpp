// Images that perception gets carry no ids of bodies.
// expected error: no member named .segmentation.
#include "vantage/geometry/range_scan.hpp"

double what_it_learns(const vantage::CameraImages& images) {
#ifdef USE_TRUTH
  return images.segmentation[0];
#else
  return images.depth_m[0];
#endif
}
