#include "vantage/study/study_layout.hpp"

#include <algorithm>

#include "vantage/core/error.hpp"

namespace vantage {

GroupedLevels grouped_levels(const Factor& factor, const std::vector<LevelGroup>& groups) {
  GroupedLevels grouped;
  for (const Level& level : factor.levels) {
    const auto holds = [&](const LevelGroup& group) {
      return std::ranges::find(group.levels, level.name) != group.levels.end();
    };
    const auto group = std::ranges::find_if(groups, holds);
    const std::string& name = group == groups.end() ? level.name : group->name;
    const auto known = std::ranges::find(grouped.names, name);
    grouped.of_level.push_back(static_cast<std::size_t>(known - grouped.names.begin()));
    if (known == grouped.names.end()) grouped.names.push_back(name);
  }
  return grouped;
}

Sample sample_at(const EpisodePlace& place, std::size_t level, double value) {
  return {place.panel, level, place.pair, value, place.cluster};
}

StudyLayout::StudyLayout(const Study& study)
    : compared_(factor_index(study, study.report.compare)) {
  const StudyReport& report = study.report;
  for (const Factor& factor : study.factors) sizes_.push_back(factor.levels.size());
  compared_levels_ = grouped_levels(study.factors[compared_], report.groups);
  if (!report.panels.empty()) {
    panel_factor_ = factor_index(study, report.panels);
    panels_ = grouped_levels(study.factors[panel_factor_], report.groups);
  }
  if (!report.cluster.empty()) cluster_factor_ = factor_index(study, report.cluster);
}

EpisodePlace StudyLayout::place(const std::vector<std::size_t>& levels) const {
  EpisodePlace place;
  for (std::size_t f = 0; f < sizes_.size(); ++f) {
    place.pair = place.pair * sizes_[f] + (f == compared_ ? 0 : levels[f]);
  }
  place.level = compared_levels_.of_level[levels[compared_]];
  if (panel_factor_ != kNone) place.panel = panels_.of_level[levels[panel_factor_]];
  place.cluster = cluster_factor_ == kNone ? place.pair : levels[cluster_factor_];
  return place;
}

std::size_t StudyLayout::level_called(const std::string& name) const {
  const auto found = std::ranges::find(levels(), name);
  expects(found != levels().end(), "a level of that name");
  return static_cast<std::size_t>(found - levels().begin());
}

}  // namespace vantage
