/// What studies read of the metrics of mapping tasks.
#pragma once

#include "vantage/runtime/measure.hpp"

namespace vantage {

Measures mapping_measures();

}  // namespace vantage
