#include "vantage/arena/arena_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "vantage/core/atomic_file.hpp"
#include "vantage/report/page.hpp"
#include "vantage/study/study_layout.hpp"

namespace vantage {
namespace {

constexpr std::size_t kSamples = 41;

/// Some scores as curves, with a mark for those that are alike.
struct Sampled {
  std::vector<Curve> curves;
  std::vector<std::size_t> clusters;
};

/// @param take (score, its place): whether it is one of them
/// @param until_s of an episode, what its curve is sampled over
template <class Take>
Sampled sampled(const StudyResults& results, const Leaderboard& board,
                const std::function<double(const EpisodeScore&)>& until_s, Take&& take) {
  const StudyLayout layout(results.study);
  Sampled found;
  for (const EpisodeScore& score : board.scores) {
    const EpisodePlace place = layout.place(results.plan[score.episode].levels);
    if (!take(score, place)) continue;
    found.curves.push_back(sampled_share_seen(score.steps, until_s(score), kSamples));
    found.clusters.push_back(place.cluster);
  }
  return found;
}

/// @param end of x, at the last sample
FigureSeries series_of(const Figure& figure, const std::string& panel, const Standing& standing,
                       const Sampled& sampled, double end) {
  const CurveSteps steps{0.0, end / static_cast<double>(kSamples - 1)};
  return mean_series(figure, panel, standing.planner, standing.level,
                     {sampled.curves, sampled.clusters}, steps, true);
}

double horizon_of(const StudyResults& results, const Leaderboard& board, std::size_t panel) {
  const StudyLayout layout(results.study);
  double horizon_s = 0.0;
  for (const EpisodeScore& score : board.scores) {
    if (layout.place(results.plan[score.episode].levels).panel != panel) continue;
    horizon_s = std::max(horizon_s, score.horizon_s);
  }
  return horizon_s;
}

std::string fixed(double value, int digits) { return fmt::format("{:.{}f}", value, digits); }

std::string with_dash(const std::optional<double>& value, int digits, double factor = 1.0) {
  return value ? fixed(factor * *value, digits) : "<span class=\"none\">–</span>";
}

/// A bar to the score, with its interval as a whisker.
std::string score_html(const Standing& s) {
  std::string whisker;
  std::string interval;
  if (s.interval) {
    whisker = fmt::format("<i class=\"whisker\" style=\"left:{:.2f}%;width:{:.2f}%\"></i>",
                          100.0 * s.interval->low, 100.0 * (s.interval->high - s.interval->low));
    interval = fmt::format("{:.3f} to {:.3f}", s.interval->low, s.interval->high);
  }
  return fmt::format(
      "<td class=\"score\"><div class=\"bar {}\"><i style=\"width:{:.2f}%\"></i>{}</div></td>"
      "<td class=\"value\">{:.3f}</td><td class=\"dim\">{}</td>",
      kind_name(s.kind), 100.0 * s.score, whisker, s.score, interval);
}

/// Against the reference; coloured where the interval leaves no doubt.
std::string difference_html(const Standing& s, const std::string& reference) {
  if (s.planner == reference) return "<td class=\"dim\">reference</td>";
  if (!s.difference || s.difference->pairs == 0) return "<td>–</td>";
  const Difference& d = *s.difference;
  const char* verdict = "";
  if (has_interval(d.clusters) && d.interval.low > 0.0) verdict = " class=\"good\"";
  if (has_interval(d.clusters) && d.interval.high < 0.0) verdict = " class=\"bad\"";
  return fmt::format("<td{} title=\"95 %: {:+.3f} to {:+.3f}, {} pairs\">{:+.3f}</td>", verdict,
                     d.interval.low, d.interval.high, d.pairs, d.mean);
}

std::string standing_html(const Standing& s, const std::string& reference, bool regrets) {
  std::string row = fmt::format(
      "<tr class=\"{}\"><td class=\"rank\">{}</td><th scope=\"row\">{} <span "
      "class=\"kind\">{}</span></th>",
      kind_name(s.kind), s.rank ? std::to_string(*s.rank) : "–", html_escaped(s.planner),
      s.kind == PlannerKind::built_in ? "" : kind_name(s.kind));
  row += score_html(s) + difference_html(s, reference);
  row += fmt::format("<td>{}</td><td>{}</td><td>{}</td>", fixed(100.0 * s.seen_share, 1),
                     with_dash(s.path_length_m, 1), with_dash(s.collisions, 2));
  row +=
      fmt::format("<td{}>{}/{}</td>", s.failed > 0 ? " class=\"bad\"" : "", s.failed, s.episodes);
  row += fmt::format("<td>{}</td><td>{}{}</td>", with_dash(s.decision_s, 1, 1e3),
                     with_dash(s.time_over_bound_90, 2),
                     s.bounded > 0 ? fmt::format(" <small>({})</small>", s.bounded) : "");
  if (regrets) row += fmt::format("<td>{}</td>", with_dash(s.regret_share, 1, 100.0));
  return row + "</tr>\n";
}

std::string board_html(const StudyResults& results, const Leaderboard& board) {
  const bool regrets = std::ranges::any_of(
      board.standings, [](const Standing& s) { return s.regret_share.has_value(); });
  const std::string& reference = results.study.report.reference;
  std::string rows;
  for (const Standing& standing : board.standings) {
    if (standing.episodes > 0) rows += standing_html(standing, reference, regrets);
  }
  return fmt::format(
      "<div class=\"table-wrap\"><table class=\"board\"><thead><tr><th></th><th>Planner</th>"
      "<th class=\"wide\" colspan=\"2\">Score</th><th>95 % interval</th><th>against {}</th>"
      "<th>seen at<br>the end, %</th><th>way, m</th><th>collisions</th><th>failed</th>"
      "<th>decision,<br>ms</th><th>time to 90 %<br>over bound</th>{}</tr></thead>\n"
      "<tbody>\n{}</tbody></table></div>\n",
      html_escaped(reference), regrets ? "<th>regret, %</th>" : "", rows);
}

/// Scores scene by scene, shaded from the worst to the best of each.
std::string scenes_html(const Leaderboard& board) {
  std::vector<std::string> panels;
  std::map<std::string, std::map<std::string, double>> by_panel;
  for (const ComparisonRow& row : board.comparison.rows) {
    if (row.panel == "all") continue;
    if (std::ranges::find(panels, row.panel) == panels.end()) panels.push_back(row.panel);
    by_panel[row.panel][row.level] = row.mean;
  }
  std::string head = "<th></th>";
  for (const std::string& panel : panels) head += "<th>" + html_escaped(panel) + "</th>";
  std::string rows;
  for (const Standing& standing : board.standings) {
    if (standing.episodes == 0) continue;
    rows += fmt::format("<tr><th scope=\"row\">{}</th>", html_escaped(standing.planner));
    for (const std::string& panel : panels) {
      const auto& scores = by_panel[panel];
      const auto own = scores.find(standing.planner);
      if (own == scores.end()) {
        rows += "<td>–</td>";
        continue;
      }
      const auto [worst, best] =
          std::ranges::minmax_element(scores, {}, [](const auto& entry) { return entry.second; });
      const double span = best->second - worst->second;
      const double shade = span > 0.0 ? (own->second - worst->second) / span : 0.0;
      rows += fmt::format("<td style=\"--shade:{:.0f}%\"{}>{:.3f}</td>", 60.0 * shade,
                          shade == 1.0 ? " class=\"best\"" : "", own->second);
    }
    rows += "</tr>\n";
  }
  return fmt::format(
      "<div class=\"table-wrap\"><table class=\"scenes\"><thead><tr>{}</tr></thead><tbody>\n{}"
      "</tbody></table></div>\n",
      head, rows);
}

std::string failures_html(const StudyResults& results, const Leaderboard& board) {
  std::string items;
  for (const EpisodeScore& score : board.scores) {
    if (!score.failed) continue;
    items += fmt::format("<li><b>{}</b> {}</li>\n", html_escaped(results.plan[score.episode].name),
                         html_escaped(score.reason));
  }
  if (items.empty()) return "<p class=\"note\">No episode failed.</p>";
  return fmt::format("<ul class=\"failures\">\n{}</ul>\n", items);
}

std::string tags_html(const StudyResults& results, const Leaderboard& board) {
  const auto tag = [](const std::string& text, const char* kind = "") {
    return fmt::format("<span class=\"tag {}\">{}</span>\n", kind, html_escaped(text));
  };
  std::string tags;
  for (const Factor& factor : results.study.factors) {
    const bool one = factor.levels.size() == 1;
    tags += tag(fmt::format("{} {}{}", factor.levels.size(), factor.name, one ? "" : "s"));
  }
  const std::size_t missing = results.plan.size() - board.scores.size();
  tags += missing == 0
              ? tag(fmt::format("all {} episodes run", results.plan.size()), "good")
              : tag(fmt::format("{} of {} episodes missing", missing, results.plan.size()), "warn");
  if (!results.study.split.empty()) tags += tag("split " + results.study.split);
  return tags;
}

/// Budgets, one after the other: "240 s in table_8".
std::string budgets_text(const StudyResults& results, const Leaderboard& board) {
  const StudyLayout layout(results.study);
  std::map<double, std::vector<std::string>> scenes;
  for (std::size_t p = 0; p < layout.panels().size(); ++p) {
    const double horizon_s = horizon_of(results, board, p);
    if (horizon_s > 0.0) scenes[horizon_s].push_back(layout.panels()[p]);
  }
  std::string text;
  for (const auto& [horizon_s, names] : scenes) {
    text += fmt::format("{}{:.0f} s in ", text.empty() ? "" : "; ", horizon_s);
    for (std::size_t i = 0; i < names.size(); ++i) text += (i == 0 ? "" : ", ") + names[i];
  }
  return text;
}

}  // namespace

Figure overall_figure(const StudyResults& results, const Leaderboard& board) {
  Figure figure{.name = "share_seen",
                .title = "All scenes",
                .subtitle =
                    "share of the observable cells seen against the share of the budget "
                    "of time, higher is better",
                .x_label = "budget of time, %",
                .y_label = "share seen",
                .panels = {{"", {}}}};
  const std::string& cluster = results.study.report.cluster;
  figure.note = fmt::format("Mean over episodes; band: 95 % bootstrap interval, {} resampled.",
                            cluster.empty() ? "pairs" : fmt::format("levels of {}", cluster));
  for (const Standing& standing : board.standings) {
    const Sampled curves = sampled(
        results, board, [](const EpisodeScore& score) { return score.horizon_s; },
        [&](const EpisodeScore&, const EpisodePlace& place) {
          return place.level == standing.level;
        });
    if (curves.curves.empty()) continue;
    figure.panels[0].series.push_back(series_of(figure, "", standing, curves, 100.0));
  }
  return figure;
}

Figure scene_figure(const StudyResults& results, const Leaderboard& board) {
  const StudyLayout layout(results.study);
  Figure figure{.name = "share_seen_by_scene",
                .title = "Scene by scene",
                .subtitle = "share of the observable cells seen against time",
                .x_label = "simulated time, s",
                .y_label = "share seen",
                .panels = {}};
  figure.note = "Mean over seeds; band: 95 % bootstrap interval.";
  for (std::size_t p = 0; p < layout.panels().size(); ++p) {
    FigurePanel panel{layout.panels()[p], {}};
    const double horizon_s = horizon_of(results, board, p);
    for (const Standing& standing : board.standings) {
      Sampled curves = sampled(
          results, board, [&](const EpisodeScore&) { return horizon_s; },
          [&](const EpisodeScore&, const EpisodePlace& place) {
            return place.level == standing.level && place.panel == p;
          });
      if (curves.curves.empty()) continue;
      for (std::size_t i = 0; i < curves.clusters.size(); ++i) curves.clusters[i] = i;
      panel.series.push_back(series_of(figure, panel.title, standing, curves, horizon_s));
    }
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

void write_arena_page(const StudyResults& results, const Leaderboard& board) {
  const Replacement replacements[] = {
      {"title", html_escaped(results.study.title)},
      {"tags", tags_html(results, board)},
      {"board", board_html(results, board)},
      {"budgets", html_escaped(budgets_text(results, board))},
      {"overall", figure_svg(overall_figure(results, board))},
      {"scenes", scenes_html(board)},
      {"by_scene", figure_svg(scene_figure(results, board))},
      {"failures", failures_html(results, board)},
      {"status", html_escaped(status_text(results.directory, results.plan, results.states))},
      {"study", html_escaped(results.study.yaml)}};
  write_file(results.directory / "arena.html", filled_page("arena.html", replacements));
  write_file(results.directory / "leaderboard.csv", leaderboard_csv(board));
}

}  // namespace vantage
