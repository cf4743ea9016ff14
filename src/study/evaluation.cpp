#include "vantage/study/evaluation.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "vantage/core/error.hpp"
#include "vantage/report/former_run.hpp"
#include "vantage/study/study_layout.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The layout of a study's results, by the number of an episode in the plan.
class Layout : public StudyLayout {
 public:
  explicit Layout(const StudyResults& results) : StudyLayout(results.study), results_(results) {}

  [[nodiscard]] EpisodePlace at(std::size_t episode) const {
    return place(results_.plan[episode].levels);
  }
  [[nodiscard]] std::size_t level(std::size_t episode) const { return at(episode).level; }
  [[nodiscard]] Sample sample(std::size_t episode, std::size_t level, double value) const {
    return sample_at(at(episode), level, value);
  }

 private:
  const StudyResults& results_;
};

Comparison scalar_comparison(const StudyResults& results, const Layout& layout,
                             const std::string& name) {
  const std::size_t scalar = *find_scalar(name);
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < results.plan.size(); ++i) {
    if (!results.measures[i] || !results.measures[i]->scalars[scalar]) continue;
    samples.push_back(layout.sample(i, layout.level(i), *results.measures[i]->scalars[scalar]));
  }
  const MeasureName& measure = scalar_measures()[scalar];
  Comparison comparison =
      compare_levels(name, measure_text(measure), layout.panels(), layout.levels(),
                     layout.level_called(results.study.report.reference), samples);
  comparison.better = measure.better;
  comparison.cluster = results.study.report.cluster;
  return comparison;
}

/// A panel for each level of the panel factor, a series for each of `names`.
/// @param curve_of (episode, index of the name) -> pointer to its curve, or null
template <class CurveOf>
void add_panels(Figure& figure, const StudyResults& results, const Layout& layout,
                const std::vector<std::string>& names, const CurveSteps& steps, bool carry_last,
                CurveOf&& curve_of) {
  const auto& panels = layout.panels();
  for (std::size_t p = 0; p < panels.size(); ++p) {
    FigurePanel panel{panels[p], {}};
    for (std::size_t s = 0; s < names.size(); ++s) {
      std::vector<Curve> curves;
      std::vector<std::size_t> clusters;
      for (std::size_t i = 0; i < results.plan.size(); ++i) {
        if (!results.measures[i] || layout.at(i).panel != p) continue;
        if (const Curve* curve = curve_of(i, s)) {
          curves.push_back(*curve);
          clusters.push_back(layout.at(i).cluster);
        }
      }
      if (curves.empty()) continue;
      panel.series.push_back(
          mean_series(figure, panels[p], names[s], s, {curves, clusters}, steps, carry_last));
    }
    figure.panels.push_back(std::move(panel));
  }
}

/// What a curve's values are of: scans, views, waypoints.
std::string steps_of(const StudyResults& results) {
  return fmt::format("{}s", report_sections(results.plan.front().resolved.task).step_word);
}

void note_cluster(Figure& figure, const std::string& cluster) {
  if (cluster.empty()) return;
  figure.note = fmt::format(
      "Mean over episodes; band: 95 % bootstrap interval of the mean, resampled by {}.", cluster);
}

Figure curve_figure(const StudyResults& results, const Layout& layout, const std::string& name) {
  const std::size_t curve = *find_curve(name);
  const MeasureName& measure = curve_measures()[curve];
  const CurveAxis& along = curve_axis(curve);
  Figure figure{.name = name,
                .title = results.study.title,
                .subtitle = measure_text(measure),
                .x_label = along.label.empty() ? steps_of(results) : std::string(along.label),
                .y_label = std::string(measure.title),
                .panels = {}};
  note_cluster(figure, results.study.report.cluster);
  add_panels(figure, results, layout, layout.levels(), {along.first, along.step}, true,
             [&](std::size_t episode, std::size_t level) -> const Curve* {
               if (layout.level(episode) != level) return nullptr;
               return &results.measures[episode]->curves[curve];
             });
  return figure;
}

const Curve* curve_named(const PredictionErrors& errors, const std::string& name) {
  const auto found = std::ranges::find(errors, name, &std::pair<std::string, Curve>::first);
  return found == errors.end() ? nullptr : &found->second;
}

/// Of the first episode of that level that has any.
std::vector<std::string> predictors_of(const StudyResults& results, const Layout& layout,
                                       std::size_t level) {
  for (std::size_t i = 0; i < results.plan.size(); ++i) {
    if (!results.measures[i] || layout.level(i) != level) continue;
    std::vector<std::string> predictors;
    for (const auto& [name, curve] : results.measures[i]->prediction_errors) {
      predictors.push_back(name);
    }
    if (!predictors.empty()) return predictors;
  }
  return {};
}

/// That of the reference's method; the first one if it predicts nothing.
std::size_t reference_among(const std::vector<std::string>& predictors, const StudyResults& results,
                            const Layout& layout) {
  std::string reference;
  for (std::size_t i = 0; i < results.plan.size(); ++i) {
    if (layout.level(i) == layout.level_called(results.study.report.reference)) {
      reference = method_name(results.plan[i].resolved.task);
    }
  }
  const auto found = std::ranges::find(predictors, reference);
  return found == predictors.end() ? 0 : static_cast<std::size_t>(found - predictors.begin());
}

Figure predictors_figure(const StudyResults& results, const std::string& what,
                         const std::string& title) {
  Figure figure{.name = "predictors",
                .title = results.study.title,
                .subtitle = what,
                .x_label = steps_of(results),
                .y_label = title,
                .panels = {}};
  note_cluster(figure, results.study.report.cluster);
  return figure;
}

/// All predictors along the episodes of one level.
void add_predictors(Evaluation& evaluation, const StudyResults& results, const Layout& layout) {
  const StudyReport& report = results.study.report;
  const std::size_t along = layout.level_called(report.predictors_along);
  const std::vector<std::string> predictors = predictors_of(results, layout, along);
  if (predictors.empty()) return;
  const auto error_of = [&](std::size_t episode, std::size_t predictor) -> const Curve* {
    if (layout.level(episode) != along) return nullptr;
    return curve_named(results.measures[episode]->prediction_errors, predictors[predictor]);
  };
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < results.plan.size(); ++i) {
    for (std::size_t p = 0; results.measures[i] && p < predictors.size(); ++p) {
      const Curve* curve = error_of(i, p);
      if (curve == nullptr || curve->empty()) continue;
      samples.push_back(layout.sample(i, p, mean(*curve)));
    }
  }
  const std::string title = "absolute prediction error, cells";
  const std::string what = fmt::format("{}, along the episodes of {}, {}", title,
                                       report.predictors_along, direction_text(Better::lower));
  evaluation.comparisons.push_back(compare_levels("predictors", what, layout.panels(), predictors,
                                                  reference_among(predictors, results, layout),
                                                  samples));
  evaluation.comparisons.back().better = Better::lower;
  evaluation.comparisons.back().cluster = report.cluster;
  Figure figure = predictors_figure(results, what, title);
  add_panels(figure, results, layout, predictors, {.first_x = 2.0}, false, error_of);
  evaluation.figures.push_back(std::move(figure));
}

}  // namespace

bool StudyResults::complete() const {
  return std::ranges::all_of(states,
                             [](EpisodeState state) { return state == EpisodeState::completed; });
}

nlohmann::ordered_json episode_metrics(const StudyResults& results, std::size_t i) {
  Json metrics =
      read_json_or_null(episode_folder(results.directory, results.plan[i]) / "metrics.json");
  bring_up_to_date(metrics);
  return metrics;
}

StudyResults read_study_results(const fs::path& study_dir) {
  StudyResults results;
  results.study = read_study(study_dir / "study.yaml");
  results.directory = study_dir;
  results.plan = plan_study(results.study);
  results.states = episode_states(study_dir, results.plan);
  results.measures.resize(results.plan.size());
  for (std::size_t i = 0; i < results.plan.size(); ++i) {
    // What failed has come to something as well; leaving it out would flatter what fails.
    const EpisodeState state = results.states[i];
    if (state != EpisodeState::completed && state != EpisodeState::failed) continue;
    try {
      results.measures[i] = measure(episode_metrics(results, i), results.plan[i].resolved);
    } catch (const nlohmann::json::exception& error) {
      const fs::path file = episode_folder(study_dir, results.plan[i]) / "metrics.json";
      throw InputError(fmt::format("{}: {}", file.string(), error.what()));
    }
  }
  return results;
}

Evaluation evaluate(const StudyResults& results) {
  const Layout layout(results);
  Evaluation evaluation;
  for (const auto& table : results.study.report.tables) {
    evaluation.comparisons.push_back(scalar_comparison(results, layout, table));
  }
  for (const auto& curve : results.study.report.curves) {
    evaluation.figures.push_back(curve_figure(results, layout, curve));
  }
  if (!results.study.report.predictors_along.empty()) add_predictors(evaluation, results, layout);
  return evaluation;
}

}  // namespace vantage
