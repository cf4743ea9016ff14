/// metrics.json of recognition and of change detection, as the contract has it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "vantage/runtime/metrics.hpp"
#include "vantage/tasks/recognition/object_recognition.hpp"

namespace vantage {

nlohmann::ordered_json recognition_metrics(const ResolvedEpisode& resolved,
                                           const RunSummary& summary, const ObjectRecognition& run);

}  // namespace vantage
