#include "vantage/study/measures.hpp"

#include <algorithm>

namespace vantage {
namespace {

/// One list of the measures of all tasks, each name once.
struct MeasureList {
  std::vector<MeasureName> names;

  void add(const auto& measures) {
    for (const auto& measure : measures) {
      if (std::ranges::find(names, measure.name.name, &MeasureName::name) == names.end()) {
        names.push_back(measure.name);
      }
    }
  }
};

std::vector<std::string> names_of(const std::vector<MeasureName>& names) {
  std::vector<std::string> texts;
  texts.reserve(names.size());
  for (const MeasureName& name : names) texts.emplace_back(name.name);
  return texts;
}

std::optional<std::size_t> find(const std::vector<MeasureName>& names, std::string_view name) {
  const auto found = std::ranges::find(names, name, &MeasureName::name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

const std::vector<MeasureName>& scalar_measures() {
  static const std::vector<MeasureName> names = [] {
    MeasureList list;
    for_each_task([&](const auto& task) { list.add(task.measures().scalars); });
    return list.names;
  }();
  return names;
}

const std::vector<MeasureName>& curve_measures() {
  static const std::vector<MeasureName> names = [] {
    MeasureList list;
    for_each_task([&](const auto& task) { list.add(task.measures().curves); });
    return list.names;
  }();
  return names;
}

const CurveAxis& curve_axis(std::size_t curve) {
  static const std::vector<CurveAxis> axes = [] {
    std::vector<CurveAxis> found(curve_measures().size());
    for_each_task([&](const auto& task) {
      for (const CurveMeasure& measure : task.measures().curves) {
        found[find_curve(measure.name.name).value()] = measure.along;
      }
    });
    return found;
  }();
  return axes[curve];
}

std::vector<std::string> scalar_names() { return names_of(scalar_measures()); }
std::vector<std::string> curve_names() { return names_of(curve_measures()); }
std::optional<std::size_t> find_scalar(std::string_view name) {
  return find(scalar_measures(), name);
}
std::optional<std::size_t> find_curve(std::string_view name) {
  return find(curve_measures(), name);
}

EpisodeMeasures measure(const nlohmann::ordered_json& metrics, const ResolvedEpisode& resolved) {
  const MeasuredEpisode episode{metrics, extent(resolved).count};
  const Measures of_task = measures(resolved.task);
  EpisodeMeasures taken;
  taken.scalars.resize(scalar_measures().size());
  taken.curves.resize(curve_measures().size());
  for (const ScalarMeasure& scalar : of_task.scalars) {
    taken.scalars[find_scalar(scalar.name.name).value()] = scalar.of(episode);
  }
  for (const CurveMeasure& curve : of_task.curves) {
    taken.curves[find_curve(curve.name.name).value()] = curve.of(episode);
  }
  if (of_task.prediction_errors != nullptr) {
    taken.prediction_errors = of_task.prediction_errors(episode);
  }
  return taken;
}

}  // namespace vantage
