/// Run folders of former versions, brought to what their names mean now: in `scans` of metrics.json
/// and in steps.csv `path_length_m` was the length of the leg to a scan, without a `leg_length_m`,
/// and steps counted from 0; a flight along a path told the mean entropy of all objects alone.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "vantage/report/report_data.hpp"

namespace vantage {

/// metrics.json, json or ordered_json; what is of this version stays as it is.
template <class Json>
void bring_up_to_date(Json& metrics);
extern template void bring_up_to_date(nlohmann::json&);
extern template void bring_up_to_date(nlohmann::ordered_json&);

/// steps.csv.
void bring_up_to_date(CsvTable& steps);

}  // namespace vantage
