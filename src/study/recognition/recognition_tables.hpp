/// Parts of what a study of recognition writes, as Markdown and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "vantage/study/recognition/recognition_study.hpp"

namespace vantage {

/// Whether objects were shown that the model does not know.
bool shows_unknown(const RecognitionStudy& study);
/// Means over the trials, in percent.
nlohmann::ordered_json change_json(const ChangeTrials& change);

}  // namespace vantage
