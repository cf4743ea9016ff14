#include "vantage/runtime/record_text.hpp"

namespace vantage {

RecordTexts run_records() {
  return {
      {kRunFolder, "manifest.json",
       "command, versions, CPU, seed, hashes of configuration, scene and every asset, times; of "
       "choice external, planner: its command, name and isolation"},
      {kRunFolder, "config.yaml", "the configuration as resolved, defaults included"},
      {kRunFolder, "steps.csv", "a row a scan, view or waypoint"},
      {kRunFolder, "candidates.csv", "a row a candidate of every decision; not with --lean"},
      {kRunFolder, "metrics.json", "what was measured of the episode"},
      {kRunFolder, "trajectory.tum",
       "true pose of the body, some ten rows a simulated second: time s, x y z m, quaternion x y z "
       "w, world frame; path lengths in metrics.json are of every control tick"},
      {kRunFolder, "trajectory_estimated.tum", "the same as the robot believed, at the same times"},
      {kRunFolder, "states.bin",
       "every state, for replay; little-endian: \"VANTAGE STATES 1\\n\" (17 bytes), size n of a "
       "state and number m of actuators (2 x u64), then rows of n + m numbers (f64): time s, "
       "qpos (nq), qvel (nv), act (na), qacc_warmstart (nv) as in MuJoCo, so that n = 1 + nq + 2 "
       "nv + na, and the m commands held during the tick that led to it, in the order of "
       "actions.csv. Row 0 is the start, under no command; row k comes k ticks of "
       "simulation.control_period_s later"},
      {kRunFolder, "actions.csv",
       "commands of the actuators, a row whenever they change: tick, then a column an actuator; a "
       "row of tick k is held from row k of states.bin on"},
      {kRunFolder, "story.bin",
       "events for the window; little-endian: \"VANTAGE STORY 1\\n\", then per event tick (u64), "
       "kind (u32: 0 map, 1 decision, 2 way, 3 flight, 4 tour), count (u32), chosen (u64) and "
       "count "
       "entries: of a map first (u32), count (u32), state (u32: 0 free, 1 unobserved, 2 occupied); "
       "of a decision the upper three rows of T_world_sensor, gain, reachable (14 x f64); of a way "
       "x, y (2 x f64); of a flight x, y, z (3 x f64); of a tour, whose chosen is why it changed "
       "(0 first, 1 ended, 2 kept, 3 gone, 4 exhausted, 5 unreachable, 6 unaffordable, 7 cheaper, "
       "8 replanned), what it saves in s (f64), then id, x, y, yaw, arrival s, departure s, gain, "
       "beyond of each stop (8 x f64), as in plans.csv"},
      {kRunFolder, "voxels.bin",
       "cells for the report; little-endian: \"VTGVOX01\", cell size (3 x f64), box minimum and "
       "maximum (6 x f64), count (u64), then per voxel, 16 bytes, the centre of its cell x, y, z m "
       "in the world frame (f32), step (u16), kind (u8: 0 occupied, 1 unobserved at the end), 0 "
       "(u8). Steps count from 0: one less than the scan, view or waypoint of steps.csv; of kind 1 "
       "they mean nothing. What is not listed is free; but flights along a path list no unobserved "
       "cells: there it may be unobserved too"},
      {kRunFolder, "scene.bin",
       "flights: triangles of the scene for the report; its format is in "
       "src/report/drawn_scene.hpp"},
      {kRunFolder, "map.bt", "occupancy map, OctoMap binary: occupied and free"},
      {kRunFolder, "map.ot", "occupancy map, OctoMap with log odds"},
      {kRunFolder, "cloud.ply", "points of all scans, world frame"},
      {kRunFolder, "looks.csv", "flights along a path: a row an observation of an object"},
      {kRunFolder, "faults.csv",
       "with faults: time_s and fault, a row whenever one strikes that has not for a second"},
      {kRunFolder, "views", "flights: pictures of what was looked at"},
      {kRunFolder, "video.mp4", "with --video"},
      {kRunFolder, "frames", "with --video: stills"},
      {kRunFolder, "bound.json",
       "by vantage bound: what any policy needs at least for 80, 90, 95 and 97 % of the observable "
       "cells, beside what the run took"},
      {kRunFolder, "branches.json",
       "by vantage branch --all: what each view of a decision would have brought, and the regret "
       "of the chosen one"},
      {kRunFolder, "report.html", "the page of the run"},
      {kRunFolder, "log.txt", "what was told on stderr, debug messages included"},
      {"metrics.json", "task", "of the episode; both mapping tasks are next_best_view"},
      {"metrics.json", "status", "completed, failed, diverged or interrupted"},
      {"metrics.json", "reason", "why the episode ended: which limit, which stop, what failed"},
      {"metrics.json", "seed", "of every random stream"},
      {"metrics.json", "scene", "MJCF file of the scene"},
      {"metrics.json", "method", "gain, choice or optimiser that the episode tries out"},
      {"metrics.json", "simulated_time_s", "length of the episode"},
      {"metrics.json", "wall_time_s", "how long it took"},
      {"metrics.json", "real_time_factor", "simulated time over wall time"},
      {"metrics.json", "path_length_m", "way of the body, from the start"},
      {"metrics.json", "collisions", "contacts of the robot with something, counted as they begin"},
      {"metrics.json", "state_hash",
       "of the robot's every state and command; the same for the same episode. What it saw and "
       "decided is not in it: vantage compare tells"},
      {"metrics.json", "faults",
       "of the faults that are on (faults), how often each has struck: frames dropped or frozen; "
       "readings spoilt; lines of a laser with a bias; increments out of scale; stretches of slip; "
       "ticks of late commands or of a weak rotor; gusts; images in the dark; objects moved"},
      {"faults.csv", "time_s", "simulated, when the fault began to strike"},
      {"faults.csv", "fault", "as metrics.json calls it"},
  };
}

RecordTexts joined(RecordTexts first, std::span<const RecordText> more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

}  // namespace vantage
