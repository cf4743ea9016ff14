/// A manifest.json as far as it decides whether a result fits.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "vantage/runtime/manifest.hpp"
#include "vantage/tasks/episode.hpp"

namespace vantage {

inline std::string manifest_of_files(const ResolvedEpisode& resolved) {
  return nlohmann::ordered_json{{"assets", asset_hashes(resolved.setup, inputs(resolved.task))}}
      .dump();
}

}  // namespace vantage
