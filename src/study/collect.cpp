#include "vantage/study/collect.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/log.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/runtime/scene_file.hpp"
#include "vantage/study/cluster/worker.hpp"
#include "vantage/study/figures/flight_figure.hpp"
#include "vantage/study/results_csv.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json summary_json(const StudyResults& results, const Evaluation& evaluation) {
  Json json = {{"title", results.study.title},
               {"episodes", results.plan.size()},
               {"completed", 0},
               {"not_completed", Json::object()},
               {"compare", results.study.report.compare},
               {"reference", results.study.report.reference},
               {"tables", Json::object()}};
  std::size_t completed = 0;
  for (std::size_t i = 0; i < results.plan.size(); ++i) {
    if (results.states[i] == EpisodeState::completed) {
      ++completed;
    } else {
      json["not_completed"][results.plan[i].name] = state_name(results.states[i]);
    }
  }
  json["completed"] = completed;
  for (const Comparison& comparison : evaluation.comparisons) {
    json["tables"][comparison.name] = comparison_json(comparison);
  }
  return json;
}

/// The predictors are no levels of the factor compared.
std::vector<Comparison> of_levels(const Evaluation& evaluation) {
  std::vector<Comparison> comparisons;
  for (const Comparison& comparison : evaluation.comparisons) {
    if (find_scalar(comparison.name)) comparisons.push_back(comparison);
  }
  return comparisons;
}

/// The first level of every factor but that of the panels and the one compared.
bool stands_for_its_panel(const StudyResults& results, const PlannedEpisode& episode) {
  const StudyReport& report = results.study.report;
  for (std::size_t f = 0; f < results.study.factors.size(); ++f) {
    const std::string& factor = results.study.factors[f].name;
    if (factor != report.compare && factor != report.panels && episode.levels[f] != 0) return false;
  }
  return true;
}

/// A scene that is not there any more costs a drawing its walls, not the collection its figures.
std::vector<FloorOutline> room_of(const ResolvedEpisode& episode) {
  try {
    return scene_floor_plan(model_source(episode));
  } catch (const Error& error) {
    log_warning(fmt::format("figures without walls: {}", error.what()));
    return {};
  }
}

/// One flight for each panel and method.
void write_flights(const StudyResults& results, const fs::path& folder) {
  for (std::size_t i = 0; i < results.plan.size(); ++i) {
    const PlannedEpisode& episode = results.plan[i];
    if (report_sections(episode.resolved.task).figures != kFlightFigures) continue;
    if (!results.measures[i] || !stands_for_its_panel(results, episode)) continue;
    const Json metrics =
        read_json_or_null(episode_folder(results.directory, episode) / "metrics.json");
    std::string stem = episode.name;
    std::ranges::replace(stem, '/', '-');
    write_file(folder / "figures" / (stem + ".svg"),
               flight_svg(metrics, episode.name, room_of(episode.resolved)));
  }
}

/// Every file of `from`, one by one in place of those of `to`; `from` is gone then.
void move_files(const fs::path& from, const fs::path& to) {
  std::error_code error;
  for (const char* folder : {"tables", "figures", "."}) {
    fs::create_directories(to / folder, error);
    for (const auto& entry : fs::directory_iterator(from / folder)) {
      if (!entry.is_regular_file()) continue;
      const fs::path file = to / folder / entry.path().filename();
      fs::rename(entry.path(), file, error);
      if (error)
        throw OutputError(fmt::format("{}: cannot write: {}", file.string(), error.message()));
    }
  }
  fs::remove_all(from, error);
}

void write_into(const fs::path& directory, const StudyResults& results,
                const Evaluation& evaluation) {
  make_writable_directory(directory / "tables");
  make_writable_directory(directory / "figures");
  write_file(directory / "results.csv", results_csv(results));
  write_file(directory / "timings.csv", timings_csv(results));
  for (const Comparison& comparison : evaluation.comparisons) {
    const fs::path stem = directory / "tables" / comparison.name;
    write_file(stem.string() + ".csv", comparison_csv(comparison));
    write_file(stem.string() + ".md", markdown(comparison.title, text_tables(comparison)));
  }
  for (const Figure& figure : evaluation.figures) {
    const fs::path stem = directory / "figures" / figure.name;
    write_file(stem.string() + ".svg", figure_svg(figure));
    write_file(stem.string() + ".csv", figure_csv(figure));
    write_file(stem.string() + ".md", markdown(full_title(figure), text_tables(figure)));
  }
  write_flights(results, directory);
  write_file(directory / "summary.md", study_summary(results, evaluation));
  write_file(directory / "summary.json", json_text(summary_json(results, evaluation)));
}

}  // namespace

TextTable study_overview(const Evaluation& evaluation) { return overview(of_levels(evaluation)); }

std::vector<std::string> study_verdicts(const Evaluation& evaluation) {
  return verdicts(of_levels(evaluation));
}

std::string study_summary(const StudyResults& results, const Evaluation& evaluation) {
  std::string text = markdown(results.study.title, {study_overview(evaluation)});
  const char* before = "\n";
  for (const std::string& line : study_verdicts(evaluation)) {
    text += fmt::format("{}- {}\n", before, line);
    before = "";
  }
  return text;
}

void write_collection(const StudyResults& results, const Evaluation& evaluation) {
  const Worker self = this_worker();
  const fs::path own = results.directory / fmt::format(".collection-{}-{}", self.host, self.pid);
  try {
    write_into(own, results, evaluation);
    move_files(own, results.directory);
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(own, ignored);
    throw;
  }
}

}  // namespace vantage
