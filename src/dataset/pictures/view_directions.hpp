/// From where pictures of an object are taken: angles, or names such as `front`.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vantage {

/// What a name says. Yaw is that of the object as the camera sees it: 0 shows its front; the camera
/// at the object's left sees it turned by 270 deg.
struct NamedDirection {
  std::optional<double> yaw_deg;        ///< nothing for `top` and `bottom`
  std::optional<double> elevation_deg;  ///< of `top` and `bottom`
};

/// Of `front`, `back` (`rear`), `left`, `right`, `front_left`, ... in any spelling of case and
/// separators, `top`, `bottom`; nothing for other names.
std::optional<NamedDirection> named_direction(std::string_view name);

/// Bins for the directions of a set of pictures.
struct Directions {
  int bins = 8;
  bool degrees = true;                    ///< bins are angles; else each name has one of its own
  std::vector<std::string> names;         ///< of each bin; empty: none
  std::map<std::string, double> yaw_deg;  ///< of each name
};

/// Of views that are told by name: angles if all names have one, else a circle of the names, in
/// which neighbours need not be so.
Directions directions_of_names(const std::vector<std::string>& names);

/// Of views whose angles are known: as many bins as put each of few angles on the middle of one,
/// else 8.
int bins_for(const std::vector<double>& yaws_deg);

}  // namespace vantage
