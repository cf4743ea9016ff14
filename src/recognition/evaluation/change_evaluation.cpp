#include "vantage/recognition/evaluation/change_evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace vantage {
namespace {

/// What the map says where `shown` is.
int expected_state(const ObjectStates& states, Change scenario, int shown, Rng& rng) {
  const auto any = [&](int count) {
    return static_cast<int>(rng.uniform_index(static_cast<std::size_t>(count)));
  };
  const int object = states.object_of(shown);
  if (scenario == Change::object) {
    const int other = (object + 1 + any(states.object_count() - 1)) % states.object_count();
    return states.state(other, any(states.bins));
  }
  if (scenario == Change::pose) {
    const int turned = (states.bin_of(shown) + 1 + any(states.bins - 1)) % states.bins;
    return states.state(object, turned);
  }
  return shown;
}

ChangeTrial trial_of(const ChangeReport& report) {
  ChangeTrial trial{.decision = report.change,
                    .p_changed = report.p_changed,
                    .observations = static_cast<int>(report.recognition.views.size())};
  for (const ViewReport& view : report.recognition.views) {
    trial.time_s += view.feature_time_s + view.selection_time_s + view.view_time_s;
  }
  return trial;
}

double share_of(const std::vector<ChangeTrial>& trials, auto&& right) {
  return static_cast<double>(std::ranges::count_if(trials, right)) /
         static_cast<double>(trials.size());
}

}  // namespace

double ChangeTrials::accuracy() const {
  return share_of(trials, [this](const ChangeTrial& trial) {
    return (trial.decision == Change::none) == (scenario == Change::none);
  });
}

double ChangeTrials::detectable_share() const {
  return share_of(trials, [](const ChangeTrial& trial) { return trial.detectable; });
}

double ChangeTrials::detectable_accuracy() const {
  if (scenario == Change::none) return accuracy();
  std::vector<ChangeTrial> detectable;
  std::ranges::copy_if(trials, std::back_inserter(detectable), &ChangeTrial::detectable);
  return share_of(detectable,
                  [](const ChangeTrial& trial) { return trial.decision != Change::none; });
}

double ChangeTrials::kind_accuracy() const {
  return share_of(trials, [this](const ChangeTrial& trial) { return trial.decision == scenario; });
}

std::vector<ChangeTrials> evaluate_changes(const Recogniser& recogniser, const TestViews& test,
                                           std::span<const Eigen::MatrixXf> log_likelihood,
                                           std::span<const Start> starts,
                                           const ChangeOptions& options, std::uint64_t seed,
                                           const LongWork& how) {
  expects(recogniser.states.object_count() > 1, "another object to expect");
  const std::array<ObjectViewChoice, 5> choices{
      RandomObjectView{}, StarView{}, JeffreysDivergence{}, LossOfEntropy{}, MutualInformation{}};
  std::vector<ChangeTrials> all;
  for (const Change scenario : {Change::none, Change::object, Change::pose}) {
    for (const ObjectViewChoice& views : choices) {
      ChangeOptions by = options;
      by.recognition.views.choice = views;
      ChangeTrials& result = all.emplace_back();
      result.method = strategy_name_of(views);
      result.scenario = scenario;
      result.trials.resize(starts.size());
      const std::string label = fmt::format("{} change, {}", to_string(scenario), result.method);
      work_through(starts.size(), how, label, [&](std::size_t i) {
        Rng rng = Rng::stream(seed, fmt::format("change {} {}", to_string(scenario), i));
        const int shown = test.shown[starts[i].view];
        const int expected = expected_state(recogniser.states, scenario, shown, rng);
        DatasetCamera camera(recogniser, test, log_likelihood, starts[i]);
        result.trials[i] =
            trial_of(detect_change(recogniser, by, expected, camera.as_object_camera(), rng));
        result.trials[i].detectable = distinguishable(recogniser, shown, expected);
      });
    }
  }
  return all;
}

}  // namespace vantage
