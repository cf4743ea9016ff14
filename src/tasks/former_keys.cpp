#include "vantage/tasks/former_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

struct RenamedKey {
  std::string_view former;
  std::string_view now;
};

/// Dotted, from the root of an episode.
constexpr auto kRenamed = std::to_array<RenamedKey>({
    {"most_views", "max_views"},
    {"pilot", "tracking"},
    {"tracking.controller.push_per_s", "tracking.controller.disturbance_per_s"},
    {"tracking.controller.push_max_m_s2", "tracking.controller.disturbance_max_m_s2"},
    {"found", "tracker"},
    {"tracker.min_sightings", "tracker.min_detections"},
    {"looks", "observations"},
    {"observations.look_at_known", "observations.observe_known"},
    {"observations.least_gain_nats", "observations.min_gain_nats"},
    {"picture_rate_hz", "image_rate_hz"},
    {"planner.look_m", "planner.observation_distance_m"},
    {"planner.leash_m", "planner.path_deviation_tolerance_m"},
    {"planner.leash_weight", "planner.path_deviation_weight"},
    {"planner.search.least_m2", "planner.search.min_area_m2"},
    {"method.sensitivity", "method.inverse_temperature"},
    {"method.least_sigma", "method.min_sigma"},
    {"method.least_step", "method.min_step"},
    {"most_candidates", "max_candidates"},
    {"wall_novelty_m", "reference_novelty_m"},
    {"headroom.most_unseen", "headroom.max_unseen"},
    {"registration.min_pairs", "registration.min_correspondences"},
    {"registration.min_constraint_pairs", "registration.min_constraint_correspondences"},
});

/// Sections that held the keys of a task, which now stand at the top level.
constexpr auto kSections = std::to_array<std::string_view>(
    {"exploration", "recognition", "change_detection", "trajectory"});

/// What to write instead of the key; empty: it is none of a former version.
std::string instead_of(const ConfigNode& node, const std::string& path) {
  const auto renamed = std::ranges::find(kRenamed, path, &RenamedKey::former);
  if (renamed != kRenamed.end()) return fmt::format("is called '{}' now", renamed->now);
  if (path == "setting") {
    return node.scalar == "office" ? "is no key any more, write 'task: exploration'"
                                   : "is no key any more, write 'task: tabletop'";
  }
  if (path == "task" && node.scalar == "next_best_view") {
    return "next_best_view is two tasks now: write task: tabletop, or for setting: office task: "
           "exploration";
  }
  if (std::ranges::find(kSections, path) != kSections.end() && node.kind == ConfigNode::Kind::map) {
    const std::string first = node.entries.empty() ? "key" : node.entries.front().first;
    return fmt::format("the keys of a task stand at the top level now: write {} in place of {}.{}",
                       first, path, first);
  }
  return {};
}

void collect(const ConfigNode& node, const std::string& prefix,
             std::vector<std::string>& problems) {
  for (const auto& [name, child] : node.entries) {
    const std::string path = fmt::format("{}{}{}", prefix, prefix.empty() ? "" : ".", name);
    if (const std::string now = instead_of(child, path); !now.empty()) {
      problems.push_back(fmt::format("{}: {}", child.where(), now));
    } else {
      collect(child, path, problems);
    }
  }
}

}  // namespace

void reject_former_keys(const ConfigNode& root) {
  std::vector<std::string> problems;
  collect(root, "", problems);
  if (!problems.empty()) throw ConfigError(problems);
}

}  // namespace vantage
