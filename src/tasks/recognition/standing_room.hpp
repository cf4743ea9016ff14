/// Where there is room on a table for one more thing.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/dataset/object_source.hpp"

namespace vantage {

/// Convex, counter-clockwise, seen from above, m.
using Outline = std::vector<Eigen::Vector2d>;

/// Of an object, round the middle of its box.
Outline outline_of(const TurntableObject& object);
/// Of a round thing.
Outline round_outline(double radius_m);
/// Turned by `yaw_rad`, then moved.
Outline placed(const Outline& outline, double yaw_rad, const Eigen::Vector2d& to_m);

/// The gap between two convex outlines; 0 if they meet.
double gap_m(const Outline& a, const Outline& b);

/// Where something may come to stand.
struct StandingRule {
  std::span<const Eigen::Vector2d> round_m;  ///< places that things stand round
  double reach_m = 0.3;                      ///< of them; grows where there is no room
  double spacing_m = 0.05;
  Eigen::Vector2d table_m;  ///< edge lengths of the table, its middle is the origin
};

class StandingRoom {
 public:
  explicit StandingRoom(const StandingRule& rule) : rule_(rule) {}

  void take(const Outline& outline) { taken_.push_back(outline); }
  struct Place {
    Eigen::Vector2d p_m = Eigen::Vector2d::Zero();
    double yaw_rad = 0.0;
  };
  /// Draws a place with room for the outline and takes it.
  /// @return false if there is none to be found
  bool place(const Outline& outline, Rng& rng, Place& found);

 private:
  [[nodiscard]] bool free(const Outline& outline) const;

  StandingRule rule_;
  std::vector<Outline> taken_;
};

}  // namespace vantage
