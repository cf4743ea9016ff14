#include "vantage/sim/faults/robot_faults.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "vantage/core/error.hpp"
#include "vantage/sim/faults/outside_faults.hpp"

namespace vantage {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
constexpr int kBlock_px = 8;

/// Sets the depth of each block that is drawn to `value`. @return pixels
std::int64_t spoil_blocks(CameraImages& images, double share, float value, Rng& rng) {
  std::int64_t spoilt = 0;
  for (int top = 0; top < images.height_px; top += kBlock_px) {
    for (int left = 0; left < images.width_px; left += kBlock_px) {
      if (!(rng.uniform() < share)) continue;
      const int right = std::min(left + kBlock_px, images.width_px);
      for (int row = top; row < std::min(top + kBlock_px, images.height_px); ++row) {
        const auto first =
            images.depth_m.begin() + static_cast<std::ptrdiff_t>(row) * images.width_px + left;
        std::fill_n(first, right - left, value);
        spoilt += right - left;
      }
    }
  }
  return spoilt;
}

std::int64_t spoil_some(std::span<float> range_m, double share, float value, Rng& rng) {
  std::int64_t spoilt = 0;
  for (float& range : range_m) {
    if (!(rng.uniform() < share)) continue;
    range = value;
    ++spoilt;
  }
  return spoilt;
}

}  // namespace

RobotFaults::RobotFaults(const FaultOptions& options, std::uint64_t seed)
    : options_(options),
      seed_(seed),
      dropped_(Rng::stream(seed, "fault dropped frames")),
      frozen_(Rng::stream(seed, "fault frozen frames")),
      nan_(Rng::stream(seed, "fault nan depth")),
      saturated_(Rng::stream(seed, "fault saturated depth")),
      slip_(seed, "fault slip", options.odometry_slip, options.stretch_s),
      dark_(seed, "fault darkness", options.lights_out, options.stretch_s),
      gusts_(seed, options.gust_N, options.gust_every_s, options.gust_duration_s) {
  check_options(options_, "faults");
}

void RobotFaults::attach(World& world, std::span<const int> rotors) {
  add_outside_faults(world, options_, seed_);
  if (options_.weak_rotor > 0.0) {
    expects(!rotors.empty(), "a robot with rotors");
    Rng draw = Rng::stream(seed_, "fault weak rotor");
    weak_rotor_ = rotors[draw.uniform_index(rotors.size())];
  }
  const auto at_rest = world.controls();
  late_.assign(static_cast<std::size_t>(options_.late_commands_ticks),
               std::vector<double>(at_rest.begin(), at_rest.end()));
  const bool acts = options_.late_commands_ticks > 0 || weak_rotor_ >= 0 || options_.gust_N > 0.0 ||
                    options_.moved_object_m > 0.0;
  if (!acts) return;
  world.on_command = [this, &world](std::span<double> controls) {
    command(controls, world.time_s());
  };
}

void RobotFaults::command(std::span<double> controls, double time_s) {
  note_outside(time_s);
  if (options_.late_commands_ticks > 0) {
    late_.emplace_back(controls.begin(), controls.end());
    std::ranges::copy(late_.front(), controls.begin());
    late_.pop_front();
    record_.strike(Fault::late_commands, time_s);
  }
  if (weak_rotor_ >= 0) {
    controls[static_cast<std::size_t>(weak_rotor_)] *= 1.0 - options_.weak_rotor;
    record_.strike(Fault::weak_rotor, time_s);
  }
}

/// Gusts and a moved object strike the world; here they are counted.
void RobotFaults::note_outside(double time_s) {
  const bool blew = std::exchange(blows_, !gusts_.force_world_N(time_s).isZero(0.0));
  if (blows_ && !blew) record_.strike(Fault::gust, time_s);
  const bool moved =
      options_.moved_object_m > 0.0 && time_s >= options_.moved_object_at_s - kSameMoment_s;
  if (moved && !std::exchange(was_moved_, true)) record_.strike(Fault::moved_object, time_s);
}

RobotFaults::Frame RobotFaults::next_frame(bool has_last, double time_s) {
  const bool dropped =
      options_.dropped_frames > 0.0 && dropped_.uniform() < options_.dropped_frames;
  const bool frozen = options_.frozen_frames > 0.0 && frozen_.uniform() < options_.frozen_frames;
  if (dropped) {
    record_.strike(Fault::dropped_frames, time_s);
    return Frame::dropped;
  }
  if (!frozen || !has_last) return Frame::whole;
  record_.strike(Fault::frozen_frames, time_s);
  return Frame::frozen;
}

std::optional<CameraImages> RobotFaults::arriving(CameraImages taken, double time_s) {
  switch (next_frame(last_image_.has_value(), time_s)) {
    case Frame::dropped: return std::nullopt;
    case Frame::frozen: return last_image_;
    case Frame::whole: break;
  }
  spoil_depth(taken, time_s);
  if (options_.frozen_frames > 0.0) last_image_ = taken;
  return taken;
}

void RobotFaults::spoil_depth(CameraImages& images, double time_s) {
  if (options_.saturated_depth > 0.0) {
    record_.strike(Fault::saturated_depth, time_s,
                   spoil_blocks(images, options_.saturated_depth,
                                static_cast<float>(images.range_max_m), saturated_));
  }
  if (options_.nan_depth > 0.0) {
    record_.strike(Fault::nan_depth, time_s,
                   spoil_blocks(images, options_.nan_depth, kNothing, nan_));
  }
}

void RobotFaults::spoil_line(std::vector<float>& range_m, double range_max_m, double time_s) {
  switch (next_frame(!last_line_.empty(), time_s)) {
    case Frame::dropped: std::ranges::fill(range_m, kNothing); return;
    case Frame::frozen: range_m = last_line_; return;
    case Frame::whole: break;
  }
  spoil_ranges(range_m, range_max_m, time_s);
  if (options_.frozen_frames > 0.0) last_line_ = range_m;
}

void RobotFaults::spoil_planar(PlanarScan& scan, double time_s) {
  spoil_ranges(scan.range_m, scan.range_max_m, time_s);
}

void RobotFaults::spoil_ranges(std::span<float> range_m, double range_max_m, double time_s) {
  if (options_.laser_bias_m != 0.0) {
    for (float& range : range_m) range += static_cast<float>(options_.laser_bias_m);
    record_.strike(Fault::laser_bias, time_s);
  }
  if (options_.saturated_depth > 0.0) {
    record_.strike(
        Fault::saturated_depth, time_s,
        spoil_some(range_m, options_.saturated_depth, static_cast<float>(range_max_m), saturated_));
  }
  if (options_.nan_depth > 0.0) {
    record_.strike(Fault::nan_depth, time_s,
                   spoil_some(range_m, options_.nan_depth, kNothing, nan_));
  }
}

Pose2 RobotFaults::reported(const Pose2& increment, double time_s) {
  const bool slipped = std::exchange(slips_, slip_.cover(time_s));
  if (slips_) {
    if (!slipped) record_.strike(Fault::odometry_slip, time_s);
    return {};
  }
  if (options_.odometry_scale == 0.0) return increment;
  record_.strike(Fault::odometry_scale, time_s);
  const double scale = 1.0 + options_.odometry_scale;
  return {scale * increment.x_m, scale * increment.y_m, scale * increment.yaw_rad};
}

bool RobotFaults::in_the_dark(double time_s) {
  if (!dark_.cover(time_s)) return false;
  record_.strike(Fault::lights_out, time_s);
  return true;
}

}  // namespace vantage
