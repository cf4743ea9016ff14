/// What a flight looks at: one object on a table, or several, one after the other.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vantage/geometry/upright_cylinder.hpp"
#include "vantage/perception/clutter/object_among_others.hpp"
#include "vantage/tasks/object_flight/object_inquiry.hpp"
#include "vantage/tasks/object_flight/observation_record.hpp"
#include "vantage/tasks/table_map/table_map.hpp"

namespace vantage {

/// How a robot copes with other things on the table.
struct AmongOthers {
  TableMapOptions map;
  SeparationOptions separation;
};

/// What is looked at, and under what conditions.
struct FlightGoal {
  std::vector<Eigen::Vector3d> p_world_m;   ///< where on the table, as the robot is told
  std::optional<AmongOthers> among_others;  ///< none: it stands alone
  double time_limit_s = 0.0;                ///< simulated; 0: none
  bool all_at_once = false;  ///< views of all of them compete; false: one object after the other

  [[nodiscard]] bool allows(double until_s) const {
    return time_limit_s == 0.0 || until_s <= time_limit_s;
  }
};

/// One of the objects, and what is known of it.
struct TourTarget {
  Eigen::Vector3d p_world_m;
  ObjectInquiry inquiry;
  std::optional<UprightCylinder> shape = {};  ///< as far as it was seen
  std::vector<Eigen::Vector2d> outline = {};  ///< of what was seen of it, from above
  std::vector<std::uint8_t> own_cells = {};   ///< over it, see TableMap::cells_over()
  std::vector<int> bearing_ids = {};          ///< looked at from, in order
  double bearing_rad = 0.0;                   ///< of the last of them
  std::string unreachable = {};               ///< why no view of it is left; empty: some are

  [[nodiscard]] bool looked_at() const { return !bearing_ids.empty(); }
  [[nodiscard]] bool visited(int bearing_id) const;
  /// Its shape, or that of most things before anything was seen of it.
  [[nodiscard]] UprightCylinder expected_shape() const;
  /// Why it is not looked at any more; empty: it is.
  [[nodiscard]] std::string over() const;
};

class TargetTour {
 public:
  /// @param inquiry about each of them, before any view
  TargetTour(const FlightGoal& goal, const ObjectInquiry& inquiry);

  [[nodiscard]] const std::vector<TourTarget>& targets() const { return targets_; }
  [[nodiscard]] std::size_t current_id() const { return current_; }
  [[nodiscard]] TourTarget& current() { return targets_[current_]; }
  [[nodiscard]] const TourTarget& current() const { return targets_[current_]; }
  void go_to(std::size_t target) { current_ = target; }
  void give_up(std::size_t target, std::string why) {
    targets_[target].unreachable = std::move(why);
  }
  /// Those to be looked at next: all that are not over at once, or the current one until it is.
  [[nodiscard]] std::vector<std::size_t> open() const;
  [[nodiscard]] std::vector<std::size_t> not_over() const;
  /// How it has ended.
  [[nodiscard]] std::string reason() const;

 private:
  std::vector<TourTarget> targets_;
  std::size_t current_ = 0;
  bool all_at_once_;
};

/// Which of `options` is best, each by what is believed of its target.
/// @param options at least one; those of a target stand together
NextView next_view(const TargetTour& tour, const Recogniser& recogniser,
                   const RecognitionOptions& decision, std::span<const BearingOption> options,
                   Rng& rng);

}  // namespace vantage
