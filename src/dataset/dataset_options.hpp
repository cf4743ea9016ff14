/// What a rendered dataset is made of.
#pragma once

#include <cstdint>
#include <string>

#include "vantage/core/fields.hpp"

namespace vantage {

struct DatasetOptions {
  /// Of objects, placement, lighting and noise. The same seed gives the same files.
  std::uint64_t seed = 1;
  int session = 1;         ///< of the recording; another has other placement, light and noise
  int objects = 326;       ///< the first of the catalogue, or of `models`; more take longer
  double step_deg = 20.0;  ///< of the turntable; lower gives more views
  /// Folder of <name>/{model.obj, texture.png} instead of the catalogue; empty: the catalogue
  std::string models = {};
  double distance_m = 0.85;   ///< camera to the turntable's axis; higher makes crops smaller
  double placement_m = 0.01;  ///< largest offset of an object from the axis, changes per video
  /// Strength of the changes of light between videos; 0: none. At 1 they bias colours by as much
  /// as near-duplicates differ, which no number of views averages out.
  double lighting = 0.3;
  double colour_noise = 4.0;  ///< standard deviation of a colour value, of 255; higher is noisier
  bool depth_noise = true;    ///< false: exact depth
  double edge_dropout = 0.3;  ///< probability that a pixel beside a depth edge has no depth
  /// The object is cut out by depth, as a robot does that sees it on a stand, not along its
  /// outline: a little of the table round its foot is then taken for it, and less of what lies
  /// flat.
  bool cut_by_depth = false;
  int mask_growth_px = 1;  ///< how far the mask reaches over the object's edge
  int margin_px = 3;       ///< of the crop round the mask
  int supersampling = 3;   ///< rays a pixel each way, odd; higher is smoother and slower
  void fields(auto&& f) {
    f("seed", seed);
    f("session", session, at_least(1));
    f("objects", objects, between(1, 100000));
    f("step_deg", step_deg, between(0.1, 360.0));
    f("models", models);
    f("distance_m", distance_m, between(0.3, 3.0));
    f("placement_m", placement_m, between(0.0, 0.1));
    f("lighting", lighting, between(0.0, 2.0));
    f("colour_noise", colour_noise, between(0.0, 100.0));
    f("depth_noise", depth_noise);
    f("edge_dropout", edge_dropout, between(0.0, 1.0));
    f("cut_by_depth", cut_by_depth);
    f("mask_growth_px", mask_growth_px, between(0, 20));
    f("margin_px", margin_px, between(0, 50));
    f("supersampling", supersampling, between(1, 7));
  }
  void check() const;  ///< @throws ConfigError if supersampling is even
  /// Whole steps of the turntable in a turn.
  [[nodiscard]] int frames() const;
};

}  // namespace vantage
