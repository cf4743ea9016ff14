/// Where the outline of a robot fits on the floor, at which heading.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/belief/map/floor_map.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/geometry/floor_outline.hpp"

namespace vantage {

struct PassageOptions {
  bool use = true;
  double margin_m = 0.02;
  double preferred_margin_m = 0.05;
  int headings = 48;
  double speed_m_s = 0.2;
  double least_area_m2 = 0.2;
  void fields(auto&& f) {
    f("use", use,
      "true: passages that a disc round the robot does not fit through are planned with its "
      "outline and heading; false: they are closed");
    f("margin_m", margin_m,
      "clearance that the robot's outline keeps in a passage; higher closes narrower ones, and "
      "forgives more error of pose and map",
      at_least(0.0));
    f("preferred_margin_m", preferred_margin_m,
      "clearance below which a metre in a passage counts double; higher goes farther round what "
      "leaves little more than the margin; up to the margin: all passages are as good",
      between(0.0, 0.2));
    f("headings", headings,
      "number of headings that are tried in a passage; higher fits through narrower ones at odd "
      "angles, and takes longer",
      between(4, 360));
    f("speed_m_s", speed_m_s,
      "greatest speed in a passage; higher is faster and keeps to the middle less exactly",
      Range{0.0, 1.0, true});
    f("least_area_m2", least_area_m2,
      "area that the robot's middle can be in beyond a passage, below which it is not worth going "
      "there; higher leaves out larger nooks",
      at_least(0.0));
  }
};

/// Clearance that a robot's outline keeps in a passage: half a centimetre, the margin, or the
/// preferred one. None but the preferred one is more than the margin.
enum class Margin : std::uint8_t { tight, least, preferred };

/// What of a robot matters in a passage.
struct RobotOutline {
  FloorOutline outline;       ///< base frame
  bool goes_sideways = true;  ///< else along its heading alone
  double speed_m_s = 0.6;     ///< that it drives at elsewhere
};

/// The heading on the way from one place to another: `yaw_rad`, or along the way for a base that
/// cannot go sideways.
double heading_along(const RobotOutline& robot, const Eigen::Vector2d& from_m,
                     const Eigen::Vector2d& to_m, double yaw_rad);

/// A point is where a cell of the floor has its centre and is not known to be free; the outside of
/// the map is made of them. The outline fits where it covers none. Cells are small against it.
class FootprintSpace {
 public:
  /// @param parts edge of a cell that the robot's middle is put to, in cells of `detail`; odd
  FootprintSpace(const FloorMap& detail, int parts, const RobotOutline& robot,
                 const PassageOptions& options);

  /// Of any outline in the base's frame.
  [[nodiscard]] bool fits(std::span<const Eigen::Vector2d> outline,
                          const Pose2& T_world_base) const;
  /// The same all along a straight line, at points 3 cm apart and at one heading.
  [[nodiscard]] bool fits_along(std::span<const Eigen::Vector2d> outline,
                                const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m,
                                double yaw_rad) const;
  /// Of the robot's at the centre of a cell of `detail`, with a margin, at one of the headings;
  /// fast.
  [[nodiscard]] bool fits(const Eigen::Array2i& cell, int heading,
                          Margin margin = Margin::least) const;
  /// Whether it might so at that heading at a centre up to half of `parts` off, along either axis.
  [[nodiscard]] bool may_fit(const Eigen::Array2i& cell, int heading,
                             Margin margin = Margin::least) const;
  /// Whether it fits there all the way from a heading to the next one: on it a corner sweeps over
  /// what neither of the two covers, 2.8 cm deep for a square of 0.67 m and 48 headings.
  [[nodiscard]] bool fits_turning(const Eigen::Array2i& cell, int heading,
                                  Margin margin = Margin::least) const;
  [[nodiscard]] double margin_m(Margin margin) const;
  /// Whether the robot might stand there at some heading: its inscribed disc fits.
  [[nodiscard]] bool may_stand(const Eigen::Array2i& cell) const;

  [[nodiscard]] int headings() const { return options_.headings; }
  [[nodiscard]] double heading_rad(int heading) const;
  [[nodiscard]] int nearest_heading(double yaw_rad) const;
  [[nodiscard]] Eigen::Vector2d centre(const Eigen::Array2i& cell) const;
  [[nodiscard]] int parts() const { return parts_; }
  [[nodiscard]] const RobotOutline& robot() const { return robot_; }
  [[nodiscard]] const PassageOptions& options() const { return options_; }
  [[nodiscard]] double circumscribed_m() const { return circumscribed_m_; }
  /// Whether it is about as wide at any heading.
  [[nodiscard]] bool turns_anywhere() const {
    return circumscribed_m_ - inscribed_radius_m(robot_.outline) <= options_.margin_m;
  }
  /// How much longer than elsewhere a metre takes.
  [[nodiscard]] double slowness() const {
    return std::max(1.0, robot_.speed_m_s / options_.speed_m_s);
  }

 private:
  struct Row {
    int row, first, last;
  };
  using Mask = std::vector<Row>;  ///< about a cell's centre

  [[nodiscard]] Mask mask_of(const FloorOutline& outline) const;
  [[nodiscard]] Mask turn_mask_of(const FloorOutline& outline, int heading) const;
  [[nodiscard]] Mask common_of(const Mask& mask) const;
  [[nodiscard]] bool is_clear(const Mask& mask, const Eigen::Array2i& cell) const;
  [[nodiscard]] bool is_clear(int row, int first, int last) const;

  int parts_;
  RobotOutline robot_;
  PassageOptions options_;
  double circumscribed_m_;
  Eigen::Vector2d first_centre_m_;
  double cell_m_;
  int nx_;
  int ny_;
  std::size_t words_;                ///< of a row
  std::vector<std::uint64_t> bits_;  ///< 1: a point
  struct HeadingMasks {
    std::vector<Mask> at;      ///< of each heading
    std::vector<Mask> common;  ///< of the same wherever in the cell it is put
    std::vector<Mask> turn;    ///< of the way from each heading to the next
  };
  std::array<HeadingMasks, 3> masks_;  ///< of each margin
  Mask disc_;
};

}  // namespace vantage
