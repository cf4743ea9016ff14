/// Where the episodes of a study stand in its comparison.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "vantage/study/study.hpp"
#include "vantage/study/tables/comparison.hpp"

namespace vantage {

/// Names that levels of a factor go by, and which of them each level has.
struct GroupedLevels {
  std::vector<std::string> names;
  std::vector<std::size_t> of_level;
};
/// Levels of one group share its name; one of no group keeps its own.
GroupedLevels grouped_levels(const Factor& factor, const std::vector<LevelGroup>& groups);

struct EpisodePlace {
  std::size_t panel = 0;
  std::size_t level = 0;    ///< of the factor compared, grouped
  std::size_t pair = 0;     ///< the same for episodes that differ in the compared factor only
  std::size_t cluster = 0;  ///< the same for episodes that are alike; of no cluster: the pair
};

/// What an episode came to, as a sample of that level.
Sample sample_at(const EpisodePlace& place, std::size_t level, double value);

class StudyLayout {
 public:
  /// @param study whose report names factors that it has
  explicit StudyLayout(const Study& study);

  /// @param levels index of the level of each factor
  [[nodiscard]] EpisodePlace place(const std::vector<std::size_t>& levels) const;
  /// {"all"} where the study has none.
  [[nodiscard]] const std::vector<std::string>& panels() const { return panels_.names; }
  [[nodiscard]] const std::vector<std::string>& levels() const { return compared_levels_.names; }
  /// Index in levels(); the name must be there.
  [[nodiscard]] std::size_t level_called(const std::string& name) const;

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  std::vector<std::size_t> sizes_;  ///< levels of each factor
  std::size_t compared_;
  std::size_t panel_factor_ = kNone;
  std::size_t cluster_factor_ = kNone;
  GroupedLevels compared_levels_;
  GroupedLevels panels_{{"all"}, {}};
};

}  // namespace vantage
