/// What a rendered dataset is made of.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vantage/core/fields.hpp"

namespace vantage {

struct DatasetOptions {
  std::uint64_t seed = 1;
  int session = 1;
  int objects = 326;
  double step_deg = 20.0;
  std::vector<int> videos{1, 2, 4};
  std::string models = {};
  double distance_m = 0.85;
  double placement_m = 0.01;
  /// At 1 changes of light bias colours by as much as near-duplicates differ, which no number of
  /// views averages out.
  double lighting = 0.3;
  double colour_noise = 4.0;
  bool depth_noise = true;
  double edge_dropout = 0.3;
  /// A little of the table round its foot is then taken for the object, and less of what lies flat.
  bool cut_by_depth = false;
  int mask_growth_px = 1;
  int margin_px = 3;
  int supersampling = 3;
  void fields(auto&& f) {
    f("seed", seed,
      "seed of objects, placement, lighting and noise; the same seed gives the same files");
    f("session", session,
      "number of the recording; another one has other placement, light and noise of the same "
      "objects",
      at_least(1));
    f("objects", objects,
      "number of objects, the first ones of the catalogue or of `models`; more take longer",
      between(1, 100000));
    f("step_deg", step_deg, "step of the turntable between views; lower gives more views",
      between(0.1, 360.0));
    f("videos", videos,
      "videos to record: 1, 2 and 4 are seen from 30, 45 and 60 deg of elevation; a video is the "
      "same whichever others there are",
      between(1, 4));
    f("models", models,
      "folder of objects `<name>/{model.obj, texture.png}` to use instead of the catalogue; empty: "
      "the catalogue");
    f("distance_m", distance_m,
      "distance from the camera to the turntable's axis; higher makes crops smaller",
      between(0.3, 3.0));
    f("placement_m", placement_m,
      "greatest random offset of an object from the axis, drawn for each video", between(0.0, 0.1));
    f("lighting", lighting,
      "strength of the changes of light between videos; higher makes colours less reliable; 0: "
      "none",
      between(0.0, 2.0));
    f("colour_noise", colour_noise,
      "standard deviation of the noise on colour values of 0 to 255; higher is noisier",
      between(0.0, 100.0));
    f("depth_noise", depth_noise,
      "true: depth with the noise of an RGB-D camera; false: exact depth");
    f("edge_dropout", edge_dropout,
      "probability that a pixel beside a depth edge has no depth; higher loses more of the outline",
      between(0.0, 1.0));
    f("cut_by_depth", cut_by_depth,
      "true: objects are cut out by depth, as a robot does that sees them on a support surface; "
      "false: along their outline");
    f("mask_growth_px", mask_growth_px, "how far the mask reaches beyond the object's edge",
      between(0, 20));
    f("margin_px", margin_px, "margin of the crop round the mask", between(0, 50));
    f("supersampling", supersampling,
      "rays per pixel along each image axis, odd; higher is smoother and slower", between(1, 7));
  }
  void check() const;  ///< @throws ConfigError: an odd supersampling, known videos, each once
  /// Whole steps of the turntable in a turn.
  [[nodiscard]] int frames() const;
};

}  // namespace vantage
