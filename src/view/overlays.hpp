/// What is laid over the image of the world: the map, the views weighed, words.
#pragma once

#include <opencv2/core.hpp>

#include <optional>
#include <string>
#include <vector>

#include "vantage/runtime/drawing/map_view.hpp"
#include "vantage/runtime/log/event_log.hpp"

namespace vantage {

/// Occupied cells as draw_voxels() shows them, but for those that the scene of the canvas hides.
/// A cell belongs to a surface, and is not hidden by it.
void lay_map(MapCanvas& canvas, const MapCamera& camera, const OccupancyGrid& grid);

/// Views as pyramids, coloured by their gain from the lowest to the highest; unreachable ones grey,
/// the chosen one white and larger; the way there; the tour that is planned from there on.
void lay_views(MapCanvas& canvas, const MapCamera& camera, const EventReplay& known);

struct ViewCaptions {
  std::string scene;     ///< top left
  std::string plan;      ///< below it; empty: nothing is planned ahead
  std::string playback;  ///< top right
  std::string gain_unit;
  std::optional<Decision> decision;  ///< whose gains want a legend
  std::optional<double> progress;    ///< share of the timeline
  bool help = false;
};
void lay_captions(cv::Mat& bgr, const ViewCaptions& captions);

/// Of the timeline at the foot of an image.
double timeline_height_px(int frame_height_px);

}  // namespace vantage
