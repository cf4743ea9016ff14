/// How sure it is that so much of what can be seen has been seen: the honest stop.
#pragma once

#include "vantage/core/fields.hpp"

namespace vantage {

/// When exploration is done.
struct StopOptions {
  double share = 0.0;
  double confidence = 0.9;
  void fields(auto&& f) {
    f("share", share,
      "share of what can be seen at all, whose having been seen ends the exploration; higher "
      "explores longer; 0: not asked",
      between(0.0, 1.0));
    f("confidence", confidence,
      "how sure of that the robot must be; higher explores longer and is wrong less often",
      between(0.5, 0.999));
  }
};

/// The share of all that can be seen that is still unseen, by what the candidates are expected to
/// show together: E / (known + E).
double left_share(double expected_cells, double known_cells);

/// How probable it is that not more than `left` of all is unseen, where the expected share is
/// `expected`: the share of decisions in training scenes where the true share was no farther above
/// the expected one.
double confidence_of_left(double expected, double left);

}  // namespace vantage
