// Writes bench/RESULTS.md from what benchmarks and studies left in bench/results.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "bench/claims/claims.hpp"
#include "bench/claims/recognition_claims.hpp"
#include "bench/cost_figures.hpp"
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
)";

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
       {"accuracy", "observations", "mean_entropy_nats", "flight_time_s", "path_length_m",
        "minimum_clearance_m", "collided", "tracking_error_m", "replan_time_s", "energy_j"},
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
using Origins = std::map<std::string, std::string>;

std::string figures_table(const Figures& all, const Origins& origins) {
  std::string text = "| benchmark | figure | | commit, threads, CPU |\n|---|---|---|---|\n";
  for (const auto& [name, figures] : all) {
    for (const auto& [key, value] : figures.items()) {
      text += fmt::format("| {} | `{}` | {:.5g} | {} |\n", name, key, value.get<double>(),
                          origins.at(name));
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
    series.points.push_back({1e-6 * cells, 1, ms, {ms, ms}});
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
  for (const Part& part : {Part{"simple", "Simple features:"},
                           {"changes", "Changes:"},
                           {"kernel", "Kernel descriptors:"},
                           {"simple_same_objects", "Simple features on the same objects:"}}) {
    if (fs::exists(folder / part.folder))
      tables += evaluation_tables(folder / part.folder, part.title);
  }
  return "\n## Recognition (Tables 4.2-4.7, 4.10-4.15, Fig. 4.4)\n\n`bench/studies recognition`, "
         "a rendered database; trained at 30 and 60 deg, tested at 45 deg.\n\n" +
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
    origins[name] =
        fmt::format("{}, {}, {}", benchmark.at("commit").get<std::string>(),
                    benchmark.at("threads").get<int>(), benchmark.at("cpu").get<std::string>());
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
    text += fmt::format("\n## {}\n\n`bench/studies {}`: {}.\n\n", part.title, part.name,
                        study.extent());
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
