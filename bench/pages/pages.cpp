#include "bench/pages/pages.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "bench/pages/cost_figures.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/study/figures/figure.hpp"

namespace vantage::bench {
namespace {
namespace fs = std::filesystem;

/// @param up from the page's folder to that of RESULTS.md
std::string back_through(std::string_view up) {
  return fmt::format("\nClaims: [RESULTS.md]({}RESULTS.md).\n", up);
}

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
  std::string text =
      "| benchmark | figure | | commit, configuration, threads, CPU |\n|---|---|---|---|\n";
  for (const auto& [name, figures] : all) {
    for (const auto& [key, value] : figures.items()) {
      const BenchmarkOrigin& origin = origins.at(name);
      text += fmt::format("| {} | `{}` | {:.5g} | {}, {}, {}, {} |\n", name, key,
                          value.get<double>(), origin.commit,
                          origin.config_hash.empty() ? "not recorded" : origin.config_hash,
                          threads_of(key, figures, origin.threads), origin.cpu);
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

/// The folder's files of that extension, by name; none if there is no folder.
std::vector<fs::path> files_in(const fs::path& folder, std::string_view extension) {
  std::vector<fs::path> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == extension) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

/// Tables of `vantage evaluate`, their headings a level down.
std::string evaluation_tables(const fs::path& folder, const std::string& title) {
  std::string text = "\n## " + title + read_file(folder / "recognition.md").substr(1);
  for (auto at = text.find("\n## ", 1); at != std::string::npos; at = text.find("\n## ", at + 1)) {
    text.insert(at + 1, "#");
  }
  return text;
}

}  // namespace

std::string write_speed_page(const fs::path& directory, const Figures& figures,
                             const Origins& origins) {
  std::string text =
      "# Speed\n\n`bench/run all`\n" + back_through("../") + "\n" + figures_table(figures, origins);
  if (const auto scaling = figures.find("scaling"); scaling != figures.end()) {
    write_file(directory / "scaling.svg", figure_svg(scaling_figure(scaling->second)));
    text += "\n![Time against cells](scaling.svg)\n";
  }
  write_file(directory / "speed.md", text);
  return "speed.md";
}

std::string write_study_page(const fs::path& directory, const std::string& name,
                             const std::string& title, const StudyTables& study,
                             const std::vector<std::string>& tables) {
  std::string text = fmt::format("# {}\n\n`bench/studies {}`: {}.\n{}", title, name, study.extent(),
                                 back_through("../../"));
  for (const std::string& table : tables) {
    if (study.has(table)) text += fmt::format("\n## {}\n\n{}", table, study.markdown(table));
  }
  for (const fs::path& picture : files_in(directory / name, ".svg")) {
    text += fmt::format("\n![{}]({})\n", picture.stem().string(), picture.filename().string());
  }
  fs::create_directories(directory / name);
  write_file(directory / name / "tables.md", text);
  return name + "/tables.md";
}

std::string write_cost_page(const fs::path& directory) {
  std::string text = "# The cost of a flight, term by term ((5.8) - (5.11))\n" +
                     back_through("../") +
                     "\nUnweighed, of the default options; with `literal: true` as printed.\n";
  for (const Figure& figure : cost_figures()) {
    write_file(directory / (figure.name + ".svg"), figure_svg(figure));
    text += fmt::format("\n![{}]({}.svg)\n", figure.title, figure.name);
  }
  write_file(directory / "cost.md", text);
  return "cost.md";
}

std::string write_recognition_page(const fs::path& directory) {
  struct Part {
    const char* folder;
    const char* title;
  };
  const fs::path folder = directory / "recognition";
  std::string text =
      "# Recognition (Tables 4.2-4.7, 4.10-4.15, Fig. 4.4)\n\n`bench/studies recognition`, a "
      "rendered database; trained at 30 and 60 deg, tested at 45 deg; of unknown objects "
      "`bench/studies "
      "unknown`, trained on recordings 1 to 5, tested on 7 and 8.\n" +
      back_through("../../");
  for (const auto& [part, title] : {Part{"simple", "Simple features:"},
                                    {"changes", "Changes:"},
                                    {"kernel", "Kernel descriptors:"},
                                    {"simple_same_objects", "Simple features, same objects:"},
                                    {"unknown", "Families left out are unknown:"},
                                    {"unknown_scanned", "Scanned objects are unknown:"}}) {
    if (!fs::exists(folder / part)) continue;
    text += evaluation_tables(folder / part, title);
    if (fs::exists(folder / part / "reliability.svg")) {
      text += fmt::format("\n![Reliability of P(object)]({}/reliability.svg)\n", part);
    }
  }
  fs::create_directories(folder);
  write_file(folder / "tables.md", text);
  return "recognition/tables.md";
}

}  // namespace vantage::bench
