/// The table of ARCHITECTURE.md: which room may include which, and where the headers of each
/// third-party library may appear.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace vantage::architecture {

using Rooms = std::vector<std::string>;

inline Rooms operator+(Rooms a, const Rooms& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline const Rooms kGround{"core", "core/cancellation", "geometry", "information"};
inline const Rooms kPerception{
    "perception",        "perception/search",   "perception/clouds",      "perception/clutter",
    "perception/images", "perception/features", "perception/features/kit"};
inline const Rooms kBelief{"belief/map", "belief/objects", "belief/observation", "belief/tracking"};
inline const Rooms kPlanners{
    "planners",         "planners/gains",      "planners/visibility",           "planners/views",
    "planners/tours",   "planners/choice",     "planners/navigation",           "planners/travel",
    "planners/objects", "planners/trajectory", "planners/trajectory/optimisers"};
inline const Rooms kSim{"sim/world", "sim/render", "sim/sensors", "sim/robots", "sim/faults"};
inline const Rooms kRuntime{"runtime", "runtime/log", "runtime/drawing", "runtime/process"};
inline const Rooms kRecognition{"recognition", "recognition/calibration", "recognition/dataset",
                                "recognition/evaluation"};
inline const Rooms kStudy{"study",       "study/cluster",     "study/figures",
                          "study/kit",   "study/recognition", "study/sweep",
                          "study/tables"};
/// What several tasks share; they never include each other.
inline const Rooms kSharedByTasks{
    "tasks/mapping",          "tasks/mapping/drawing",   "tasks/mapping/driving",
    "tasks/mapping/external", "tasks/mapping/hindsight", "tasks/mapping/measures",
    "tasks/mapping/plans",    "tasks/mapping/simulated", "tasks/flight",
    "tasks/object_flight",    "tasks/table_map"};
inline const Rooms kTask = kGround + kPerception + kBelief + kPlanners + kSim + kRuntime +
                           kRecognition + kSharedByTasks +
                           Rooms{"control", "dataset", "localisation", "report"};

/// Which rooms each room may include besides itself.
inline const std::map<std::string, Rooms> kAllowed{
    {"core", {}},
    {"core/cancellation", {}},
    {"geometry", {"core"}},
    {"information", {"core"}},
    {"control", {"core", "geometry"}},
    {"perception/clouds", {"core", "geometry"}},
    {"perception/images", {"core"}},
    {"perception", kGround + Rooms{"perception/clouds", "perception/images"}},
    {"perception/clutter", kGround + Rooms{"perception"}},
    {"perception/search", kGround + Rooms{"perception"}},
    {"perception/features/kit", kGround + Rooms{"perception", "perception/clouds"}},
    {"perception/features/patches",
     kGround + Rooms{"perception", "perception/clouds", "perception/features/kit"}},
    {"perception/features",
     kGround + Rooms{"perception", "perception/clouds", "perception/features/kit",
                     "perception/features/patches"}},
    {"belief/map/octomap", {"core"}},
    {"belief/map", kGround + Rooms{"belief/map/octomap"}},
    {"belief/observation", kGround},
    {"belief/objects", kGround + Rooms{"belief/observation"}},
    {"belief/tracking", kGround},
    {"planners/visibility", kGround + Rooms{"belief/map"}},
    {"planners/gains", kGround + Rooms{"belief/map", "planners/visibility"}},
    {"planners/tours", {"core", "core/cancellation", "geometry"}},
    {"planners",
     kGround + Rooms{"belief/map", "planners/visibility", "planners/gains", "planners/tours"}},
    {"planners/views", kGround + Rooms{"belief/map", "planners"}},
    {"planners/choice",
     kGround + Rooms{"belief/map", "planners", "planners/navigation", "planners/travel",
                     "planners/views", "planners/tours", "planners/visibility"}},
    {"planners/navigation", kGround + Rooms{"belief/map"}},
    {"planners/travel", kGround + Rooms{"belief/map", "planners/navigation"}},
    {"planners/objects", kGround + Rooms{"belief/objects", "belief/observation"}},
    {"planners/trajectory/optimisers", {"core", "geometry"}},
    {"planners/trajectory",
     kGround + Rooms{"belief/map", "control", "planners/trajectory/optimisers"}},
    {"recognition/dataset", kGround + kPerception + Rooms{"belief/objects", "belief/observation"}},
    {"recognition/calibration",
     kGround + kPerception +
         Rooms{"belief/objects", "belief/observation", "planners/objects", "recognition/dataset"}},
    {"recognition",
     kGround + kPerception +
         Rooms{"belief/objects", "belief/observation", "planners/objects", "planners/trajectory",
               "recognition/calibration", "recognition/dataset"}},
    {"recognition/evaluation", kGround + Rooms{"recognition", "recognition/dataset"}},
    {"sim/stepping", {"core", "geometry"}},
    {"sim/world", {"core", "geometry", "sim/stepping"}},
    {"sim/render", {"core", "geometry", "sim/world"}},
    {"sim/sensors", {"core", "geometry", "sim/world", "sim/render"}},
    {"sim/robots", {"core", "geometry", "control", "sim/world"}},
    {"sim/faults", {"core", "geometry", "sim/world"}},
    {"models/catalogue/shapes", {"core", "geometry"}},
    {"models/catalogue/objects", {"core", "geometry", "models/catalogue/shapes"}},
    {"models/catalogue/database",
     {"core", "geometry", "models/catalogue/shapes", "models/catalogue/objects"}},
    {"models/catalogue/table",
     {"core", "geometry", "models/catalogue/shapes", "models/catalogue/objects"}},
    {"models/catalogue/office/plans", {"core", "geometry", "models/catalogue/shapes"}},
    {"models/catalogue/office",
     {"core", "geometry", "models/catalogue/shapes", "models/catalogue/office/plans"}},
    {"models/catalogue/flight", {"core", "geometry", "models/catalogue/shapes"}},
    {"models/catalogue",
     {"core", "models/catalogue/table", "models/catalogue/office", "models/catalogue/flight"}},
    {"dataset",
     {"core", "geometry", "perception", "perception/search", "models/catalogue/shapes",
      "models/catalogue/database", "sim/render", "sim/sensors"}},
    {"dataset/pictures", {"core", "geometry", "perception", "perception/images", "dataset"}},
    {"recipe", kGround + Rooms{"belief/objects", "belief/observation", "perception", "recognition",
                               "recognition/dataset", "dataset", "sim/render"}},
    {"localisation", {"core", "geometry", "perception/clouds"}},
    {"report", {"core", "geometry", "perception/clouds", "planners/tours"}},
    {"bound", {"core", "geometry"}},
    {"building", {"core", "geometry", "belief/map", "planners/navigation"}},
    {"hindsight", kTask + Rooms{"bound", "tasks", "tasks/*"}},
    {"runtime/process", {"core"}},
    {"runtime/drawing", {"core", "geometry", "belief/map", "planners/tours"}},
    {"runtime/log",
     {"core", "geometry", "belief/map", "planners", "planners/tours", "sim/world", "sim/render"}},
    {"runtime",
     kGround + Rooms{"belief/map", "planners", "planners/choice", "report", "runtime/log",
                     "sim/faults", "sim/world", "sim/render", "sim/robots"}},
    {"tasks/mapping", kTask},
    {"tasks/mapping/drawing", kTask},
    {"tasks/mapping/driving", kTask},
    {"tasks/mapping/external", kTask},
    {"tasks/mapping/hindsight", kTask},
    {"tasks/mapping/measures", kTask},
    {"tasks/mapping/plans", kTask},
    {"tasks/mapping/simulated", kTask},
    {"tasks/flight", kTask},
    {"tasks/object_flight", kTask},
    {"tasks/table_map", kTask},
    {"tasks", kGround + kSim + kRuntime + Rooms{"belief/map", "report", "tasks/*"}},
    {"study/figures", {"core", "geometry", "information", "report"}},
    {"study/recognition",
     kGround + kRecognition + kRuntime +
         Rooms{"belief/objects", "belief/observation", "report", "study/figures"}},
    {"study/kit", kGround + kRuntime + Rooms{"tasks"}},
    {"study/cluster", {"core"}},
    {"study/tables", {"core", "information", "report", "runtime", "study/figures"}},
    {"study",
     kGround + kRuntime +
         Rooms{"report", "study/cluster", "study/figures", "study/kit", "study/tables", "tasks"}},
    {"study/sweep", kGround + kRuntime + Rooms{"study", "study/cluster", "tasks"}},
    {"arena", kGround + kRuntime + kStudy + Rooms{"report", "tasks"}},
    {"view", kGround + kRuntime + kSim + Rooms{"tasks"}},
    {"mcap", kGround + kRuntime + kSim +
                 Rooms{"belief/map", "perception/clouds", "planners", "report", "tasks"}},
    {"cli/export", {"core", "cli/hints", "mcap", "runtime"}},
    {"cli/arena", kGround + kRuntime + kStudy + Rooms{"arena", "cli/hints", "hindsight", "tasks"}},
    {"cli/hints", {"core", "study"}},
    {"cli/hindsight",
     kGround + kRuntime + Rooms{"sim/world", "cli/hints", "hindsight", "report", "tasks"}},
    {"cli/recognition", kGround + kPerception + kRecognition + kRuntime +
                            Rooms{"belief/objects", "belief/observation", "planners/objects"}},
    {"cli/pictures", kGround + kRuntime + Rooms{"cli/hints", "dataset/pictures", "perception"}},
    {"cli/scene", {"core", "geometry", "building", "runtime"}},
    {"cli/sweep", kGround + kRuntime + kStudy + Rooms{"cli/hints", "tasks"}},
    {"cli/validation", {"core", "geometry", "recipe", "study", "tasks"}},
    {"cli/reference", kGround + kPerception + kPlanners + kSim + kRuntime + kRecognition + kStudy +
                          Rooms{"belief/objects", "belief/observation", "cli/hints", "dataset",
                                "hindsight", "recipe", "tasks"}},
    {"cli/manual", {"core"}},
    {"cli/schema", kGround + kPerception + kSim + kRuntime + kRecognition + kStudy +
                       Rooms{"dataset", "recipe", "tasks"}},
    {"cli", kGround + kPerception + kPlanners + kSim + kRuntime + kRecognition + kStudy +
                Rooms{"cli/arena", "cli/export", "cli/hindsight", "cli/hints", "cli/manual",
                      "cli/pictures", "cli/recognition", "cli/reference", "cli/scene", "cli/schema",
                      "cli/sweep", "cli/validation", "dataset", "hindsight",
                      "models/catalogue/database", "recipe", "report", "tasks", "view"}},
    {"bench/env", {"belief/map", "planners", "planners/views", "bench"}},
    {"bench/tables", {"core", "report", "study", "study/tables"}},
    {"bench/claims", {"core", "report", "study", "study/tables", "bench", "bench/tables"}},
    {"bench/pages",
     {"core", "planners/trajectory", "report", "study/cluster", "study/figures", "bench",
      "bench/claims"}},
    {"bench/model", kTask + Rooms{"bench", "tasks", "tasks/*"}},
    {"bench",
     kTask + kStudy + Rooms{"bench/claims", "hindsight", "tasks", "tasks/*", "tests/support"}},
    {"python/kit", kGround + Rooms{"planners", "planners/views"}},
    {"python/planning", kGround + kBelief + kPlanners + Rooms{"python", "python/kit"}},
    {"python/recognition",
     kGround + kPerception + kBelief + kPlanners + kRecognition + Rooms{"python", "python/kit"}},
    {"python/episodes", kGround + kBelief + kPlanners + kRuntime +
                            Rooms{"tasks", "python", "python/kit", "python/planning"}},
    {"python", kGround + kPlanners + kRuntime + Rooms{"tasks", "python/kit"}},
};

/// What a room may include; none if it is not in the table. A folder of src/tasks is a task.
inline const Rooms* allowed_in(const std::string& room) {
  if (const auto found = kAllowed.find(room); found != kAllowed.end()) return &found->second;
  return room.starts_with("tasks/") ? &kTask : nullptr;
}

inline bool is_allowed(const Rooms& rooms, const std::string& other) {
  return std::ranges::any_of(rooms, [&](const std::string& room) {
    return room == other ||
           (room.ends_with("/*") && other.starts_with(room.substr(0, room.size() - 1)));
  });
}

/// Where the headers of a library may appear.
struct LibraryRule {
  std::string_view prefix;           ///< of the header's name
  std::vector<std::string> folders;  ///< and their rooms
  bool sources_only = false;         ///< not in our headers
};

inline const std::vector<LibraryRule> kLibraries{
    {"mujoco/", {"sim"}},
    {"GL/", {"sim/render"}},
    {"GLFW/", {"sim/render"}},
    {"embree", {"sim/sensors"}},
    {"octomap/", {"belief/map", "bench"}, true},
    {"opencv2/",
     {"perception", "recognition", "dataset", "runtime", "tasks", "view", "mcap", "cli", "bench"}},
    {"nanoflann", {"perception/clouds"}},
    {"yaml-cpp/", {"core"}, true},
    {"spdlog/", {"core"}, true},
    {"nlohmann/json_fwd.hpp",
     {"core", "runtime", "tasks", "report", "study", "arena", "hindsight", "mcap", "cli",
      "bench"}},  // declarations only
    {"nlohmann/",
     {"core", "runtime", "tasks", "report", "study", "arena", "hindsight", "mcap", "cli", "bench"},
     true},
    {"png", {"models/catalogue/shapes"}},
    {"CLI/", {"cli"}, true},
    {"Clp", {"bound"}, true},
    {"ceres/", {"localisation"}, true},
    {"assimp/", {"building"}, true},
    {"zlib", {"mcap"}, true},
    {"zstd", {"mcap"}, true},
};

}  // namespace vantage::architecture
