/// When faults that come and go are there: by the seed and the clock alone, whoever asks, however
/// often.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <string>

namespace vantage {

/// Times nearer than this are one moment.
inline constexpr double kSameMoment_s = 1e-9;

/// Time is cut into stretches of equal length; in some of them, drawn one by one, something is
/// wrong.
class Stretches {
 public:
  /// @param stream of random numbers
  /// @param share of all stretches, [0, 1]
  Stretches(std::uint64_t seed, std::string stream, double share, double length_s);

  [[nodiscard]] bool cover(double time_s) const;

 private:
  std::uint64_t seed_;
  std::string stream_;
  double share_;
  double length_s_;
};

/// One gust of wind in every interval: when, from where and how strong is drawn by the seed.
class Gusts {
 public:
  /// @param force_max_N of any gust; each has half of it at least. 0: calm
  /// @param duration_s of a gust, at most `every_s`
  Gusts(std::uint64_t seed, double force_max_N, double every_s, double duration_s);

  /// World frame, level.
  [[nodiscard]] Eigen::Vector3d force_world_N(double time_s) const;

 private:
  std::uint64_t seed_;
  double force_max_N_;
  double every_s_;
  double duration_s_;
};

}  // namespace vantage
