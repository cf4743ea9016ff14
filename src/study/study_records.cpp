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
      {"results.csv", "episode", "its levels joined by /; also its folder"},
      {"results.csv", "<factor>", "level of that factor"},
      {"results.csv", "status", "completed, failed, diverged, or why there is no result"},
      {"results.csv", "prediction_error_<gain>_cells",
       "mean error of what that gain predicted, over the scans"},
      {"results.csv", "config_hash", "of the episode's configuration, but for threads"},
      {"results.csv", "commit", "version of vantage that ran the episode"},
      {"results.csv", "state_hash", "of every state and command of the episode"},
      {"timings.csv", "wall_time_s", "of the episode"},
      {"timings.csv", "real_time_factor", "simulated time over wall time"},
      {"timings.csv", "plan_time_s", "of all decisions"},
      {"timings.csv", "map_time_s", "of all map updates"},
      {"timings.csv", "threads", "that the episode ran on"},
      {"timings.csv", "cpu", "that the episode ran on"},
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
