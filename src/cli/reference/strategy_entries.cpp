#include "vantage/belief/objects/transition.hpp"
#include "vantage/belief/observation/gaussian_statistics.hpp"
#include "vantage/belief/observation/psi_rule.hpp"
#include "vantage/cli/reference/entry.hpp"
#include "vantage/perception/features/feature.hpp"
#include "vantage/planners/choice/view_choice.hpp"
#include "vantage/planners/gain.hpp"
#include "vantage/planners/objects/feature_choice.hpp"
#include "vantage/planners/objects/object_view_choice.hpp"
#include "vantage/planners/trajectory/trajectory_method.hpp"
#include "vantage/recognition/dataset/held_out.hpp"
#include "vantage/recognition/evaluation/svm_baseline.hpp"
#include "vantage/sim/robots/robot_description.hpp"
#include "vantage/tasks/task.hpp"

namespace vantage {
namespace {

ReferenceEntry strategy_entry(const StrategyDescription& strategy) {
  ReferenceEntry entry{
      .name = std::string(strategy.name),
      .place = std::string(strategy.family),
      .text = std::string(strategy.text.summary),
      .formula = std::string(strategy.text.formula),
      .source = std::string(strategy.text.source),
      .parameters = strategy.parameters,
  };
  return entry;
}

/// Its keys are those of episodes.
template <class Variant>
constexpr bool kListsParameters =
    !std::is_same_v<Variant, Task> && !std::is_same_v<Variant, RobotKind>;

template <class Variant>
void add(std::vector<ReferenceEntry>& entries) {
  for (const StrategyDescription& strategy : describe_strategies<Variant>()) {
    ReferenceEntry entry = strategy_entry(strategy);
    if constexpr (std::is_same_v<Variant, Gain>)
      entry.unit = unit_of(make_strategy<Gain>(strategy.name));
    if (!kListsParameters<Variant>) entry.parameters.clear();
    entries.push_back(std::move(entry));
  }
}

}  // namespace

std::vector<ReferenceEntry> strategy_entries() {
  std::vector<ReferenceEntry> entries;
  add<Task>(entries);
  add<Gain>(entries);
  add<ViewChoice>(entries);
  add<Feature>(entries);
  add<InformationMeasure>(entries);
  add<FeatureStop>(entries);
  add<ObjectViewChoice>(entries);
  add<TrajectoryMethod>(entries);
  add<ViewPlan>(entries);
  add<TransitionModel>(entries);
  add<VarianceEstimate>(entries);
  add<PsiRule>(entries);
  add<HeldOut>(entries);
  add<Svm>(entries);
  add<RobotKind>(entries);
  add<BaseDrive>(entries);
  return entries;
}

}  // namespace vantage
