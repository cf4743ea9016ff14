/// What an episode of an arena came to.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "vantage/study/evaluation.hpp"

namespace vantage {

/// Share of the observable cells that are observed, from a time on.
struct ShareSeen {
  double time_s = 0.0;
  double share = 0.0;
};

/// Mean over [0, horizon_s] of the share seen, which steps up at the end of each scan and stays
/// after the last; scans after the horizon do not count. 0 of nothing.
double mean_share_seen(const std::vector<ShareSeen>& steps, double horizon_s);
/// The same share at evenly spaced times, both ends included. @param samples at least 2
std::vector<double> sampled_share_seen(const std::vector<ShareSeen>& steps, double horizon_s,
                                       std::size_t samples);

/// Whether a task chooses among views, so that planners of it can be held against each other.
bool chooses_views(const Task& task);

struct EpisodeScore {
  std::size_t episode = 0;  ///< index into the plan
  bool failed = false;      ///< not completed; what it had seen by then counts
  std::string reason;       ///< why
  double horizon_s = 0.0;   ///< the budget of time
  std::vector<ShareSeen> steps;
  double score = 0.0;  ///< mean_share_seen() over the budget
  double seen_share = 0.0;
  std::optional<double> path_length_m = {};  ///< none where it came to no metrics
  std::optional<double> collisions = {};
  std::vector<double> decision_times_s;      ///< wall
  std::optional<double> time_over_bound_90;  ///< of bound.json: to 90 %, over the least
  std::optional<double> regret_share;        ///< of branches.json: mean of cells given away, over
                                             ///< those of the best view
};

/// Of every episode that came to something, in the order of the plan; one that crashed or diverged
/// has seen nothing. The horizon is budget.time_s; where there is none, the longest time that an
/// episode of the same scene and seed took.
std::vector<EpisodeScore> episode_scores(const StudyResults& results);

}  // namespace vantage
