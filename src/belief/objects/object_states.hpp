/// What a recogniser tells apart: each object of a database in each of its yaw bins, and objects
/// that are none of these.
#pragma once

#include <numbers>
#include <string>
#include <vector>

namespace vantage {

/// Of an unknown object that is of none of the categories.
inline constexpr int kNoCategory = -1;
/// What an unknown object, or its category, is called.
inline constexpr auto kUnknown = "unknown";

struct ObjectStates {
  std::vector<std::string> objects;     ///< "coffee_mug_3"
  std::vector<std::string> categories;  ///< "coffee_mug"
  std::vector<int> category_of;         ///< of each object, an index into `categories`
  int bins = 8;                         ///< yaw bins an object, bin q centred on q * bin_rad()
  /// Hypotheses "none of these": the category of each, an index into `categories` or kNoCategory.
  /// Each is one state without yaw, behind the states of the objects. Empty: there is no such
  /// hypothesis, every object is one of `objects`.
  std::vector<int> unknown_category = {};

  [[nodiscard]] int object_count() const { return static_cast<int>(objects.size()); }
  [[nodiscard]] int known_size() const { return object_count() * bins; }
  [[nodiscard]] int unknown_size() const { return static_cast<int>(unknown_category.size()); }
  [[nodiscard]] int size() const { return known_size() + unknown_size(); }
  [[nodiscard]] bool is_unknown(int state) const { return state >= known_size(); }
  [[nodiscard]] int state(int object, int bin) const { return object * bins + bin; }
  /// object_count() of all that are unknown: together they are one more object.
  [[nodiscard]] int object_of(int state) const {
    return is_unknown(state) ? object_count() : state / bins;
  }
  /// 0 of what is unknown.
  [[nodiscard]] int bin_of(int state) const { return is_unknown(state) ? 0 : state % bins; }
  [[nodiscard]] double bin_rad() const { return 2.0 * std::numbers::pi / bins; }
  /// The bin that a yaw of any turn lies in.
  [[nodiscard]] int bin_of_yaw(double yaw_rad) const;
};

/// The state of an object that is known, by its name and its yaw as the camera sees it.
int state_seen(const ObjectStates& states, const std::string& object, double seen_yaw_rad);

}  // namespace vantage
