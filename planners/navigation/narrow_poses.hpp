/// Poses in the passages of a floor: at each cell and heading one, put where in the cell it fits.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "vantage/planners/navigation/narrow_places.hpp"
#include "vantage/planners/navigation/path_field.hpp"

namespace vantage {

/// Makes the poses of a field as a search comes to them.
class NarrowPoses {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  struct Place {
    Eigen::Array2i fine;  ///< cell of the finer map
    int heading;
    bool roomy;  ///< the preferred margin is kept
  };

  /// @param field outlives this; poses are added to it, not reached yet
  NarrowPoses(PathField& field, std::vector<Leeway> leeway);

  [[nodiscard]] bool is_narrow(std::size_t cell) const {
    return leeway_[cell] == Leeway::passage || leeway_[cell] == Leeway::nook;
  }
  [[nodiscard]] bool is_nook(std::size_t cell) const { return leeway_[cell] == Leeway::nook; }
  /// Cell of the finer map.
  [[nodiscard]] Eigen::Array2i middle(std::size_t cell) const;
  /// The pose of a narrow cell at that heading, nearest to the middle where the preferred margin is
  /// kept, else where the least is; kNone if it fits nowhere.
  std::uint32_t at(std::size_t cell, int heading);
  [[nodiscard]] const Place& place(std::size_t pose) const { return placed_[pose]; }
  /// Adds the robot's own, which need not fit: if it does not, the others keep a tight margin.
  std::uint32_t add_start();
  /// Whether it fits halfway from one place to another: in one of the two cells of the finer map
  /// next to that, since what passes sideways into a door by a cell does so before it.
  [[nodiscard]] bool fits_between(const Eigen::Array2i& a, const Eigen::Array2i& b,
                                  int heading) const;
  /// Whether it keeps the preferred margin in both.
  [[nodiscard]] bool is_roomy_between(const Eigen::Array2i& a, const Eigen::Array2i& b,
                                      int heading) const;
  /// Whether it may turn from one place to one at the next heading, halfway between them.
  [[nodiscard]] bool fits_turning(const Place& from, const Place& to_next) const;
  [[nodiscard]] bool is_roomy_turning(const Place& from, const Place& to_next) const;

 private:
  static constexpr std::uint32_t kUnknown = kNone - 1;
  [[nodiscard]] std::size_t slot(std::size_t cell, int heading) const;
  [[nodiscard]] std::optional<Eigen::Array2i> nearest_fitting(std::size_t cell, int heading,
                                                              Margin margin) const;

  PathField& field_;
  const FootprintSpace& space_;
  std::vector<Leeway> leeway_;
  std::vector<std::uint32_t> row_of_;   ///< of narrow cells in pose_at_
  std::vector<std::uint32_t> pose_at_;  ///< per narrow cell and heading
  std::vector<Place> placed_;           ///< of each pose
  Margin least_ = Margin::least;
};

}  // namespace vantage
