/// A worktop crowded with tall things, and with boxes that are open to one side: what a laser at
/// its height cannot look over.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/models/catalogue/table/table_scene.hpp"

namespace vantage {

/// As high as a kitchen's, so that the laser of the PR2-like robot, 1.05 m above the floor where
/// its lift is lowest, is lower than much of what stands there.
inline constexpr double kWorktop_m = 0.90;
inline constexpr double kClutterHeight_m = 0.35;  ///< of anything above the worktop

struct ClutterSceneOptions {
  std::string name = "clutter";
  std::uint64_t seed = 1;
  int objects = 15;
  int boxes = 3;
  int stacks = 2;
  double share_in_boxes = 0.45;
  double clearance_m = 0.01;
  std::vector<Furniture> furniture;
  void fields(auto&& f) {
    f("seed", seed, "seed of the objects' shapes, choice and places");
    f("objects", objects, "number of objects, those in boxes and on others included",
      between(0, 60));
    f("boxes", boxes, "number of boxes open to one side; more hide more", between(0, 6));
    f("stacks", stacks, "greatest number of objects that stand on another one", between(0, 20));
    f("share_in_boxes", share_in_boxes,
      "share of the objects that go into boxes and on top of them as long as there is room; higher "
      "hides more",
      between(0.0, 1.0));
    f("clearance_m", clearance_m,
      "least gap between the footprints of objects; higher spreads them out", between(0.0, 0.2));
  }
};

/// No two things overlap. @throws ConfigError if an option is out of range or it does not all fit.
TableScene make_clutter_scene(const ClutterSceneOptions& options);

/// The scenes checked in under models/scenes: 4, 8, 15, 25 and 40 objects, once to choose methods
/// and their parameters on (`clutter_dev_N`) and five times to report on (`clutter_report_N`,
/// `clutter_report_b_N` to `_e_N`).
std::vector<ClutterSceneOptions> clutter_scenes();

}  // namespace vantage
