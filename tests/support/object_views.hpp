/// Views of simple objects, drawn without a renderer.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/perception/object_view.hpp"

namespace vantage {

/// A view of this size without an object: black, no depth, nothing in the mask.
inline ObjectView blank_view(int width_px, int height_px) {
  ObjectView view;
  view.width_px = width_px;
  view.height_px = height_px;
  const auto pixels = static_cast<std::size_t>(width_px) * height_px;
  view.rgb.assign(3 * pixels, 0);
  view.depth_m.assign(pixels, 0.0F);
  view.mask.assign(pixels, 0);
  view.left_px = 320 - width_px / 2;
  view.top_px = 240 - height_px / 2;
  return view;
}

struct BallLook {
  double radius_m = 0.1;
  double distance_m = 1.0;  ///< of its centre
  double stripes = 6.0;     ///< round it
  double phase_rad = 0.0;   ///< it is turned by
  double hue[3] = {0.9, 0.5, 0.2};
  double noise = 0.0;  ///< standard deviation of colour, 0 .. 1, and of depth, cm
};

/// A striped ball in the middle of the crop, on a level stand, in front of a wall half a metre
/// behind it. The mask reaches one pixel over its edge.
inline ObjectView ball_view(int side_px, const BallLook& look, Rng& rng) {
  ObjectView view = blank_view(side_px, side_px);
  const double reach_m = look.radius_m + look.distance_m / view.focal_px;
  for (int row = 0; row < side_px; ++row) {
    for (int column = 0; column < side_px; ++column) {
      const std::size_t i = view.index(row, column);
      const double x = (view.left_px + column - view.centre_px.x()) / view.focal_px;
      const double y = (view.top_px + row - view.centre_px.y()) / view.focal_px;
      const double off2 = (x * x + y * y) * look.distance_m * look.distance_m;
      view.mask[i] = off2 < reach_m * reach_m ? 1 : 0;
      const double inside = look.radius_m * look.radius_m - off2;
      const bool hit = inside > 0.0;
      const double wall_m = look.distance_m + 0.5;
      const double behind_m = y > 0.0 ? std::min(wall_m, look.radius_m / y) : wall_m;
      const double depth = hit ? look.distance_m - std::sqrt(inside) : behind_m;
      view.depth_m[i] = static_cast<float>(depth + 0.01 * look.noise * rng.normal());
      const double turn = std::atan2(x * look.distance_m, look.distance_m - depth) + look.phase_rad;
      const double shade = hit ? 0.6 + 0.4 * std::sin(look.stripes * turn + 20.0 * y) : 0.3;
      for (int c = 0; c < 3; ++c) {
        const double value = shade * (hit ? look.hue[c] : 1.0) + look.noise * rng.normal();
        view.rgb[3 * i + c] =
            static_cast<std::uint8_t>(std::lround(255.0 * std::min(1.0, std::max(0.0, value))));
      }
    }
  }
  return view;
}

/// Different balls, `count` of them.
inline std::vector<ObjectView> ball_views(int count, int side_px, Rng& rng,
                                          double distance_m = 1.0) {
  std::vector<ObjectView> views;
  for (int i = 0; i < count; ++i) {
    BallLook look{.radius_m = rng.uniform(0.05, 0.12), .distance_m = distance_m};
    look.stripes = rng.uniform(2.0, 12.0);
    look.phase_rad = rng.uniform(0.0, 2.0 * std::numbers::pi);
    for (double& c : look.hue) c = rng.uniform(0.1, 1.0);
    look.noise = 0.02;
    views.push_back(ball_view(side_px, look, rng));
  }
  return views;
}

}  // namespace vantage
