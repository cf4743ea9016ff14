/// How an office is explored.
#pragma once

#include <vector>

#include "vantage/belief/map/headroom.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/geometry/field_of_view.hpp"
#include "vantage/planners/views/frontiers.hpp"
#include "vantage/sim/sensors/camera.hpp"

namespace vantage {

/// Where the head turns the camera at a stop: rows of images at one tilt, all round.
struct HeadSweep {
  int pans = 9;                             ///< images a row; more overlap, take longer
  std::vector<double> tilts_rad{0.0, 0.7};  ///< of the rows, ascending; positive looks down
  void fields(auto&& f) {
    f("pans", pans, between(1, 360));
    f("tilts_rad", tilts_rad, between(-1.5, 1.5));
  }
  void check() const;  ///< at least one row, tilts ascending
};

/// Pan angles of a row, evenly round, ascending.
std::vector<double> pan_angles_rad(const HeadSweep& sweep);
/// What the images of a sweep see from the head's pan axis in every direction. Nearer than
/// range_min_m space is seen empty, though no surface is.
/// @throws ConfigError if the images leave gaps, between the columns or between the rows.
FieldOfView swept_field(const HeadSweep& sweep, const RgbdOptions& camera);

/// When exploring is no longer worth a scan, asked alike of every method: the best view in reach
/// promises too little, by what was learnt of clutter.
struct EnoughOptions {
  double share = 0.0015;  ///< of the cells known; less is too little, higher ends earlier
  int scans = 3;          ///< in a row after which it was too little; 0 explores all there is
  void fields(auto&& f) {
    f("share", share, between(0.0, 1.0));
    f("scans", scans, at_least(0));
  }
};

struct ExplorationOptions {
  HeadSweep sweep;
  RgbdOptions camera{.tells_far = true};
  FrontierOptions frontiers{.min_cells = 60, .height_m = 1.47, .height_band_m = {{0.2, 1.7}}};
  HeadroomOptions headroom;
  double start_room_m = 0.75;  ///< round the start, known to be free for the robot
  int max_candidates = 30;     ///< the largest clusters; more take longer to score
  double reach_m = 1.0;        ///< nearest place farther from its frontier: out of reach
  double taken_m = 0.3;        ///< places nearer to one that was scanned from are not proposed
  double poor_m = 1.0;         ///< the same round a place whose scan showed too little
  int poor_cells = 2000;       ///< fewer new cells are too little; higher gives up sooner
  EnoughOptions enough;
  double keyframe_m = 0.5;  ///< between places on the way where walls are remembered to drive by
  double reference_novelty_m =
      0.05;                  ///< walls nearer than this to remembered ones are not remembered
  int stride_px = 3;         ///< pixels between those that mark surfaces; higher is faster
  int hazard_stride_px = 8;  ///< pixels between those that count clutter; higher is faster
  void fields(auto&& f) {
    f("sweep", sweep);
    f("camera", camera);
    f("frontiers", frontiers);
    f("headroom", headroom);
    f("start_room_m", start_room_m, at_least(0.0));
    f("max_candidates", max_candidates, at_least(1));
    f("reach_m", reach_m, at_least(0.0));
    f("taken_m", taken_m, above(0.0));
    f("poor_m", poor_m, at_least(0.0));
    f("poor_cells", poor_cells, at_least(0));
    f("enough", enough);
    f("keyframe_m", keyframe_m, above(0.0));
    f("reference_novelty_m", reference_novelty_m, at_least(0.0));
    f("stride_px", stride_px, between(1, 100));
    f("hazard_stride_px", hazard_stride_px, between(1, 100));
  }
};

}  // namespace vantage
