/// What the names in the run folder of a flight round an object mean.
#pragma once

#include "vantage/runtime/record_text.hpp"

namespace vantage {

RecordTexts object_flight_records();

}  // namespace vantage
