/// The terms of a flight's cost, drawn.
#pragma once

#include <vector>

#include "vantage/study/figures/figure.hpp"

namespace vantage::bench {

/// c_o, c_v, c_r and c_i of the default options, unweighed, beside their printed forms where these
/// differ: over the distance from an obstacle, the target's bearing, the way out of the object
/// through its view, and the entropy.  [Potthast2016, (5.8) - (5.11)]
std::vector<Figure> cost_figures();

}  // namespace vantage::bench
