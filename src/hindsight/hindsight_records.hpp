/// What the keys of `bound.json` and `branches.json` mean.
#pragma once

#include "vantage/runtime/record_text.hpp"

namespace vantage {

RecordTexts hindsight_records();

}  // namespace vantage
