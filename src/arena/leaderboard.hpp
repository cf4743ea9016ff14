/// The planners of an arena, the best one first.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vantage/arena/episode_score.hpp"
#include "vantage/study/tables/comparison.hpp"

namespace vantage {

enum class PlannerKind {
  built_in,
  foreign,    ///< a program of somebody's
  reference,  ///< knows the truth: out of the ranking
};
std::string_view kind_name(PlannerKind kind);

struct Standing {
  std::string planner;
  std::size_t level = 0;  ///< of the factor compared: its place in figures
  PlannerKind kind = PlannerKind::built_in;
  std::optional<int> rank = {};  ///< none of references, or where nothing was run
  std::size_t episodes = 0;      ///< that came to something
  std::size_t failed = 0;        ///< of these
  double score = 0.0;
  std::optional<Interval> interval = {};      ///< 95 % bootstrap of clusters
  std::optional<Difference> difference = {};  ///< to the reference level; none of itself
  double seen_share = 0.0;
  std::optional<double> path_length_m = {};  ///< mean of the episodes that came to metrics
  std::optional<double> collisions = {};     ///< likewise
  std::optional<double> decision_s = {};     ///< median, wall
  std::optional<double> time_over_bound_90 =
      {};                   ///< mean of the episodes with a bound that got there
  std::size_t bounded = 0;  ///< these
  std::optional<double> regret_share = {};
};

struct Leaderboard {
  std::vector<Standing> standings;  ///< by score; of equal ones as the study has them
  std::vector<EpisodeScore> scores;
  Comparison comparison;  ///< of scores, with a panel for each of the study's
};

Leaderboard leaderboard_of(const StudyResults& results);

/// A row a planner. The same results give the same bytes: no wall time is in it.
std::string leaderboard_csv(const Leaderboard& board);
/// For the terminal.
std::string leaderboard_text(const Leaderboard& board);

}  // namespace vantage
