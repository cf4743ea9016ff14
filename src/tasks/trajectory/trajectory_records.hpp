/// What the names in the run folder of a flight along a path mean.
#pragma once

#include "vantage/runtime/record_text.hpp"

namespace vantage {

RecordTexts trajectory_records();

}  // namespace vantage
