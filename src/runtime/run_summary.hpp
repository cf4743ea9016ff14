/// What metrics.json says of every task.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <string_view>

#include "vantage/runtime/episode_loop.hpp"

namespace vantage {

struct RunSummary {
  EpisodeStatus status = EpisodeStatus::completed;
  std::string reason;  ///< why it ended
  double simulated_time_s = 0.0;
  double wall_time_s = 0.0;
  double path_length_m = 0.0;
  int collisions = 0;
  std::uint64_t state_hash = 0;
};

std::string_view status_name(EpisodeStatus status);

/// Which episode it is of.
struct RunIdentity {
  std::string task;
  std::uint64_t seed = 0;
  std::string scene;
  std::string method;
};
nlohmann::ordered_json summary_json(const RunIdentity& identity, const RunSummary& summary);

}  // namespace vantage
