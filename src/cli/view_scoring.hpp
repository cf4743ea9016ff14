/// `vantage score-views`: views on a map of the user's own, ranked.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/planners/candidate.hpp"
#include "vantage/planners/gain.hpp"
#include "vantage/planners/views/sampled_views.hpp"
#include "vantage/planners/views/score_views.hpp"

namespace vantage {

/// This struct is what `--set` reaches; `sensor` is the file of `--sensor` as well.
struct ViewScoring {
  std::uint64_t seed = 1;
  int threads = 2;
  FieldOfView sensor{.half_width_rad = 0.5044,
                     .tilt_min_rad = -0.3927,
                     .tilt_max_rad = 0.3927,
                     .range_min_m = 0.8,
                     .range_max_m = 3.5};
  Gain gain = BeerLambertGain{};
  std::optional<double> transmission_per_m = {};
  ScoredRegion region;
  SampledViews views;
  void fields(auto&& f) {
    f("seed", seed, "of sampled views");
    f("threads", threads, "results do not depend on it", between(1, 256));
    f("sensor", sensor, "A Kinect-like RGB-D camera, 57.8 x 45 deg.");
    f("gain", gain, "@@");
    f("transmission_per_m", transmission_per_m,
      "Share of a beam that passes a metre of unobserved space, whatever the cell size; higher "
      "sees deeper. `beer_lambert` takes gain.a = 0.5^(cell edge / m) from it if neither is given.",
      between(0.0, 1.0));
    f("region", region, "@@");
    f("views", views, "@@");
  }
};

struct ScoreArguments {
  std::filesystem::path map;
  std::filesystem::path views;   ///< empty: sampled
  std::filesystem::path sensor;  ///< empty: the default one
  std::string gain;              ///< empty: as the overrides say
  std::string seed;
  std::vector<std::string> overrides;
};

struct ScoredViews {
  std::string map;
  double resolution_m = 0.0;  ///< of the map
  double cell_m = 0.0;        ///< of the grid that was looked at
  std::size_t occupied = 0;   ///< cells of the map
  std::size_t free = 0;
  Eigen::AlignedBox3d region_m;  ///< what counted, world
  FieldOfView sensor;
  Gain gain;
  std::vector<Candidate> views;  ///< best first; of equal ones the lower id
};

/// @throws ConfigError if the arguments do not go together, InputError naming the file if one
/// cannot be used.
ScoredViews run_view_scoring(const ScoreArguments& arguments);

std::string scores_text(const ScoredViews& scored);
nlohmann::ordered_json scores_json(const ScoredViews& scored);

}  // namespace vantage
