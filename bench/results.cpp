// Writes bench/RESULTS.md from what benchmarks and studies left in bench/results.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "bench/claims/claims.hpp"
#include "bench/claims/recognition_claims.hpp"
#include "bench/cost_figures.hpp"
#include "bench/freshness.hpp"
#include "bench/measures.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/study/figures/figure.hpp"

namespace vantage::bench {
namespace {
namespace fs = std::filesystem;

constexpr std::string_view kIntroduction =
    R"(# Results

Written by `bench/run all` and `bench/studies`; not edited by hand. Times are medians of one machine
and say little by themselves; their ratios inside one run are what is claimed. Means carry 95 %
bootstrap intervals, differences are paired over the same scene and start, `p` is that of a
sign-flip test, `x` the ratio of the means to the reference method. The dissertation is C. Potthast,
*Information Theoretical Action Selection*, USC 2016.

`\*`: the code that it depends on has changed since the commit that it is of. `?`: whether it has is
unknown.
)";

/// What any result depends on.
std::vector<std::string> code_with(const std::vector<std::string>& more) {
  std::vector<std::string> code{"src", "planners", "sim", "models", "assets"};
  code.insert(code.end(), more.begin(), more.end());
  return code;
}

/// The program that printed a benchmark of that name.
std::string program_of(const std::string& benchmark) {
  if (benchmark == "scaling") return "decision";
  return benchmark == "office_views" ? "office" : benchmark;
}

Freshness freshness_of_benchmark(const std::string& name, const std::string& commit,
                                 const fs::path& file) {
  return freshness_of(
      {.commits = {commit},
       .file = file,
       .code = code_with({"bench/" + program_of(name) + ".cpp", "bench/situation.cpp",
                          "bench/castray.cpp", "bench/measures.cpp"})});
}

/// The commits of its episodes, where they are recorded.
std::set<std::string> commits_of_study(const fs::path& results_csv) {
  std::set<std::string> commits;
  if (!fs::exists(results_csv)) return commits;
  const CsvTable results = read_csv(results_csv);
  const auto column = std::ranges::find(results.columns, "commit") - results.columns.begin();
  for (const auto& row : results.rows) {
    if (column < std::ssize(row) && !row[static_cast<std::size_t>(column)].empty()) {
      commits.insert(row[static_cast<std::size_t>(column)]);
    }
  }
  return commits;
}

/// "; of b100039, c29a3d1 \*"
std::string origin_text(const std::set<std::string>& commits, const fs::path& file) {
  const std::string marked = mark(freshness_of({commits, file, code_with({})}));
  return fmt::format(
      "; of {}{}",
      commits.empty() ? "a commit not recorded" : fmt::format("{}", fmt::join(commits, ", ")),
      marked);
}

struct StudyPart {
  std::string name;
  const char* title;
  std::vector<std::string> tables;
  std::vector<Finding> (*findings)(const StudyTables&);
};

const std::vector<StudyPart>& study_parts() {
  static const std::vector<std::string> tables = {"area",           "scans_to_95",   "scans",
                                                  "observed_share", "path_length_m", "collisions",
                                                  "predictors"};
  static const std::vector<StudyPart> parts = {
      {"tabletop", "Table top (Fig. 3.10)", tables, tabletop_findings},
      {"tabletop_predictors",
       "Predictions on the table top (Fig. 3.11)",
       {"predictors"},
       prediction_findings},
      {"office_small", "Small office (Fig. 3.15)", tables,
       [](const StudyTables& study) {
         return office_findings(study, "Fig. 3.15", {20, 25});
       }},
      {"office_large", "Large office (Fig. 3.16)", tables,
       [](const StudyTables& study) {
         return office_findings(study, "Fig. 3.16", {60, 70});
       }},
      {"recognition_flight",
       "Recognition on the quadrotor (4.5.7)",
       {"correct", "category_correct", "views", "bin_error", "path_length_m", "collisions"},
       flight_recognition_findings},
      {"change_flight",
       "Change detection on the quadrotor (Table 4.16)",
       {"changed_correct", "correct", "views", "collisions"},
       flight_change_findings},
      {"trajectory",
       "Trajectories for recognition (tables 5.1-5.3)",
       {"accuracy", "observations", "mean_entropy_observed_nats", "objects_unseen",
        "mean_entropy_nats", "flight_time_s", "path_length_m", "minimum_clearance_m", "collided",
        "tracking_error_m", "replan_time_s", "energy_j"},
       trajectory_findings}};
  return parts;
}

/// The folder's files of that extension, by name.
std::vector<fs::path> files_in(const fs::path& folder, std::string_view extension) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == extension) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

/// Of what code, on what machine a benchmark ran.
struct BenchmarkOrigin {
  std::string commit;  ///< with its mark
  int threads = 0;
  std::string cpu;
};
using Origins = std::map<std::string, BenchmarkOrigin>;

/// Those of the benchmark, but for castRay's where it had others.
std::string threads_of(const std::string& key, const Json& figures, int threads) {
  if (!key.starts_with("castray_") || !figures.contains("castray_threads")) {
    return std::to_string(threads);
  }
  const int of_castray = figures["castray_threads"].get<int>();
  const bool ratio = key == "castray_over_sweep" && of_castray != threads;
  return ratio ? fmt::format("{} against {}", of_castray, threads) : std::to_string(of_castray);
}

std::string figures_table(const Figures& all, const Origins& origins) {
  std::string text = "| benchmark | figure | | commit, threads, CPU |\n|---|---|---|---|\n";
  for (const auto& [name, figures] : all) {
    for (const auto& [key, value] : figures.items()) {
      const BenchmarkOrigin& origin = origins.at(name);
      text += fmt::format("| {} | `{}` | {:.5g} | {}, {}, {} |\n", name, key, value.get<double>(),
                          origin.commit, threads_of(key, figures, origin.threads), origin.cpu);
    }
  }
  return text;
}

/// Time against cells, from the keys ms_of_N_cells.
Figure scaling_figure(const Json& figures) {
  FigureSeries series{"sweep", 0, {}};
  for (const auto& [key, value] : figures.items()) {
    if (!key.starts_with("ms_of_")) continue;
    const double cells = std::stod(key.substr(6));
    const double ms = value.get<double>();
    series.points.push_back({1e-6 * cells, 1, 1, ms, {ms, ms}});
  }
  return {.name = "scaling",
          .title = "Time of a decision of 30 views",
          .x_label = "million cells",
          .y_label = "ms",
          .panels = {{"", {series}}},
          .note = "Medians of one run."};
}

/// Tables of `vantage evaluate`, their headings two levels down.
std::string evaluation_tables(const fs::path& folder, const std::string& title) {
  std::string text = "\n### " + title + read_file(folder / "recognition.md").substr(1);
  for (auto at = text.find("\n## "); at != std::string::npos; at = text.find("\n## ", at + 1)) {
    text.insert(at + 1, "##");
  }
  return text;
}

/// Nothing, where it was not run.
Json json_or_nothing(const fs::path& file) {
  return fs::exists(file) ? read_json(file) : Json::object();
}

/// What `vantage evaluate` wrote of recognition, with simple features and kernel descriptors.
std::string recognition_part(const fs::path& folder) {
  struct Part {
    const char* folder;
    const char* title;
  };
  std::vector<Finding> findings;
  const auto add = [&](const std::vector<Finding>& more) {
    findings.insert(findings.end(), more.begin(), more.end());
  };
  const auto summary = [&](const char* part) {
    return json_or_nothing(folder / part / "summary.json");
  };
  add(recognition_findings(summary("simple")));
  add(change_findings(summary("changes")));
  add(kernel_findings(summary("kernel"), summary("simple_same_objects")));
  std::string tables;
  std::set<std::string> commits;
  for (const Part& part : {Part{"simple", "Simple features:"},
                           {"changes", "Changes:"},
                           {"kernel", "Kernel descriptors:"},
                           {"simple_same_objects", "Simple features on the same objects:"}}) {
    if (!fs::exists(folder / part.folder)) continue;
    tables += evaluation_tables(folder / part.folder, part.title);
    const Json commit = summary(part.folder).value("commit", Json());
    if (commit.is_string()) commits.insert(commit.get<std::string>());
  }
  return "\n## Recognition (Tables 4.2-4.7, 4.10-4.15, Fig. 4.4)\n\n`bench/studies recognition`, "
         "a rendered database; trained at 30 and 60 deg, tested at 45 deg" +
         origin_text(commits, folder / "simple" / "summary.json") + ".\n\n" +
         findings_table(findings) + tables;
}

/// Writes their images too.
std::string cost_part(const fs::path& directory) {
  std::string text =
      "\n## The cost of a flight, term by term ((5.8) - (5.11))\n\n"
      "Unweighed, of the default options; with `literal: true` as printed.\n";
  for (const Figure& figure : cost_figures()) {
    write_file(directory / (figure.name + ".svg"), figure_svg(figure));
    text += fmt::format("\n![{}](results/{}.svg)\n", figure.title, figure.name);
  }
  return text;
}

void write_results(const fs::path& directory) {
  Figures figures;
  Origins origins;
  for (const fs::path& file : files_in(directory, ".json")) {
    const Json benchmark = read_json(file);
    const auto name = benchmark.at("name").get<std::string>();
    figures.emplace(name, benchmark.at("figures"));
    const auto commit = benchmark.at("commit").get<std::string>();
    origins[name] = {commit + mark(freshness_of_benchmark(name, commit, file)),
                     benchmark.at("threads").get<int>(), benchmark.at("cpu").get<std::string>()};
  }
  std::string text(kIntroduction);
  text += "\n## Speed\n\n" + findings_table(speed_findings(figures)) + "\n" +
          figures_table(figures, origins);
  if (const auto scaling = figures.find("scaling"); scaling != figures.end()) {
    write_file(directory / "scaling.svg", figure_svg(scaling_figure(scaling->second)));
    text += "\n![Time against cells](results/scaling.svg)\n";
  }
  for (const StudyPart& part : study_parts()) {
    const fs::path folder = directory / part.name;
    const StudyTables study(fs::path("assets/studies") / (part.name + ".yaml"),
                            folder / "results.csv");
    const fs::path results_csv = folder / "results.csv";
    const std::string origin =
        fs::exists(results_csv) ? origin_text(commits_of_study(results_csv), results_csv) : "";
    text += fmt::format("\n## {}\n\n`bench/studies {}`: {}{}.\n\n", part.title, part.name,
                        study.extent(), origin);
    text += findings_table(part.findings(study));
    for (const std::string& table : part.tables) {
      if (!study.has(table)) continue;
      text += fmt::format("\n### {}: {}\n\n{}", part.title, table, study.markdown(table));
    }
    if (!fs::exists(folder)) continue;
    for (const fs::path& picture : files_in(folder, ".svg")) {
      text += fmt::format("\n![{}](results/{}/{})\n", picture.stem().string(), part.name,
                          picture.filename().string());
    }
  }
  text += cost_part(directory);
  text += recognition_part(directory / "recognition");
  write_file(directory.parent_path() / "RESULTS.md", text);
}

}  // namespace
}  // namespace vantage::bench

int main() {
  return vantage::bench::run_main([] { vantage::bench::write_results("bench/results"); });
}
