#include "vantage/dataset/sensing.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/perception/dataset_reader.hpp"
#include "vantage/perception/search/object_search.hpp"
#include "vantage/perception/table_segmentation.hpp"
#include "vantage/sim/sensors/camera.hpp"

namespace vantage {
namespace {

constexpr float kDepthEdge_m = 0.02F;

/// Of each colour, over a square of `side` rays that begins at `first`.
std::array<int, 3> sum_of_rays(const RenderedImages& drawn, std::size_t first, std::size_t side) {
  std::array<int, 3> sum{};
  for (std::size_t row = 0; row < side; ++row) {
    const std::uint8_t* value =
        drawn.rgb.data() + 3 * (first + row * static_cast<std::size_t>(drawn.width_px));
    for (std::size_t i = 0; i < side; ++i, value += 3) {
      for (std::size_t c = 0; c < 3; ++c) sum[c] += value[c];
    }
  }
  return sum;
}

/// The whole window at the camera's resolution.
ObjectView average_rays(const RenderedImages& drawn, int object_geom, const Session& session,
                        int rays) {
  const int side = drawn.width_px / rays;
  ObjectView view;
  view.width_px = view.height_px = side;
  view.left_px = kImageWidth_px / 2 - side / 2;
  view.top_px = kImageHeight_px / 2 - side / 2;
  view.focal_px = kFocal_px;
  view.up = up_in_camera(session.elevation_rad);
  const auto pixels = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  view.rgb.resize(3 * pixels);
  view.depth_m.resize(pixels);
  view.mask.resize(pixels);
  const auto width = static_cast<std::size_t>(drawn.width_px);
  const auto n = static_cast<std::size_t>(rays);
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    const std::size_t row = pixel / static_cast<std::size_t>(side);
    const std::size_t first = row * n * width + (pixel - row * static_cast<std::size_t>(side)) * n;
    const std::array<int, 3> sum = sum_of_rays(drawn, first, n);
    for (std::size_t c = 0; c < 3; ++c) {
      view.rgb[3 * pixel + c] = static_cast<std::uint8_t>(sum[c] / (rays * rays));
    }
    const std::size_t middle = first + n / 2 * width + n / 2;
    view.depth_m[pixel] = drawn.depth_m[middle];
    view.mask[pixel] = drawn.segmentation[middle] == object_geom ? 1 : 0;
  }
  return view;
}

void grow(ObjectView& view) {
  const std::vector<std::uint8_t> old = view.mask;
  for (int row = 1; row + 1 < view.height_px; ++row) {
    for (int column = 1; column + 1 < view.width_px; ++column) {
      for (int k = 0; k < 9; ++k) {
        view.mask[view.index(row, column)] |= old[view.index(row + k / 3 - 1, column + k % 3 - 1)];
      }
    }
  }
}

struct PixelBox {
  int top, left, bottom, right;  ///< half open
};

PixelBox box_of_mask(const ObjectView& view, int margin_px) {
  PixelBox box{view.height_px, view.width_px, 0, 0};
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = 0; column < view.width_px; ++column) {
      if (view.mask[view.index(row, column)] == 0) continue;
      box.top = std::min(box.top, row);
      box.left = std::min(box.left, column);
      box.bottom = std::max(box.bottom, row + 1);
      box.right = std::max(box.right, column + 1);
    }
  }
  return {std::max(box.top - margin_px, 0), std::max(box.left - margin_px, 0),
          std::min(box.bottom + margin_px, view.height_px),
          std::min(box.right + margin_px, view.width_px)};
}

ObjectView crop(const ObjectView& view, const PixelBox& box) {
  ObjectView cut = view;
  cut.width_px = box.right - box.left;
  cut.height_px = box.bottom - box.top;
  cut.left_px = view.left_px + box.left;
  cut.top_px = view.top_px + box.top;
  cut.rgb.clear();
  cut.depth_m.clear();
  cut.mask.clear();
  for (int row = box.top; row < box.bottom; ++row) {
    for (int column = box.left; column < box.right; ++column) {
      const std::size_t pixel = view.index(row, column);
      for (std::size_t c = 0; c < 3; ++c) cut.rgb.push_back(view.rgb[3 * pixel + c]);
      cut.depth_m.push_back(view.depth_m[pixel]);
      cut.mask.push_back(view.mask[pixel]);
    }
  }
  return cut;
}

/// As std::lround rounds, at a fraction of the time.
std::uint8_t nearest_byte(double value) {
  const double within = std::clamp(value, 0.0, 255.0);
  const int whole = static_cast<int>(within);
  return static_cast<std::uint8_t>(whole + (within - whole >= 0.5 ? 1 : 0));
}

void disturb_colour(ObjectView& view, const Session& session, double sigma, Rng& rng) {
  for (std::size_t i = 0; i < view.rgb.size(); ++i) {
    const double gain = session.gain[static_cast<Eigen::Index>(i % 3)];
    const double value = gain * view.rgb[i] + sigma * rng.normal();
    view.rgb[i] = nearest_byte(value);
  }
}

bool beside_an_edge(const ObjectView& exact, int row, int column) {
  const float z_m = exact.depth_m[exact.index(row, column)];
  constexpr std::array<std::array<int, 2>, 4> kNeighbours{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  return std::ranges::any_of(kNeighbours, [&](const auto& step) {
    const int r = std::clamp(row + step[0], 0, exact.height_px - 1);
    const int c = std::clamp(column + step[1], 0, exact.width_px - 1);
    return std::abs(exact.depth_m[exact.index(r, c)] - z_m) > kDepthEdge_m;
  });
}

void disturb_depth(ObjectView& view, const DatasetOptions& options, Rng& rng) {
  const RgbdOptions camera{.range_min_m = 0.1, .range_max_m = 5.0, .noise = options.depth_noise};
  const ObjectView exact = view;
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = 0; column < view.width_px; ++column) {
      float& z_m = view.depth_m[view.index(row, column)];
      z_m = measured_depth_m(camera, z_m, rng);
      const bool lost = beside_an_edge(exact, row, column) && rng.uniform() < options.edge_dropout;
      if (lost) z_m = 0.0F;
    }
  }
}

/// What rises from the turntable, whose surface is at z = 0.
ObjectView cut_by_depth(const ObjectView& window, const Pose& T_world_camera,
                        const DatasetOptions& options) {
  const CameraImages images{.width_px = window.width_px,
                            .height_px = window.height_px,
                            .focal_px = window.focal_px,
                            .rgb = window.rgb,
                            .depth_m = window.depth_m};
  const Eigen::Vector3d p_world_table_m = Eigen::Vector3d::Zero();
  ObjectSegmentationOptions cut = cut_at({}, T_world_camera.translation().norm());
  cut.mask_growth_px = options.mask_growth_px;
  cut.margin_px = options.margin_px;
  SegmentedObject found = segment_on_table(images, T_world_camera, {}, p_world_table_m, cut);
  if (!found.view) return {};
  found.view->left_px += window.left_px;
  found.view->top_px += window.top_px;
  found.view->centre_px = window.centre_px;
  return std::move(*found.view);
}

}  // namespace

ObjectView sense(const RenderedImages& drawn, int object_geom, const Session& session,
                 const DatasetOptions& options, Rng& rng) {
  ObjectView window = average_rays(drawn, object_geom, session, options.supersampling);
  if (options.cut_by_depth) {
    disturb_colour(window, session, options.colour_noise, rng);
    disturb_depth(window, options, rng);
    return cut_by_depth(window, drawn.T_world_camera, options);
  }
  for (int i = 0; i < options.mask_growth_px; ++i) grow(window);
  if (std::ranges::find(window.mask, 1) == window.mask.end()) return {};
  ObjectView view = crop(window, box_of_mask(window, options.margin_px));
  disturb_colour(view, session, options.colour_noise, rng);
  disturb_depth(view, options, rng);
  return view;
}

}  // namespace vantage
