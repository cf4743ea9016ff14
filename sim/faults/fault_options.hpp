/// What goes wrong with a robot in an episode, and how much of it. All of it is off by default.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "vantage/core/fields.hpp"

namespace vantage {

struct FaultOptions {
  double dropped_frames = 0.0;
  double frozen_frames = 0.0;
  double nan_depth = 0.0;
  double saturated_depth = 0.0;
  double laser_bias_m = 0.0;
  double odometry_scale = 0.0;
  double odometry_slip = 0.0;
  int late_commands_ticks = 0;
  double weak_rotor = 0.0;
  double gust_N = 0.0;
  double gust_every_s = 3.0;
  double gust_duration_s = 0.5;
  double lights_out = 0.0;
  double stretch_s = 2.0;
  double moved_object_m = 0.0;
  double moved_object_at_s = 5.0;
  std::string moved_object = {};
  void fields(auto&& f) {
    f("dropped_frames", dropped_frames,
      "share of frames (images of a camera, lines of the tilting laser) that never arrive; higher "
      "leaves more unseen; 0: off",
      between(0.0, 1.0));
    f("frozen_frames", frozen_frames,
      "share of frames that arrive as the one before, though the robot has moved on; higher leaves "
      "more unseen, or wrongly seen where nobody notices; 0: off",
      between(0.0, 1.0));
    f("nan_depth", nan_depth,
      "share of depth readings that are not a number: of cameras in blocks of 8 x 8 pixels, of "
      "lasers beam by beam; higher leaves more unseen; 0: off",
      between(0.0, 1.0));
    f("saturated_depth", saturated_depth,
      "share of depth readings that say the greatest range, in the same blocks; higher leaves more "
      "unseen; 0: off",
      between(0.0, 1.0));
    f("laser_bias_m", laser_bias_m,
      "error of every reading of the lasers; higher maps surfaces farther off; 0: off",
      between(-0.5, 0.5));
    f("odometry_scale", odometry_scale,
      "relative error of what the wheels report, turns included; higher reports more motion than "
      "there was; 0: off",
      between(-0.5, 0.5));
    f("odometry_slip", odometry_slip,
      "share of time, in stretches of `stretch_s`, in which the base moves and the wheels report "
      "nothing; higher loses more of the way; 0: off",
      between(0.0, 1.0));
    f("late_commands_ticks", late_commands_ticks,
      "number of control ticks by which every command comes late; higher drives and flies less "
      "steadily; 0: off",
      between(0, 1000));
    f("weak_rotor", weak_rotor,
      "share of its thrust that one rotor lacks, drawn by the seed; higher tilts and sinks more; "
      "0: off",
      between(0.0, 0.9));
    f("gust_N", gust_N,
      "greatest force of gusts of wind, half of it at least, from level directions that the seed "
      "draws; higher throws the vehicle farther off; 0: off",
      between(0.0, 8.0));
    f("gust_every_s", gust_every_s, "interval in which there is one gust; higher is calmer",
      between(0.1, 1000.0));
    f("gust_duration_s", gust_duration_s,
      "duration of a gust; higher throws the vehicle farther off", between(0.01, 1000.0));
    f("lights_out", lights_out,
      "share of time, in stretches of `stretch_s`, in which there is no light: colour images are "
      "black but for noise, depth remains; higher leaves less to recognise by; 0: off",
      between(0.0, 1.0));
    f("stretch_s", stretch_s,
      "length of the stretches of slip and of darkness; higher makes them fewer and longer",
      between(0.01, 1000.0));
    f("moved_object_m", moved_object_m,
      "distance by which somebody moves an object, level, in a direction that the seed draws; "
      "higher leaves more of the map wrong; 0: off",
      between(0.0, 1.0));
    f("moved_object_at_s", moved_object_at_s,
      "simulated time at which it is moved; later leaves "
      "less time to notice",
      at_least(0.0));
    f("moved_object", moved_object,
      "body of the scene that is moved, one that stands fixed; empty: the seed draws one of those "
      "that reach no farther than 0.5 m from their origin");
  }
  void check() const;  ///< a gust is no longer than its interval
};

enum class Fault {
  dropped_frames,
  frozen_frames,
  nan_depth,
  saturated_depth,
  laser_bias,
  odometry_scale,
  odometry_slip,
  late_commands,
  weak_rotor,
  gust,
  lights_out,
  moved_object
};
inline constexpr std::size_t kFaults = 12;

/// What of a robot can fail, besides its sensor of depth and its commands.
struct FaultyParts {
  bool laser = false;
  bool wheels = false;
  bool colour = false;
  bool rotors = false;
};

/// What the fault is called, in records.
std::string_view name_of(Fault fault);
/// How much of it there is; 0: it is off.
double amount_of(const FaultOptions& options, Fault fault);
bool any_fault(const FaultOptions& options);

/// @throws ConfigError naming faults.KEY for a fault that a robot of these parts cannot have
void require_possible(const FaultOptions& options, const FaultyParts& parts);

}  // namespace vantage
