/// Faults of one robot in one episode: its simulation asks at each seam what becomes of a reading,
/// a frame, an increment, a command. Each draws from random streams of its own, so that what is
/// switched off changes nothing.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/geometry/range_scan.hpp"
#include "vantage/sim/faults/fault_options.hpp"
#include "vantage/sim/faults/fault_record.hpp"
#include "vantage/sim/faults/fault_schedule.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {

class RobotFaults {
 public:
  RobotFaults(const FaultOptions& options, std::uint64_t seed);
  RobotFaults(const RobotFaults&) = delete;
  RobotFaults& operator=(const RobotFaults&) = delete;

  /// What befalls the world and the commands. Call it where the episode begins.
  /// @param rotors actuators of which one may be weak
  /// @throws ConfigError as add_outside_faults()
  void attach(World& world, std::span<const int> rotors = {});

  /// What arrives of an image that was taken at `time_s`: nothing, the one before, or this one with
  /// its depth spoilt.
  std::optional<CameraImages> arriving(CameraImages taken, double time_s);
  /// The same of a line of the tilting laser, in place: of one that never arrives nothing is known.
  void spoil_line(std::vector<float>& range_m, double range_max_m, double time_s);
  /// Of the planar scanner, whose frames all arrive.
  void spoil_planar(PlanarScan& scan, double time_s);
  /// What the wheels report for an increment that they would have reported, T_previous_now.
  [[nodiscard]] Pose2 reported(const Pose2& increment, double time_s);
  /// Whether an image that is taken now is taken in the dark.
  [[nodiscard]] bool in_the_dark(double time_s);

  [[nodiscard]] const FaultOptions& options() const { return options_; }
  [[nodiscard]] const FaultRecord& record() const { return record_; }

 private:
  enum class Frame { whole, dropped, frozen };
  Frame next_frame(bool has_last, double time_s);
  void spoil_depth(CameraImages& images, double time_s);
  void spoil_ranges(std::span<float> range_m, double range_max_m, double time_s);
  void command(std::span<double> controls, double time_s);
  void note_outside(double time_s);

  FaultOptions options_;
  std::uint64_t seed_;
  FaultRecord record_;
  Rng dropped_;
  Rng frozen_;
  Rng nan_;
  Rng saturated_;
  Stretches slip_;
  Stretches dark_;
  Gusts gusts_;
  std::optional<CameraImages> last_image_;
  std::vector<float> last_line_;
  std::deque<std::vector<double>> late_;  ///< commands under way, the oldest first
  int weak_rotor_ = -1;                   ///< actuator
  bool slips_ = false;
  bool blows_ = false;
  bool was_moved_ = false;
};

}  // namespace vantage
