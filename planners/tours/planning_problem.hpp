/// What planning several views ahead looks at: what each view shows, what they show together, and
/// how long everything takes.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "vantage/core/rng.hpp"

namespace vantage {

/// The share of each block of cells that a view is expected to show; blocks of no share are left
/// out.
struct ShownShares {
  std::vector<std::uint32_t> block;  ///< ascending
  std::vector<float> share;          ///< of the block's cells, (0, 1]
};

/// What is left to spend. The way home is kept affordable where there is a home.
struct Allowance {
  double time_s = std::numeric_limits<double>::infinity();
  double energy_j = std::numeric_limits<double>::infinity();
};

/// Of a robot that stands somewhere and may take any of n views, each after a drive.
struct PlanningProblem {
  std::vector<float> cells;        ///< per block: the unobserved cells, in the unit of the gain
  std::vector<ShownShares> shows;  ///< per view
  std::vector<Eigen::Vector2d> place_m;  ///< per view, on the floor, world
  Eigen::MatrixXd travel_s;    ///< (n + 1) x n, from row to column; row n is where the robot stands
  std::vector<double> home_s;  ///< per view, and last from here: the way home; empty: none is kept
  double scan_s = 0.0;
  double driving_w = 0.0;   ///< power while driving
  double scanning_w = 0.0;  ///< power while scanning
  Allowance left;
  /// Another map that the belief allows, drawn from it: the same views, with what they would show
  /// there. Empty where nothing can be drawn.
  std::function<PlanningProblem(Rng&)> draw;

  [[nodiscard]] std::size_t views() const { return shows.size(); }
  /// Stands for the robot's place in `travel_s` and `home_s`.
  [[nodiscard]] std::size_t here() const { return views(); }
  [[nodiscard]] double leg_s(std::size_t from, std::size_t to) const {
    return travel_s(static_cast<Eigen::Index>(from), static_cast<Eigen::Index>(to));
  }
  [[nodiscard]] double energy_j(double driven_s, double scanned_s) const {
    return driving_w * driven_s + scanning_w * scanned_s;
  }
  void check() const;  ///< asserts that the sizes fit
};

/// Cells that one view alone is expected to show.
double gain_of(const PlanningProblem& problem, std::size_t view);

/// Whether the views, in that order, can be taken within what is left, and the way home after them.
bool is_affordable(const PlanningProblem& problem, std::span<const std::size_t> order);

/// The views that can be reached and that are affordable as the next one, ascending.
std::vector<std::size_t> affordable_views(const PlanningProblem& problem);

/// What a choice that plans ahead wants to do: the views in order, the first one next. Empty if no
/// view is affordable.
struct PlannedViews {
  std::vector<std::size_t> order;
};

}  // namespace vantage
