/// What the names in the run folder of a mapping task mean.
#pragma once

#include "vantage/runtime/record_text.hpp"

namespace vantage {

RecordTexts mapping_records();

}  // namespace vantage
