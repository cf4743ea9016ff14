#include "vantage/runtime/run_summary.hpp"

#include <nlohmann/json.hpp>

#include "vantage/core/hash.hpp"

namespace vantage {

std::string_view status_name(EpisodeStatus status) {
  switch (status) {
    case EpisodeStatus::completed: return "completed";
    case EpisodeStatus::failed: return "failed";
    case EpisodeStatus::diverged: return "diverged";
    case EpisodeStatus::interrupted: return "interrupted";
  }
  return "?";
}

nlohmann::ordered_json summary_json(const RunIdentity& identity, const RunSummary& summary) {
  return {{"task", identity.task},
          {"status", status_name(summary.status)},
          {"reason", summary.reason},
          {"seed", identity.seed},
          {"scene", identity.scene},
          {"method", identity.method},
          {"simulated_time_s", summary.simulated_time_s},
          {"wall_time_s", summary.wall_time_s},
          {"real_time_factor",
           summary.wall_time_s > 0.0 ? summary.simulated_time_s / summary.wall_time_s : 0.0},
          {"path_length_m", summary.path_length_m},
          {"collisions", summary.collisions},
          {"state_hash", hash_text(summary.state_hash)}};
}

}  // namespace vantage
