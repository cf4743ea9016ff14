/// Random numbers that are the same on every machine and standard library.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace vantage {

/// xoshiro256++ [BlackmanVigna2019] with our own distributions. Pass it as an explicit `Rng&`.
class Rng {
 public:
  explicit Rng(std::uint64_t seed);

  /// An independent generator for one purpose ("laser", "odometry", ...) of a run's seed: drawing
  /// more from one stream never shifts another.
  static Rng stream(std::uint64_t seed, std::string_view name);

  std::uint64_t next();
  double uniform();                              ///< [0, 1), 53 bits
  double uniform(double low, double high);       ///< [low, high)
  std::size_t uniform_index(std::size_t count);  ///< 0 .. count-1 without bias; count > 0
  double normal();                               ///< mean 0, standard deviation 1 (polar method)
  double normal(double mean, double sigma) { return mean + sigma * normal(); }

 private:
  std::array<std::uint64_t, 4> state_;
  std::optional<double> spare_normal_;
};

}  // namespace vantage
