/// What a recogniser tells apart: each object of a database in each of its yaw bins.
#pragma once

#include <numbers>
#include <string>
#include <vector>

namespace vantage {

struct ObjectStates {
  std::vector<std::string> objects;     ///< "coffee_mug_3"
  std::vector<std::string> categories;  ///< "coffee_mug"
  std::vector<int> category_of;         ///< of each object, an index into `categories`
  int bins = 8;                         ///< yaw bins an object, bin q centred on q * bin_rad()

  [[nodiscard]] int object_count() const { return static_cast<int>(objects.size()); }
  [[nodiscard]] int size() const { return object_count() * bins; }
  [[nodiscard]] int state(int object, int bin) const { return object * bins + bin; }
  [[nodiscard]] int object_of(int state) const { return state / bins; }
  [[nodiscard]] int bin_of(int state) const { return state % bins; }
  [[nodiscard]] double bin_rad() const { return 2.0 * std::numbers::pi / bins; }
};

}  // namespace vantage
