/// A user's own table-top scene, in a file of its own.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage::support {

/// A table on four legs whose top is at `height_m`, with half edges `half_x_m`, `half_y_m`.
inline std::string table_at(double x_m, double y_m, double height_m, double half_x_m,
                            double half_y_m) {
  std::string geoms = fmt::format("<geom name='top' type='box' pos='{} {} {}' size='{} {} .02'/>",
                                  x_m, y_m, height_m - 0.02, half_x_m, half_y_m);
  const double leg_m = 0.5 * (height_m - 0.04);
  for (const double i : {-1.0, 1.0}) {
    for (const double j : {-1.0, 1.0}) {
      geoms +=
          fmt::format("<geom type='box' pos='{} {} {}' size='.025 .025 {}'/>",
                      x_m + i * (half_x_m - 0.045), y_m + j * (half_y_m - 0.045), leg_m, leg_m);
    }
  }
  return geoms;
}

/// Four objects on a table at the origin whose top is at `height_m`.
inline std::string objects_on(double height_m) {
  const auto at = [&](double x_m, double y_m, double half_m) {
    return fmt::format("{} {} {}", x_m, y_m, height_m + half_m);
  };
  return "<geom type='box' size='.1 .05 .1' pos='" + at(-0.15, 0.1, 0.1) +
         "'/><geom type='cylinder' size='.05 .06' pos='" + at(0.2, -0.1, 0.06) +
         "'/><geom type='ellipsoid' size='.09 .09 .04' pos='" + at(0.1, 0.25, 0.04) +
         "'/><geom type='box' size='.06 .06 .08' pos='" + at(-0.25, -0.25, 0.08) + "'/>";
}

inline constexpr const char* kWalls =
    "<geom type='box' pos='3 0 1.25' size='.05 3 1.25'/>"
    "<geom type='box' pos='0 3 1.25' size='3 .05 1.25'/>";

/// On a floor; gone with this.
class OwnScene {
 public:
  explicit OwnScene(const std::string& bodies) {
    write_file(path(), "<mujoco><worldbody><geom type='plane' size='5 5 .1'/>" + bodies +
                           "</worldbody></mujoco>");
  }
  [[nodiscard]] std::filesystem::path path() const { return folder_ / "scene.xml"; }
  [[nodiscard]] std::string set() const { return "scene=" + path().string(); }

 private:
  TemporaryDirectory folder_;
};

}  // namespace vantage::support
