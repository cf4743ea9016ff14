/// How well the scans of an episode fit together, at its end.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace vantage {

struct LocalisationSummary {
  std::size_t loops = 0;          ///< found and confirmed
  std::size_t loops_refused = 0;  ///< found, and not confirmed or contradicted
  std::size_t corrections = 0;    ///< of all poses and the map
  double pose_sigma_m = 0.0;      ///< greatest of the scans
  std::optional<double>
      contradicted_share;  ///< map_contradiction.hpp; none where no loops are closed
  std::string doubt;       ///< why the map is in doubt; empty if it is not
};

}  // namespace vantage
