/// A task is what an episode is about. Each is a folder beside this file, an options struct whose
/// fields are YAML keys, and one line of the variant at the foot.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <concepts>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/tasks/change_detection/change_detection_task.hpp"
#include "vantage/tasks/exploration/exploration.hpp"
#include "vantage/tasks/recognition/recognition_task.hpp"
#include "vantage/tasks/tabletop/tabletop.hpp"
#include "vantage/tasks/trajectory/trajectory_flight.hpp"

namespace vantage {

/// What a task answers. No other place asks which task it is. A task that leaves options to the
/// scene has `resolve(setup)` too, which fills them in once files are found.
template <class T>
concept EpisodeTask = HasFields<T> &&
    requires(const T& task, T& mutable_task, const EpisodeOptions& options,
             const EpisodeSetup& setup, const RunRequest& request,
             const nlohmann::ordered_json& metrics, const std::filesystem::path& base) {
  /// Its value of `task:` in an episode's file, and what metrics.json calls it.
  { T::name } -> std::convertible_to<std::string_view>;
  { T::metrics_task() } -> std::same_as<std::string_view>;
  /// The kind of robot that it needs, as robot.yaml calls it.
  { T::robot_kind() } -> std::same_as<std::string_view>;
  /// The method that an episode tries out, for tables and figures.
  { task.method_name() } -> std::same_as<std::string>;
  /// Throws ConfigError where the task and the rest of the episode do not go together.
  task.check_with(options);
  /// Names files so that they are found again from any directory; `base` is the episode file's.
  mutable_task.find_files(base);
  /// Files that it reads beside scene and robot.
  { task.inputs() } -> std::same_as<std::vector<InputFile>>;
  /// What its world is compiled from.
  { task.model_source(setup) } -> std::same_as<ModelSource>;
  { task.extent(setup) } -> std::same_as<TaskExtent>;
  /// A task whose map depends on its scene has a window(setup) besides, which is asked then.
  { task.window() } -> std::same_as<WindowContent>;
  { T::report() } -> std::same_as<ReportSections>;
  { T::measures() } -> std::same_as<Measures>;
  /// What the names in its run folders mean, beside run_records().
  { T::records() } -> std::same_as<RecordTexts>;
  /// A few lines on how an episode has ended.
  { T::outcome(metrics) } -> std::same_as<std::string>;
  /// Throws ConfigError or InputError if the episode cannot begin; runs nothing.
  task.require_start(setup);
  /// Makes its parts and runs them through run_episode().
  { task.run(request) } -> std::same_as<RunOutcome>;
};

using Task =
    std::variant<Tabletop, Exploration, RecognitionTask, ChangeDetectionTask, TrajectoryFlight>;
template <>
inline constexpr std::string_view strategy_family<Task> = "task";

/// Calls `f` with a default-made task of each kind, in the order of the variant.
void for_each_task(auto&& f) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (f(std::variant_alternative_t<I, Task>{}), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Task>>{});
}

namespace detail {
template <class Variant>
inline constexpr bool kAllAreTasks = false;
template <class... T>
inline constexpr bool kAllAreTasks<std::variant<T...>> = (EpisodeTask<T> && ...);
static_assert(kAllAreTasks<Task>, "every alternative answers what EpisodeTask asks");
}  // namespace detail

}  // namespace vantage
