/// `vantage compare`: the numbers of two runs, or of two studies, side by side.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

#include "vantage/study/kit/headlines.hpp"

namespace vantage {

struct ComparedValue {
  std::string key;  ///< dotted path into metrics.json or summary.json, "scans[3].unobserved_cells"
  std::string first;  ///< as JSON; empty: not there
  std::string second;
  double difference = 0.0;  ///< second - first, if both are numbers
  double relative = 0.0;    ///< |second - first| / max(|first|, |second|)
  bool beyond = false;      ///< more than is tolerated
};

struct FolderComparison {
  std::string first;  ///< folder, as it was named
  std::string second;
  std::vector<Headline> headlines;
  std::vector<ComparedValue> values;  ///< in the order of the first file; wall times left out
  std::size_t beyond = 0;             ///< how many of them
};

/// With a tolerance of 0 everything but wall times must be the same; above it numbers may differ by
/// that share of the larger one, and of the texts only title, task and status must agree.
/// @throws InputError if a folder is neither a run nor a collected study, or one is a run and the
/// other a study.
FolderComparison compare_folders(const std::filesystem::path& first,
                                 const std::filesystem::path& second, double tolerance);

/// The headlines, and how much else differs beyond the tolerance; `all`: every value that does.
std::string comparison_text(const FolderComparison& comparison, bool all = false);
nlohmann::ordered_json comparison_json(const FolderComparison& comparison, double tolerance);

}  // namespace vantage
