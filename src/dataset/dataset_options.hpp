/// What a rendered dataset is made of.
#pragma once

#include <cstdint>
#include <string>

#include "vantage/core/fields.hpp"

namespace vantage {

struct DatasetOptions {
  std::uint64_t seed = 1;
  int session = 1;
  int objects = 326;
  double step_deg = 20.0;
  std::string models = {};
  double distance_m = 0.85;
  double placement_m = 0.01;
  double lighting = 0.3;
  double colour_noise = 4.0;
  bool depth_noise = true;
  double edge_dropout = 0.3;
  bool cut_by_depth = false;
  int mask_growth_px = 1;
  int margin_px = 3;
  int supersampling = 3;
  void fields(auto&& f) {
    f("seed", seed,
      "Of objects, placement, lighting and noise. The same seed gives the same files.");
    f("session", session, "of the recording; another has other placement, light and noise",
      at_least(1));
    f("objects", objects, "the first of the catalogue, or of `models`; more take longer",
      between(1, 100000));
    f("step_deg", step_deg, "of the turntable; lower gives more views", between(0.1, 360.0));
    f("models", models,
      "Folder of <name>/{model.obj, texture.png} instead of the catalogue; empty: the catalogue");
    f("distance_m", distance_m, "camera to the turntable's axis; higher makes crops smaller",
      between(0.3, 3.0));
    f("placement_m", placement_m, "largest offset of an object from the axis, changes per video",
      between(0.0, 0.1));
    f("lighting", lighting,
      "Strength of the changes of light between videos; 0: none. At 1 they bias colours by as much "
      "as near-duplicates differ, which no number of views averages out.",
      between(0.0, 2.0));
    f("colour_noise", colour_noise,
      "standard deviation of a colour value, of 255; higher is noisier", between(0.0, 100.0));
    f("depth_noise", depth_noise, "false: exact depth");
    f("edge_dropout", edge_dropout, "probability that a pixel beside a depth edge has no depth",
      between(0.0, 1.0));
    f("cut_by_depth", cut_by_depth,
      "The object is cut out by depth, as a robot does that sees it on a stand, not along its "
      "outline: a little of the table round its foot is then taken for it, and less of what lies "
      "flat.");
    f("mask_growth_px", mask_growth_px, "how far the mask reaches over the object's edge",
      between(0, 20));
    f("margin_px", margin_px, "of the crop round the mask", between(0, 50));
    f("supersampling", supersampling, "rays a pixel each way, odd; higher is smoother and slower",
      between(1, 7));
  }
  void check() const;  ///< @throws ConfigError if supersampling is even
  /// Whole steps of the turntable in a turn.
  [[nodiscard]] int frames() const;
};

}  // namespace vantage
