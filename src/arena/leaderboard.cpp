#include "vantage/arena/leaderboard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <concepts>

#include "vantage/information/quantile.hpp"
#include "vantage/study/study_layout.hpp"

namespace vantage {
namespace {

PlannerKind kind_of(const Task& task) {
  return std::visit(
      []<class T>(const T& t) {
        if constexpr (std::derived_from<T, MappingOptions>) {
          if (asks_outside(t.choice)) return PlannerKind::foreign;
          if (knows_truth(t.choice)) return PlannerKind::reference;
        }
        return PlannerKind::built_in;
      },
      task);
}

/// What the episodes of one planner have of a value.
template <class Value>
std::vector<double> values_of(const std::vector<const EpisodeScore*>& scores, Value&& value) {
  std::vector<double> values;
  for (const EpisodeScore* score : scores) {
    if (const std::optional<double> v = value(*score)) values.push_back(*v);
  }
  return values;
}

std::optional<double> median_decision_s(const std::vector<const EpisodeScore*>& scores) {
  std::vector<double> times_s;
  for (const EpisodeScore* score : scores) {
    times_s.insert(times_s.end(), score->decision_times_s.begin(), score->decision_times_s.end());
  }
  return times_s.empty() ? std::nullopt : std::optional(quantile(std::move(times_s), 0.5));
}

void add_means(const std::vector<const EpisodeScore*>& scores, Standing& standing) {
  const auto mean_value = [&](auto&& value) { return mean_of(values_of(scores, value)); };
  using Score = const EpisodeScore&;
  standing.episodes = scores.size();
  standing.failed =
      static_cast<std::size_t>(std::ranges::count_if(scores, [](auto* s) { return s->failed; }));
  standing.seen_share =
      mean_value([](Score s) { return std::optional(s.seen_share); }).value_or(0.0);
  standing.path_length_m = mean_value([](Score s) { return s.path_length_m; });
  standing.collisions = mean_value([](Score s) { return s.collisions; });
  standing.decision_s = median_decision_s(scores);
  const auto over_bound = values_of(scores, [](Score s) { return s.time_over_bound_90; });
  standing.bounded = over_bound.size();
  standing.time_over_bound_90 = mean_of(over_bound);
  standing.regret_share = mean_value([](Score s) { return s.regret_share; });
}

void add_comparison(const Comparison& comparison, Standing& standing) {
  // Of one panel alone there are no rows of all of them.
  const auto& rows = comparison.rows;
  const bool several = std::ranges::count(rows, "all", &ComparisonRow::panel) > 0;
  for (const ComparisonRow& row : rows) {
    if (row.level != standing.planner || (several && row.panel != "all")) continue;
    standing.score = row.mean;
    if (has_interval(row.clusters)) standing.interval = row.interval;
    standing.difference = row.difference;
  }
}

Comparison compared(const StudyResults& results, const StudyLayout& layout,
                    const std::vector<EpisodeScore>& scores) {
  std::vector<Sample> samples;
  for (const EpisodeScore& score : scores) {
    const EpisodePlace place = layout.place(results.plan[score.episode].levels);
    samples.push_back(sample_at(place, place.level, score.score));
  }
  Comparison comparison = compare_levels(
      "score", "mean share seen over the budget of time, higher is better", layout.panels(),
      layout.levels(), layout.level_called(results.study.report.reference), samples);
  comparison.better = Better::higher;
  comparison.cluster = results.study.report.cluster;
  return comparison;
}

void rank(std::vector<Standing>& standings) {
  std::ranges::stable_sort(standings, std::ranges::greater{},
                           [](const Standing& s) { return s.episodes == 0 ? -1.0 : s.score; });
  int next = 1;
  for (Standing& standing : standings) {
    if (standing.kind != PlannerKind::reference && standing.episodes > 0) standing.rank = next++;
  }
}

std::string or_nothing(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : std::string();
}

}  // namespace

std::string_view kind_name(PlannerKind kind) {
  switch (kind) {
    case PlannerKind::built_in: return "built-in";
    case PlannerKind::foreign: return "foreign";
    case PlannerKind::reference: return "reference";
  }
  return {};
}

Leaderboard leaderboard_of(const StudyResults& results) {
  const StudyLayout layout(results.study);
  Leaderboard board{{}, episode_scores(results), {}};
  board.comparison = compared(results, layout, board.scores);
  for (std::size_t level = 0; level < layout.levels().size(); ++level) {
    Standing standing{.planner = layout.levels()[level], .level = level};
    for (const PlannedEpisode& planned : results.plan) {
      if (layout.place(planned.levels).level != level) continue;
      standing.kind = kind_of(planned.resolved.task);
      break;
    }
    std::vector<const EpisodeScore*> own;
    for (const EpisodeScore& score : board.scores) {
      if (layout.place(results.plan[score.episode].levels).level == level) own.push_back(&score);
    }
    add_means(own, standing);
    add_comparison(board.comparison, standing);
    board.standings.push_back(std::move(standing));
  }
  rank(board.standings);
  return board;
}

std::string leaderboard_csv(const Leaderboard& board) {
  std::string text =
      "rank,planner,kind,episodes,failed,score,score_low,score_high,difference,difference_low,"
      "difference_high,seen_share,path_length_m,collisions,time_over_bound_90,bounded_episodes,"
      "regret_share\n";
  for (const Standing& s : board.standings) {
    text += fmt::format("{},{},{},{},{},", s.rank ? std::to_string(*s.rank) : "", s.planner,
                        kind_name(s.kind), s.episodes, s.failed);
    text += s.episodes == 0 ? std::string(",,,") : fmt::format("{},", s.score);
    if (s.episodes > 0) text += s.interval ? interval_csv(*s.interval, 2) + "," : ",,";
    text += s.difference ? fmt::format("{},{},", s.difference->mean,
                                       interval_csv(s.difference->interval, s.difference->clusters))
                         : std::string(",,,");
    text += fmt::format("{},{},{},{},{},{}\n", s.seen_share, or_nothing(s.path_length_m),
                        or_nothing(s.collisions), or_nothing(s.time_over_bound_90), s.bounded,
                        or_nothing(s.regret_share));
  }
  return text;
}

std::string leaderboard_text(const Leaderboard& board) {
  std::size_t width = 7;
  for (const Standing& s : board.standings) width = std::max(width, s.planner.size());
  std::string text = fmt::format("{:>4}  {:<{}}  {:<9}  {:>5}  {:<15}  {:>5}  {:>7}  {:>6}\n", "",
                                 "planner", width, "", "score", "95 %", "seen", "path m", "failed");
  for (const Standing& s : board.standings) {
    if (s.episodes == 0) continue;
    const std::string interval =
        s.interval ? fmt::format("[{:.3f}, {:.3f}]", s.interval->low, s.interval->high) : "";
    text += fmt::format("{:>4}  {:<{}}  {:<9}  {:.3f}  {:<15}  {:>5.3f}  {:>7}  {:>2}/{}\n",
                        s.rank ? std::to_string(*s.rank) : "-", s.planner, width, kind_name(s.kind),
                        s.score, interval, s.seen_share,
                        s.path_length_m ? fmt::format("{:.1f}", *s.path_length_m) : "-", s.failed,
                        s.episodes);
  }
  return text;
}

}  // namespace vantage
