/// When a robot is back where it was, and what is made of it.
#pragma once

#include "vantage/core/fields.hpp"

namespace vantage {

struct LoopOptions {
  bool close = true;
  double min_way_m = 12.0;
  double search_m = 10.0;
  double min_agreement = 0.85;
  double agreement_m = 0.06;
  double agreement_rad = 0.02;
  double correct_m = 0.04;
  void fields(auto&& f) {
    f("close", close,
      "true: where the robot is back at a place it mapped long ago, its scans are registered with "
      "that place, and poses and map are corrected over the loop; false: they stay as tracked");
    f("min_way_m", min_way_m,
      "way driven since a place was mapped, below which coming back to it is no loop; higher looks "
      "for fewer loops",
      above(0.0));
    f("search_m", search_m,
      "distance to a place mapped before, within which a loop is looked for, beyond what the pose "
      "may be off; higher looks for more of them",
      above(0.0));
    f("min_agreement", min_agreement,
      "least share of the returns that fall on surfaces of the old place, of those that fall near "
      "it, below which a loop is refused",
      between(0.0, 1.0));
    f("agreement_m", agreement_m,
      "distance within which two loops, found one after the other, must agree on the robot's way "
      "between them; higher takes more false loops for true",
      above(0.0));
    f("agreement_rad", agreement_rad, "the same of the heading", above(0.0));
    f("correct_m", correct_m,
      "distance that the loops must move some pose by, or what is seen from it, before poses and "
      "map are corrected; below it nothing changes",
      above(0.0));
  }
};

}  // namespace vantage
