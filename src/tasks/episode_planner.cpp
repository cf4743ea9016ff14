#include "vantage/tasks/episode_planner.hpp"

#include <concepts>
#include <cstdint>
#include <utility>
#include <variant>

#include "vantage/core/names.hpp"
#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

template <class Task>
PlannerIntroduction introduction_of(const Task& task, std::uint64_t seed) {
  PlannerIntroduction introduction{
      .task = std::string(Task::name),
      .seed = static_cast<std::uint32_t>(Rng::stream(seed, "external planner").next() >> 32U),
      .scans = task.scans,
      .gain = strategy_label(task.gain),
      .gain_unit = std::string(unit_of(task.gain)),
      .budget = {}};
  if (task.budget.time_s) introduction.budget.time_s = *task.budget.time_s;
  if (task.budget.energy_j) introduction.budget.energy_j = *task.budget.energy_j;
  return introduction;
}

}  // namespace

std::unique_ptr<ExternalPlanner> external_planner(const ResolvedEpisode& resolved) {
  return std::visit(
      [&]<class T>(const T& task) -> std::unique_ptr<ExternalPlanner> {
        if constexpr (std::derived_from<T, MappingOptions>) {
          const auto* choice = std::get_if<ExternalChoice>(&task.choice);
          if (choice == nullptr) return nullptr;
          require_planner(task.choice);
          return std::make_unique<ExternalPlanner>(
              *choice, introduction_of(task, resolved.setup.options.seed));
        }
        return nullptr;
      },
      resolved.task);
}

}  // namespace vantage
