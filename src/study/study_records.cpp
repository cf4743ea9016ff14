#include "vantage/study/study_records.hpp"

#include "vantage/study/measures.hpp"

namespace vantage {
namespace {

std::vector<std::string> texts_of(const std::vector<MeasureName>& measures) {
  std::vector<std::string> texts;
  for (const MeasureName& measure : measures) texts.push_back(measure_text(measure));
  return texts;
}

}  // namespace

RecordTexts study_records() {
  RecordTexts texts{
      {kStudyFolder, "study.yaml", "the study, self-contained"},
      {kStudyFolder, "episodes", "a run folder for each episode, named by its levels"},
      {kStudyFolder, "attempts", "claims of workers on episodes, and what runs now"},
      {kStudyFolder, "slurm", "what was submitted to Slurm, and what its tasks said"},
      {kStudyFolder, "results.csv", "a row an episode; the same to the byte however it was run"},
      {kStudyFolder, "timings.csv", "wall times of the episodes"},
      {kStudyFolder, "summary.json", "means, intervals and differences of every table"},
      {kStudyFolder, "summary.md", "the same of the report's tables, to read"},
      {kStudyFolder, "tables", "a table a measure, as .csv and .md"},
      {kStudyFolder, "figures", "figures as .svg, .csv and .md"},
      {kStudyFolder, "arena.html", "of an arena: the leader board and its curves"},
      {kStudyFolder, "leaderboard.csv", "of an arena: a row a planner, the best one first"},
      {"results.csv", "episode", "its levels joined by /; also its folder"},
      {"results.csv", "<factor>", "level of that factor"},
      {"results.csv", "status", "completed, failed, diverged, or why there is no result"},
      {"results.csv", "prediction_error_<gain>_cells",
       "mean error of what that gain predicted, over the scans"},
      {"results.csv", "config_hash", "of the episode's configuration, but for threads"},
      {"results.csv", "commit", "version of vantage that ran the episode"},
      {"results.csv", "state_hash", "of the robot's every state and command"},
      {"timings.csv", "wall_time_s", "of the episode"},
      {"timings.csv", "real_time_factor", "simulated time over wall time"},
      {"timings.csv", "plan_time_s", "of all decisions"},
      {"timings.csv", "map_time_s", "of all map updates"},
      {"timings.csv", "threads", "that the episode ran on"},
      {"timings.csv", "cpu", "that the episode ran on"},
      {"leaderboard.csv", "rank", "by score; none of references"},
      {"leaderboard.csv", "planner", "level of the factor compared"},
      {"leaderboard.csv", "kind", "built-in, foreign (a program), reference (knows the truth)"},
      {"leaderboard.csv", "episodes", "that came to something"},
      {"leaderboard.csv", "failed", "of these; they keep what they had seen by then"},
      {"leaderboard.csv", "score",
       "mean over the budget of time of the share seen, higher is better"},
      {"leaderboard.csv", "score_low",
       "end of its 95 % bootstrap interval, levels of `report.cluster` resampled"},
      {"leaderboard.csv", "score_high", "its other end"},
      {"leaderboard.csv", "difference", "of scores to the reference's, paired"},
      {"leaderboard.csv", "difference_low", "end of its 95 % bootstrap interval"},
      {"leaderboard.csv", "difference_high", "its other end"},
      {"leaderboard.csv", "seen_share", "of the observable cells at the end, mean of the episodes"},
      {"leaderboard.csv", "path_length_m", "mean of the episodes that came to metrics"},
      {"leaderboard.csv", "collisions", "mean of the episodes that came to metrics"},
      {"leaderboard.csv", "time_over_bound_90",
       "time to 90 % over the least that any policy needs, mean of the bounded episodes"},
      {"leaderboard.csv", "bounded_episodes", "that have a bound and reached 90 %"},
      {"leaderboard.csv", "regret_share",
       "cells that chosen views showed less than the best ones, as a share of these"},
  };
  static const auto scalars = texts_of(scalar_measures());
  static const auto curves = texts_of(curve_measures());
  for (std::size_t i = 0; i < scalars.size(); ++i) {
    const MeasureName& measure = scalar_measures()[i];
    texts.push_back({measure.wall ? "timings.csv" : "results.csv", measure.name, scalars[i]});
  }
  for (std::size_t i = 0; i < curves.size(); ++i) {
    texts.push_back({"curves", curve_measures()[i].name, curves[i]});
  }
  return texts;
}

}  // namespace vantage
