/// From the run folders of a study to its comparisons and figures.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vantage/study/figures/figure.hpp"
#include "vantage/study/measures.hpp"
#include "vantage/study/results.hpp"
#include "vantage/study/study.hpp"
#include "vantage/study/tables/comparison.hpp"

namespace vantage {

struct StudyResults {
  Study study;
  std::filesystem::path directory;
  std::vector<PlannedEpisode> plan;
  std::vector<EpisodeState> states;                      ///< of each episode
  std::vector<std::optional<EpisodeMeasures>> measures;  ///< of each that completed or failed

  [[nodiscard]] bool complete() const;  ///< every episode is completed
};

/// @param study_dir holds study.yaml
/// @throws InputError naming the file that is missing or malformed, ConfigError
StudyResults read_study_results(const std::filesystem::path& study_dir);

/// metrics.json of an episode as this version has it; null if it is missing or not whole.
nlohmann::ordered_json episode_metrics(const StudyResults& results, std::size_t episode);

struct Evaluation {
  std::vector<Comparison> comparisons;  ///< StudyReport::tables, then the predictors
  std::vector<Figure> figures;          ///< StudyReport::curves, then the predictors
};
/// Of the episodes that completed or failed.
Evaluation evaluate(const StudyResults& results);

}  // namespace vantage
