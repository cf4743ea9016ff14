#include "vantage/models/catalogue/office/office_list.hpp"

#include <fmt/format.h>

#include <tuple>

namespace vantage {
namespace {

OfficeOptions checked_in_office(bool large, const char* suffix, int level, std::uint64_t seed) {
  return {.name = fmt::format("office_{}{}_{}", large ? "large" : "small", suffix, level),
          .seed = seed,
          .large = large,
          .clutter = level};
}

}  // namespace

std::vector<OfficeOptions> office_scenes() {
  using Draw = std::tuple<const char*, std::uint64_t, std::uint64_t>;
  std::vector<OfficeOptions> scenes;
  for (const auto& [suffix, small_seed, large_seed] :
       {Draw{"", 1510U, 2025U}, Draw{"_a", 31U, 41U}, Draw{"_b", 32U, 42U}}) {
    for (const bool large : {false, true}) {
      for (int level = 1; level <= kClutterLevels; ++level) {
        scenes.push_back(checked_in_office(large, suffix, level, large ? large_seed : small_seed));
      }
    }
  }
  for (const auto& [suffix, small_seed, large_seed] :
       {Draw{"_c", 330U, 430U}, Draw{"_d", 340U, 440U}}) {
    for (const bool large : {false, true}) {
      for (int level = 1; level <= kClutterLevels; ++level) {
        const std::uint64_t own =
            (large ? large_seed : small_seed) + static_cast<std::uint64_t>(level);
        scenes.push_back(checked_in_office(large, suffix, level, own));
        scenes.back().walls = own;
      }
    }
  }
  return scenes;
}

std::vector<OfficeOptions> door_scenes() {
  const auto doors = [](const char* name, std::uint64_t seed, double doors_m) {
    return OfficeOptions{.name = name, .seed = seed, .clutter = 1, .doors_m = doors_m};
  };
  return {doors("office_doors_1", 851, 0.85), doors("office_doors_80_1", 801, 0.80),
          doors("office_doors_a_1", 852, 0.85), doors("office_doors_b_1", 853, 0.85),
          doors("office_doors_80_a_1", 802, 0.80)};
}

}  // namespace vantage
