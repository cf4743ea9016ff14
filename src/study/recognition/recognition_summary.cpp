#include <algorithm>
#include <limits>
#include <string>

#include "vantage/study/recognition/recognition_study.hpp"

namespace vantage {
namespace {

constexpr auto kRandom = "random";
constexpr auto kRandomAll = "random, all features";
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Estimate estimate_of(std::span<const double> values, const Clusters& clusters, std::uint64_t seed,
                     const std::string& what) {
  if (values.empty()) return {kNan, {kNan, kNan}};
  Rng rng = Rng::stream(seed, what);
  return {
      .mean = mean(values),
      .interval = bootstrap_mean(values, clusters, rng, {.resamples = 2000, .confidence = 0.95})};
}

/// Of objects that the model was trained on.
MethodTrials known_of(const MethodTrials& method) {
  MethodTrials known = method;
  std::erase_if(known.trials, [](const Trial& trial) { return trial.object < 0; });
  return known;
}

std::vector<double> values_of(const MethodTrials& method, auto&& value) {
  std::vector<double> values;
  for (const Trial& trial : method.trials) values.push_back(static_cast<double>(value(trial)));
  return values;
}

double percent_correct(const Trial& trial) { return trial.correct ? 100.0 : 0.0; }

PairedEstimate paired(const MethodTrials& all, const MethodTrials& all_of_reference,
                      std::uint64_t seed) {
  const MethodTrials method = known_of(all);
  const MethodTrials reference = known_of(all_of_reference);
  const Clusters clusters = clusters_of_objects(method.trials);
  const auto differences = [&](auto&& value) {
    std::vector<double> values = values_of(method, value);
    const std::vector<double> others = values_of(reference, value);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] -= others[i];
    return values;
  };
  const std::string what = method.method + " - " + reference.method;
  const std::vector<double> accuracy = differences(percent_correct);
  Rng rng = Rng::stream(seed, "p " + what);
  return {.reference = reference.method,
          .accuracy_percent = estimate_of(accuracy, clusters, seed, "accuracy " + what),
          .observations = estimate_of(differences([](const Trial& t) { return t.observations; }),
                                      clusters, seed, "observations " + what),
          .p_value = accuracy.empty()
                         ? 1.0
                         : sign_flip_p_value(cluster_sums(accuracy, clusters), rng, 2000)};
}

MethodSummary summary_of(const MethodTrials& method, std::uint64_t seed) {
  const MethodTrials known = known_of(method);
  const Clusters of_all = clusters_of_objects(method.trials);
  const Clusters of_known = clusters_of_objects(known.trials);
  const auto mean_of = [&](auto&& value) { return mean(values_of(method, value)); };
  const Estimate category = estimate_of(
      values_of(method, [](const Trial& t) { return t.category_correct ? 100.0 : 0.0; }), of_all,
      seed, "category " + method.method);
  MethodSummary summary{
      .method = method.method,
      .accuracy_percent = estimate_of(values_of(known, percent_correct), of_known, seed,
                                      "accuracy " + method.method),
      .category_percent = category.mean,
      .category_interval = category.interval,
      .observations = estimate_of(values_of(method, [](const Trial& t) { return t.observations; }),
                                  of_all, seed, "observations " + method.method)};
  if (method.label_only) return summary;
  summary.bin_error = estimate_of(values_of(known, [](const Trial& t) { return t.bin_error; }),
                                  of_known, seed, "bin error " + method.method);
  summary.features = mean_of([](const Trial& t) { return t.features; });
  summary.feature_time_s = mean_of([](const Trial& t) { return t.feature_time_s; });
  summary.selection_time_s = mean_of([](const Trial& t) { return t.selection_time_s; });
  summary.view_time_s = mean_of([](const Trial& t) { return t.view_time_s; });
  summary.reliability = reliability_of(method.trials, seed);
  if (!method.unknown.trials.empty() && !known.trials.empty()) {
    summary.unknown = detection_of(known.trials, method.unknown, seed);
  }
  return summary;
}

}  // namespace

std::vector<MethodSummary> summaries(const RecognitionStudy& study) {
  std::vector<MethodSummary> all;
  for (const MethodTrials& method : study.methods) {
    MethodSummary& summary = all.emplace_back(summary_of(method, study.options.seed));
    for (const auto& name : {kSingleView, kRandom, kRandomAll}) {
      const auto reference = std::ranges::find(study.methods, name, &MethodTrials::method);
      if (reference == study.methods.end() || method.method == name) continue;
      summary.differences.push_back(paired(method, *reference, study.options.seed));
    }
  }
  return all;
}

}  // namespace vantage
