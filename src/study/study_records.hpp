/// What the names in the folder of a study mean.
#pragma once

#include "vantage/runtime/record_text.hpp"

namespace vantage {

inline constexpr std::string_view kStudyFolder = "study folder";

RecordTexts study_records();

}  // namespace vantage
