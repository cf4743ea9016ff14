/// Tables to read, as Markdown and as HTML.
#pragma once

#include <string>
#include <vector>

#include "vantage/study/figures/figure.hpp"
#include "vantage/study/tables/comparison.hpp"

namespace vantage {

struct TextTable {
  std::string title;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  ///< each as long as `header`; the first cell a name
};

std::string markdown(const std::string& title, const std::vector<TextTable>& tables);
std::string html(const std::vector<TextTable>& tables);

/// A table a panel, a row a level.
std::vector<TextTable> text_tables(const Comparison& comparison);
/// A table a panel, a row a scan, a column a series.
std::vector<TextTable> text_tables(const Figure& figure);
/// A row a level, a column a comparison: the means over all panels.
TextTable overview(const std::vector<Comparison>& comparisons);
/// Of each level over all panels, "adaptive against simple: area +0.12 [0.03, 0.2], worse (9
/// pairs)". What the interval does not tell from nothing is neither better nor worse.
std::vector<std::string> verdicts(const std::vector<Comparison>& comparisons);

}  // namespace vantage
