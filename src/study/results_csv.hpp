/// The tables of a study, a row an episode.
#pragma once

#include <string>

#include "vantage/study/evaluation.hpp"

namespace vantage {

/// results.csv: a row an episode, in the order of the plan. Holds nothing that another run of the
/// same episodes, in whatever order and however often killed, would not give again.
std::string results_csv(const StudyResults& results);
/// timings.csv: wall times.
std::string timings_csv(const StudyResults& results);

}  // namespace vantage
