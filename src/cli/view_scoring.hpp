/// `vantage score-views`: views on a map of the user's own, ranked.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/geometry/rgbd_camera.hpp"
#include "vantage/planners/candidate.hpp"
#include "vantage/planners/gain.hpp"
#include "vantage/planners/views/sampled_views.hpp"
#include "vantage/planners/views/score_views.hpp"

namespace vantage {

/// This struct is what `--set` reaches; `sensor` is the file of `--sensor` as well.
struct ViewScoring {
  std::uint64_t seed = 1;
  int threads = 2;
  FieldOfView sensor = kRgbdCamera;
  Gain gain = BeerLambertGain{};
  /// `beer_lambert` takes gain.a = transmission_per_m^(cell edge / m) from it.
  std::optional<double> transmission_per_m = {};
  ScoredRegion region;
  SampledViews views;
  void fields(auto&& f) {
    f("seed", seed, "seed of the sampled views");
    f("threads", threads, "worker threads; more are faster, results do not depend on them",
      between(1, 256));
    f("sensor", sensor,
      "field of view and range of the sensor, as a file of `--sensor` gives them");
    f("gain", gain, "what a view is worth, as in an episode");
    f("transmission_per_m", transmission_per_m,
      "share of a beam that passes a metre of unobserved space, for `beer_lambert` and `adaptive`; "
      "higher sees deeper; null: 0.5, unless `gain.a` is given",
      between(0.0, 1.0));
    f("region", region, "part of the map that counts");
    f("views", views,
      "how views are sampled in the map's free space where no file of `--views` is given");
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
