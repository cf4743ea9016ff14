/// Calibration on few held-out views, of which all may be right.
#pragma once

#include <cstddef>
#include <span>

#include "vantage/belief/observation/psi_rule.hpp"

namespace vantage {

/// Adds a view that is mistaken for another object: that of median lead, said to be of the object
/// that comes second. As Laplace's rule of succession has it, n right ones are not all there is;
/// without any mistake the most likely psi is infinite.
void add_a_mistake(HeldOutViews& held_out);

/// ln p(its object), whatever its yaw, from a uniform prior, over the first views.
struct LogObject {
  double mean = 0.0;
  double standard_error = 0.0;
};
LogObject log_object(const HeldOutViews& held_out, std::span<const double> psi, std::size_t views);

}  // namespace vantage
