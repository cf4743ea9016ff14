/// From measured points to occupied cells.
#pragma once

#include <Eigen/Core>

#include <span>

#include "vantage/belief/map/occupancy_grid.hpp"
#include "vantage/core/fields.hpp"

namespace vantage {

/// Gaussian inverse sensor model round a measured point m, z the cell centre:
///
///   p(m|z) = 1/2 + (peak - 1/2) exp(-d^2 / 2),  d^2 = sum_axis ((z - m) / sigma_axis)^2
///
/// [Elfes1989], [Potthast2016, 3.2.3]. Far from m it tends to 1/2, no information, never below: a
/// hit says nothing about free space. sigma_axis is at least 0.65 cell edges, so that a hit in the
/// corner of a cell still speaks for it whatever the cell size.
struct InverseSensorModel {
  double sigma_m = 0.005;
  double p_occupied_peak = 0.8;
  double spread_sigmas = 2.0;
  double max_abs_log_odds = 5.0;
  void fields(auto&& f) {
    f("sigma_m", sigma_m, "standard deviation of the range noise; higher spreads evidence farther",
      above(0.0));
    f("p_occupied_peak", p_occupied_peak,
      "p(occupied) at the measured point; higher trusts a hit more, and below 0.75 one hit may not "
      "suffice",
      between(0.55, 0.999));
    f("spread_sigmas", spread_sigmas,
      "number of standard deviations at which evidence ends; higher reaches more neighbouring "
      "cells",
      between(0.0, 4.0));
    f("max_abs_log_odds", max_abs_log_odds,
      "greatest magnitude of a cell's log odds; higher needs more evidence to change a cell's "
      "state",
      at_least(0.5));
  }
};

/// Sequential Bayes update [Elfes1989] with the points of ONE scan, world frame, metres; points
/// outside the grid by more than the spread, or not finite, are skipped.
///
/// - The beams of a scan share its errors, so a cell is updated once per scan, with its best
///   evidence, however many points fall near it. The order of the points does not matter.
/// - Only points inside a cell can make it occupied: evidence that merely spreads into a cell stops
///   short of kOccupiedAbove, and does not touch a cell known to be free.
/// The result does not depend on `threads` (>= 1).
/// @throws ConfigError if `model` is out of range.
void add_measurements(OccupancyGrid& grid, std::span<const Eigen::Vector3f> p_world,
                      const InverseSensorModel& model, int threads = 1);

}  // namespace vantage
