#include "vantage/cli/view_scoring.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include "vantage/core/data_root.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/planners/views/view_list.hpp"
#include "vantage/runtime/json.hpp"

namespace vantage {
namespace {

constexpr double kTransmissionPerM = 0.5;

ConfigNode read_configuration(const ScoreArguments& arguments) {
  ConfigNode root = ConfigNode::make_map();
  if (!arguments.sensor.empty()) {
    ConfigNode sensor = read_yaml(find_input(arguments.sensor, {}, "--sensor"));
    if (sensor.kind == ConfigNode::Kind::null) {
      throw ConfigError(arguments.sensor.string() +
                        ": empty; a sensor sets at least one key, as range_max_m: 5");
    }
    root.set("sensor", std::move(sensor));
  }
  if (!arguments.gain.empty()) {
    ConfigNode gain = ConfigNode::make_scalar(arguments.gain);
    gain.origin = "--gain";
    root.set("gain", std::move(gain));
  }
  std::vector<std::string> overrides = arguments.overrides;
  if (!arguments.seed.empty()) overrides.push_back("seed=" + arguments.seed);
  apply_overrides(root, overrides);
  if (root.find("views") != nullptr && !arguments.views.empty()) {
    throw ConfigError("--set views: nothing is sampled where --views names a file");
  }
  return root;
}

bool gives_a(const ConfigNode& root) {
  const ConfigNode* gain = root.find("gain");
  return gain != nullptr && gain->find("a") != nullptr;
}

/// One transmission for all unobserved cells, from what was given of gain.a and transmission_per_m.
void settle_transmission(ViewScoring& scoring, bool a_given, double cell_m) {
  const bool learns = std::holds_alternative<AdaptiveGain>(scoring.gain);
  const bool fades = std::holds_alternative<BeerLambertGain>(scoring.gain);
  if (learns && !scoring.transmission_per_m) {
    throw ConfigError(fmt::format(
        "gain: adaptive learns on a run how far beams reach, and a map does not tell: give "
        "--set transmission_per_m={}, or take beer_lambert",
        kTransmissionPerM));
  }
  if (!learns && !fades && scoring.transmission_per_m) {
    throw ConfigError(fmt::format(
        "transmission_per_m: the gain {} has no use for it; it belongs to beer_lambert, adaptive",
        strategy_name_of(scoring.gain)));
  }
  if (a_given && scoring.transmission_per_m) {
    throw ConfigError("transmission_per_m: gain.a is given as well, and says the same per cell");
  }
  if (!learns && (!fades || a_given)) return;
  const double per_m = scoring.transmission_per_m.value_or(kTransmissionPerM);
  scoring.gain = BeerLambertGain{.a = std::pow(per_m, cell_m)};
}

CellBlock require_region(const ScoredRegion& region, const OctomapFile& map) {
  CellBlock cells = region.cells(map);
  if (!cells.empty()) return cells;
  if (map.known().empty()) {
    throw InputError(map.name() +
                     ": the map has no known cell; region.min_m and region.max_m say what counts");
  }
  const Eigen::AlignedBox3d known = map.box_of(map.known());
  throw ConfigError(fmt::format(
      "region: min_m, max_m leave no cell; those known in {} span [{:g}, {:g}, {:g}] to [{:g}, "
      "{:g}, {:g}] m",
      map.name(), known.min().x(), known.min().y(), known.min().z(), known.max().x(),
      known.max().y(), known.max().z()));
}

std::vector<Candidate> sample(const ViewScoring& scoring, const OctomapFile& map,
                              const Eigen::AlignedBox3d& region_m) {
  const Eigen::Vector3d range_m = Eigen::Vector3d::Constant(scoring.sensor.range_max_m);
  Rng rng = Rng::stream(scoring.seed, "sampled views");
  return sample_views(scoring.views, map, {region_m.min() - range_m, region_m.max() + range_m},
                      rng);
}

}  // namespace

ScoredViews run_view_scoring(const ScoreArguments& arguments) {
  const ConfigNode root = read_configuration(arguments);
  ViewScoring scoring;
  read_into(root, scoring);
  std::vector<Candidate> views;
  if (!arguments.views.empty()) {
    views = read_views(find_input(arguments.views, {}, "--views"));
  }
  const OctomapFile map(arguments.map);
  settle_transmission(scoring, gives_a(root), scoring.region.cell_m(map));
  const Eigen::AlignedBox3d region_m = map.box_of(require_region(scoring.region, map));
  if (arguments.views.empty()) views = sample(scoring, map, region_m);
  const auto gains =
      score_views(map, scoring.region, scoring.gain, views, scoring.sensor, scoring.threads);
  for (std::size_t i = 0; i < views.size(); ++i) views[i].gain_bits = gains[i];
  std::ranges::stable_sort(views, {}, &Candidate::id);
  std::ranges::stable_sort(views, std::ranges::greater{}, &Candidate::gain_bits);
  return {.map = map.name(),
          .resolution_m = map.resolution_m(),
          .cell_m = scoring.region.cell_m(map),
          .occupied = map.occupied(),
          .free = map.free(),
          .region_m = region_m,
          .sensor = scoring.sensor,
          .gain = scoring.gain,
          .views = std::move(views)};
}

std::string scores_text(const ScoredViews& scored) {
  std::string text = fmt::format("{:>5} {:>6} {:>10} {:>10} {:>10} {:>8} {:>9} {:>14}\n", "rank",
                                 "id", "x_m", "y_m", "z_m", "yaw_rad", "pitch_rad",
                                 fmt::format("gain [{}]", unit_of(scored.gain)));
  for (std::size_t i = 0; i < scored.views.size(); ++i) {
    const Candidate& view = scored.views[i];
    const Eigen::Vector3d p = view.T_world_sensor.translation();
    text += fmt::format("{:>5} {:>6} {:>10.3f} {:>10.3f} {:>10.3f} {:>8.3f} {:>9.3f} {:>14.6g}\n",
                        i + 1, view.id, p.x(), p.y(), p.z(), yaw_of(view), pitch_of(view),
                        view.gain_bits);
  }
  return text;
}

nlohmann::ordered_json scores_json(const ScoredViews& scored) {
  nlohmann::ordered_json views = nlohmann::ordered_json::array();
  for (const Candidate& view : scored.views) {
    const Eigen::Vector3d p = view.T_world_sensor.translation();
    views.push_back({{"rank", views.size() + 1},
                     {"id", view.id},
                     {"x_m", p.x()},
                     {"y_m", p.y()},
                     {"z_m", p.z()},
                     {"yaw_rad", yaw_of(view)},
                     {"pitch_rad", pitch_of(view)},
                     {"gain", view.gain_bits}});
  }
  return {{"map",
           {{"path", scored.map},
            {"resolution_m", scored.resolution_m},
            {"occupied_cells", scored.occupied},
            {"free_cells", scored.free}}},
          {"region", box_json(scored.region_m)},
          {"cell_m", scored.cell_m},
          {"sensor", config_json(write_node(scored.sensor))},
          {"gain", config_json(write_node(scored.gain))},
          {"unit", unit_of(scored.gain)},
          {"views", std::move(views)}};
}

}  // namespace vantage
