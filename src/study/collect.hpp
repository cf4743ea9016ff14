/// `vantage sweep collect`: the episodes of a study merged to tables and figures.
#pragma once

#include <filesystem>

#include "vantage/study/evaluation.hpp"
#include "vantage/study/tables/text_table.hpp"

namespace vantage {

/// Writes into the study's folder:
///   results.csv, timings.csv        a row an episode
///   summary.json, summary.md        states, means, intervals, paired differences
///   tables/NAME.csv, .md            StudyReport::tables, with intervals and tests
///   figures/NAME.svg, .csv, .md     StudyReport::curves
///   figures/EPISODE.svg             trajectory flights from above, the first of each panel and
///   level
/// Episodes that leave nothing to measure (missing, crashed, diverged) are left out of everything
/// but results.csv and summary.json, which name them; those that failed count. The text of a file
/// depends on the results alone. Several processes may write at once: each makes its files in a
/// folder of its own and moves them when they are whole.
/// @throws OutputError
void write_collection(const StudyResults& results, const Evaluation& evaluation);

/// The means of every table over all panels.
TextTable study_overview(const Evaluation& evaluation);
/// What each level is against the reference, a line a level and table.
std::vector<std::string> study_verdicts(const Evaluation& evaluation);
/// Both, under the study's title: summary.md.
std::string study_summary(const StudyResults& results, const Evaluation& evaluation);

}  // namespace vantage
