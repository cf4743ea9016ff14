/// What flights round an object measure: metrics.json as the contract has it, and what studies read
/// of it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

#include "vantage/runtime/measure.hpp"
#include "vantage/tasks/object_flight/object_flight_parts.hpp"
#include "vantage/tasks/object_flight/object_on_table.hpp"

namespace vantage {

/// The last view of a target; null: it was never looked at.
const ObservationRecord* last_view_of(const ObjectFlightParts& run, std::size_t target);

/// What the first target is and what it was taken for at the end.
void add_estimate(const ObjectOnTable& truth, const ObjectFlightParts& run,
                  nlohmann::ordered_json& metrics);
void add_observations(const ObjectFlight& task, const ObjectFlightParts& run,
                      nlohmann::ordered_json& metrics);

/// What a text of the metrics says, or that there is nothing yet.
std::string text_or_nothing(const nlohmann::ordered_json& metrics, const char* key);

// Measures that recognition and change detection share.
extern const ScalarMeasure kCorrect;
extern const ScalarMeasure kViews;
extern const ScalarMeasure kStateEntropy;
extern const ScalarMeasure kMapProbability;
extern const ScalarMeasure kBinError;
extern const ScalarMeasure kViewPositionError;
extern const ScalarMeasure kViewAngleError;
extern const ScalarMeasure kSeenShare;  ///< of what stands among others
extern const CurveMeasure kViewEntropy;

}  // namespace vantage
