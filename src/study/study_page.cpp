#include "vantage/study/study_page.hpp"

#include <fmt/format.h>

#include "vantage/core/atomic_file.hpp"
#include "vantage/report/page.hpp"
#include "vantage/study/collect.hpp"
#include "vantage/study/tables/text_table.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

std::string figures_html(const Evaluation& evaluation) {
  std::string text;
  for (const Figure& figure : evaluation.figures) {
    text += fmt::format("<section class=\"panel figure\">\n{}</section>\n", figure_svg(figure));
  }
  return text;
}

std::string verdicts_html(const Evaluation& evaluation) {
  std::string items;
  for (const std::string& line : study_verdicts(evaluation)) {
    items += fmt::format("<li>{}</li>\n", html_escaped(line));
  }
  return items.empty() ? items : fmt::format("<ul>\n{}</ul>\n", items);
}

std::string tables_html(const Evaluation& evaluation) {
  std::string text;
  for (const Comparison& comparison : evaluation.comparisons) {
    text += fmt::format("<details><summary>{}</summary>\n{}</details>\n",
                        html_escaped(comparison.title), html(text_tables(comparison)));
  }
  return text;
}

}  // namespace

bool is_study_folder(const fs::path& directory) {
  std::error_code error;
  return fs::is_regular_file(directory / "study.yaml", error);
}

void write_study_page(const StudyResults& results, const Evaluation& evaluation) {
  const Replacement replacements[] = {
      {"title", html_escaped(results.study.title)},
      {"status", html_escaped(status_text(results.directory, results.plan, results.states))},
      {"overview", html({study_overview(evaluation)}) + verdicts_html(evaluation)},
      {"figures", figures_html(evaluation)},
      {"tables", tables_html(evaluation)},
      {"study", html_escaped(results.study.yaml)}};
  write_file(results.directory / "report.html", filled_page("study.html", replacements));
}

}  // namespace vantage
