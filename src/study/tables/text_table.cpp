#include "vantage/study/tables/text_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "vantage/report/page.hpp"

namespace vantage {
namespace {

std::string number(double value) {
  return std::abs(value) >= 9999.5 ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

std::string with_interval(double value, const Interval& interval, std::size_t values) {
  if (!has_interval(values)) return number(value);
  return fmt::format("{} [{}, {}]", number(value), number(interval.low), number(interval.high));
}

std::vector<std::string> cells(const ComparisonRow& row) {
  std::vector<std::string> cells{row.level, fmt::format("{}", row.count),
                                 with_interval(row.mean, row.interval, row.clusters)};
  if (!row.difference) {
    cells.insert(cells.end(), 3, "");
    return cells;
  }
  const Difference& d = *row.difference;
  cells.push_back(with_interval(d.mean, d.interval, d.clusters));
  cells.push_back(d.ratio ? with_interval(*d.ratio, *d.ratio_interval, d.clusters) : "");
  cells.push_back(fmt::format("{:.2g}", d.p_value));
  return cells;
}

const FigurePoint* point_at(const FigureSeries& series, double x) {
  const auto found = std::ranges::find(series.points, x, &FigurePoint::x);
  return found == series.points.end() ? nullptr : &*found;
}

TextTable table_of(const FigurePanel& panel, const std::string& x_label) {
  TextTable table{panel.title, {x_label}, {}};
  std::vector<double> xs;
  for (const FigureSeries& series : panel.series) {
    table.header.push_back(series.name);
    for (const FigurePoint& point : series.points) xs.push_back(point.x);
  }
  std::ranges::sort(xs);
  xs.erase(std::unique(xs.begin(), xs.end()), xs.end());
  for (const double x : xs) {
    std::vector<std::string> row{number(x)};
    for (const FigureSeries& series : panel.series) {
      const FigurePoint* point = point_at(series, x);
      row.push_back(
          point == nullptr ? "" : with_interval(point->mean, point->interval, point->clusters));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string verdict(const Comparison& comparison, const Difference& d) {
  if (!has_interval(d.clusters)) return "no interval";
  if (d.interval.low <= 0.0 && d.interval.high >= 0.0) return "no clear difference";
  if (comparison.better == Better::unsaid) return d.mean > 0.0 ? "more" : "less";
  return (d.mean > 0.0) == (comparison.better == Better::higher) ? "better" : "worse";
}

}  // namespace

std::string markdown(const std::string& title, const std::vector<TextTable>& tables) {
  std::string text = fmt::format("# {}\n", title);
  for (const TextTable& table : tables) {
    if (!table.title.empty()) text += fmt::format("\n## {}\n", table.title);
    text += fmt::format("\n| {} |\n|---|", fmt::join(table.header, " | "));
    for (std::size_t i = 1; i < table.header.size(); ++i) text += "---:|";
    for (const auto& row : table.rows) text += fmt::format("\n| {} |", fmt::join(row, " | "));
    text += "\n";
  }
  return text;
}

std::string html(const std::vector<TextTable>& tables) {
  std::string text;
  const auto row_html = [&](const std::vector<std::string>& row, std::string_view tag) {
    text += "<tr>";
    for (const auto& cell : row) text += fmt::format("<{0}>{1}</{0}>", tag, html_escaped(cell));
    text += "</tr>\n";
  };
  for (const TextTable& table : tables) {
    if (!table.title.empty()) text += fmt::format("<h3>{}</h3>\n", html_escaped(table.title));
    text += "<div class=\"table-wrap\"><table>\n<thead>";
    row_html(table.header, "th");
    text += "</thead>\n<tbody>\n";
    for (const auto& row : table.rows) row_html(row, "td");
    text += "</tbody></table></div>\n";
  }
  return text;
}

std::vector<TextTable> text_tables(const Comparison& comparison) {
  std::vector<TextTable> tables;
  for (const ComparisonRow& row : comparison.rows) {
    if (tables.empty() || tables.back().title != row.panel) {
      tables.push_back(
          {row.panel,
           {"", "episodes",
            comparison.cluster.empty() ? "mean [95 %]"
                                       : fmt::format("mean [95 %, by {}]", comparison.cluster),
            fmt::format("difference to {} [95 %]", comparison.reference), "ratio [95 %]", "p"},
           {}});
    }
    tables.back().rows.push_back(cells(row));
  }
  return tables;
}

std::vector<TextTable> text_tables(const Figure& figure) {
  std::vector<TextTable> tables;
  for (const FigurePanel& panel : figure.panels) {
    tables.push_back(table_of(panel, figure.x_label));
  }
  return tables;
}

TextTable overview(const std::vector<Comparison>& comparisons) {
  TextTable table{"", {""}, {}};
  for (const Comparison& comparison : comparisons) {
    table.header.push_back(comparison.title);
    for (const ComparisonRow& row : comparison.rows) {
      if (row.panel != comparison.rows.back().panel) continue;
      auto line =
          std::ranges::find_if(table.rows, [&](const auto& r) { return r[0] == row.level; });
      if (line == table.rows.end()) {
        table.rows.push_back({row.level});
        line = table.rows.end() - 1;
      }
      line->resize(table.header.size() - 1);
      line->push_back(with_interval(row.mean, row.interval, row.clusters));
    }
  }
  for (auto& row : table.rows) row.resize(table.header.size());
  return table;
}

std::vector<std::string> verdicts(const std::vector<Comparison>& comparisons) {
  std::vector<std::string> lines;
  for (const Comparison& comparison : comparisons) {
    for (const ComparisonRow& row : comparison.rows) {
      if (row.panel != comparison.rows.back().panel || !row.difference) continue;
      const Difference& d = *row.difference;
      const char* sign = d.mean > 0.0 ? "+" : "";
      lines.push_back(fmt::format("{} against {}: {} {}{}, {} ({} pair{})", row.level,
                                  comparison.reference, comparison.name, sign,
                                  with_interval(d.mean, d.interval, d.clusters),
                                  verdict(comparison, d), d.pairs, d.pairs == 1 ? "" : "s"));
    }
  }
  return lines;
}

}  // namespace vantage
