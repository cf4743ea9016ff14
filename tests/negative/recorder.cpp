// The recorder, which the parts of a task hold, follows the simulated world, known by name alone.
// expected error: incomplete type
#include "vantage/runtime/recorder.hpp"

double what_it_learns(const vantage::EpisodeRecorder& recorder,
                      [[maybe_unused]] const vantage::World& world) {
#ifdef USE_TRUTH
  return world.time_s();
#else
  return recorder.path_length_m();
#endif
}
