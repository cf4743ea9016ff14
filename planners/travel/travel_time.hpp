/// How long the robot takes from place to place, learnt from its own drives.
#pragma once

namespace vantage {

/// Time of a drive = start-up and turns, and a time per metre: a straight line fitted to the drives
/// so far by least squares, with a prior worth a few of them.
class TravelTime {
 public:
  /// @param speed_m_s that the base is meant to drive at
  explicit TravelTime(double speed_m_s);

  /// A drive that has ended.
  void observe(double length_m, double time_s);
  /// At least that of the way at twice the speed the base is meant to drive at.
  [[nodiscard]] double of_m(double length_m) const;

 private:
  void fit();

  double least_s_per_m_;
  // Sums over drives, the prior's among them: 1, L, L^2, t, L t.
  double count_ = 0.0;
  double length_ = 0.0;
  double length2_ = 0.0;
  double time_ = 0.0;
  double length_time_ = 0.0;
  double start_s_ = 0.0;
  double s_per_m_ = 0.0;
};

}  // namespace vantage
