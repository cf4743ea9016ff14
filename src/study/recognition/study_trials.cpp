#include "vantage/study/recognition/study_trials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace vantage {

PartedViews parted(const DatasetIndex& dataset, const ObjectStates& states) {
  PartedViews parts;
  for (const ViewEntry& view : dataset.views) {
    const bool known = std::ranges::find(states.objects, view.name.object) != states.objects.end();
    (known ? parts.known : parts.unknown).views.push_back(view);
  }
  return parts;
}

UnknownViews unknown_views(DatasetIndex of_dataset, const RecognitionModel& model,
                           const RecognitionStudyOptions& options, const LongWork& how) {
  if (options.unknown_starts == 0) return {};
  if (!options.unknown_of_dataset) of_dataset = {};
  for (const std::string& folder : options.unknown_datasets) {
    const PartedViews parts = parted(index_dataset(folder), model.states);
    if (!parts.known.views.empty()) {
      throw ConfigError(fmt::format("unknown_datasets: {}: the model knows {}", folder,
                                    parts.known.views.front().name.object));
    }
    of_dataset.views.insert(of_dataset.views.end(), parts.unknown.views.begin(),
                            parts.unknown.views.end());
  }
  if (of_dataset.views.empty()) {
    throw ConfigError(
        "unknown_starts: there is no object that the model does not know; give unknown_datasets, "
        "or train with leave_out");
  }
  UnknownViews unknown{.test = read_test_views(of_dataset, model, options.video, how),
                       .starts = {}};
  unknown.starts = draw_starts(unknown.test, options.unknown_starts, options.seed);
  return unknown;
}

std::vector<Eigen::MatrixXf> unknown_likelihoods(const Recogniser& recogniser,
                                                 const Trials& trials) {
  if (trials.unknown.starts.empty()) return {};
  return log_likelihoods(recogniser, trials.unknown.test, trials.how);
}

MethodTrials trials_of(const Recogniser& recogniser, const Method& method,
                       std::span<const Eigen::MatrixXf> likelihoods,
                       std::span<const Eigen::MatrixXf> of_unknown, const Trials& trials) {
  const std::uint64_t seed = trials.options.seed;
  MethodTrials result{.method = method.name,
                      .trials = run_trials(recogniser, trials.test, likelihoods, trials.starts,
                                           method, seed, trials.how)};
  const UnknownViews& unknown = trials.unknown;
  if (unknown.starts.empty() || recogniser.states.unknown_size() == 0) return result;
  result.unknown.trials =
      run_trials(recogniser, unknown.test, of_unknown, unknown.starts, method, seed, trials.how);
  for (const Start& start : unknown.starts) {
    result.unknown.category_known.push_back(unknown.test.category[start.view] != kNoCategory);
  }
  return result;
}

}  // namespace vantage
