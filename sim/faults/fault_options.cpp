#include "vantage/sim/faults/fault_options.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vantage {
namespace {

struct FaultRow {
  std::string_view name;
  std::string_view key;
  double (*amount)(const FaultOptions&);
  bool FaultyParts::*part;  ///< that it befalls; none: every robot has it
  std::string_view part_text;
};

/// In the order of Fault.
constexpr std::array<FaultRow, kFaults> kRows{{
    {"dropped_frames", "dropped_frames", [](const FaultOptions& o) { return o.dropped_frames; },
     nullptr, ""},
    {"frozen_frames", "frozen_frames", [](const FaultOptions& o) { return o.frozen_frames; },
     nullptr, ""},
    {"nan_depth", "nan_depth", [](const FaultOptions& o) { return o.nan_depth; }, nullptr, ""},
    {"saturated_depth", "saturated_depth", [](const FaultOptions& o) { return o.saturated_depth; },
     nullptr, ""},
    {"laser_bias", "laser_bias_m", [](const FaultOptions& o) { return o.laser_bias_m; },
     &FaultyParts::laser, "no laser"},
    {"odometry_scale", "odometry_scale", [](const FaultOptions& o) { return o.odometry_scale; },
     &FaultyParts::wheels, "no wheels"},
    {"odometry_slip", "odometry_slip", [](const FaultOptions& o) { return o.odometry_slip; },
     &FaultyParts::wheels, "no wheels"},
    {"late_commands", "late_commands_ticks",
     [](const FaultOptions& o) { return static_cast<double>(o.late_commands_ticks); }, nullptr, ""},
    {"weak_rotor", "weak_rotor", [](const FaultOptions& o) { return o.weak_rotor; },
     &FaultyParts::rotors, "no rotors"},
    {"gust", "gust_N", [](const FaultOptions& o) { return o.gust_N; }, &FaultyParts::rotors,
     "wheels on the floor, which no gust moves"},
    {"lights_out", "lights_out", [](const FaultOptions& o) { return o.lights_out; },
     &FaultyParts::colour, "no use for colour"},
    {"moved_object", "moved_object_m", [](const FaultOptions& o) { return o.moved_object_m; },
     nullptr, ""},
}};

const FaultRow& row_of(Fault fault) { return kRows[static_cast<std::size_t>(fault)]; }

}  // namespace

void FaultOptions::check() const {
  if (gust_duration_s > gust_every_s) {
    throw ConfigError(fmt::format("gust_duration_s: {} is longer than gust_every_s = {}",
                                  gust_duration_s, gust_every_s));
  }
  if (!moved_object.empty() && moved_object_m == 0.0) {
    throw ConfigError(fmt::format("moved_object: '{}' moves by moved_object_m = 0", moved_object));
  }
}

std::string_view name_of(Fault fault) { return row_of(fault).name; }

double amount_of(const FaultOptions& options, Fault fault) { return row_of(fault).amount(options); }

bool any_fault(const FaultOptions& options) {
  return std::ranges::any_of(kRows,
                             [&](const FaultRow& row) { return row.amount(options) != 0.0; });
}

void require_possible(const FaultOptions& options, const FaultyParts& parts) {
  for (const FaultRow& row : kRows) {
    if (row.amount(options) == 0.0 || row.part == nullptr || parts.*row.part) continue;
    throw ConfigError(fmt::format("faults.{}: {} does not befall the robot of this task: it has {}",
                                  row.key, row.amount(options), row.part_text));
  }
}

}  // namespace vantage
