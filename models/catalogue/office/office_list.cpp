#include "vantage/models/catalogue/office/office_list.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace vantage {
namespace {

/// Offices of one letter: all four levels of the small one and of the large one.
struct Letter {
  const char* suffix;
  std::uint64_t small_seed, large_seed;
  bool has_own_walls = false;  ///< each of them, and furniture from a seed of its own too
};

OfficeOptions office_of(const Letter& letter, bool large, int level) {
  const std::uint64_t first = large ? letter.large_seed : letter.small_seed;
  const std::uint64_t own = first + static_cast<std::uint64_t>(level);
  return {.name = fmt::format("office_{}{}_{}", large ? "large" : "small", letter.suffix, level),
          .seed = letter.has_own_walls ? own : first,
          .large = large,
          .clutter = level,
          .walls = letter.has_own_walls ? own : 0};
}

}  // namespace

std::vector<OfficeOptions> office_scenes() {
  std::vector<OfficeOptions> scenes;
  for (const Letter& letter : {Letter{"", 1510, 2025}, Letter{"_b", 32, 42},
                               Letter{"_e", 350, 450, true}, Letter{"_f", 360, 460, true}}) {
    for (const bool large : {false, true}) {
      for (int level = 1; level <= kClutterLevels; ++level) {
        scenes.push_back(office_of(letter, large, level));
      }
    }
  }
  return scenes;
}

std::vector<OfficeOptions> door_scenes() {
  const auto doors = [](const char* name, std::uint64_t seed, double doors_m) {
    return OfficeOptions{.name = name, .seed = seed, .clutter = 1, .doors_m = doors_m};
  };
  return {doors("office_doors_1", 851, 0.85),      doors("office_doors_80_1", 801, 0.80),
          doors("office_doors_80_a_1", 802, 0.80), doors("office_doors_80_c_1", 804, 0.80),
          doors("office_doors_e_1", 856, 0.85),    doors("office_doors_f_1", 857, 0.85)};
}

}  // namespace vantage
