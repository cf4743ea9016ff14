/// What a robot sees that never turns, in a room of few points that no voxel of 3 cm joins.
#pragma once

#include <cmath>

#include "vantage/localisation/keyframe_graph.hpp"
#include "vantage/perception/clouds/point_cloud.hpp"

namespace vantage::test_room {

/// Of points 12 cm apart, seen from `x_m` along its own x axis; a multiple of 3 cm.
struct Room {
  PointCloud seen;
  float x_m = 0.0F;

  void add(float x, float y, float normal_x, float normal_y) {
    seen.points.emplace_back(x - x_m, y, 0.255F);
    seen.normals.emplace_back(normal_x, normal_y, 0.0F);
  }
  void across_x(float x, float facing, int first, int end) {
    for (int j = first; j < end; ++j) add(x, 0.015F + 0.12F * static_cast<float>(j), facing, 0.0F);
  }
  void across_y(float y, float facing, int first, int end) {
    for (int j = first; j < end; ++j) add(0.015F + 0.12F * static_cast<float>(j), y, 0.0F, facing);
  }
};

/// 30 points on each of two walls of a room of 6 x 4 m.
inline void add_front(Room& room) {
  room.across_x(2.985F, -1.0F, -15, 15);
  room.across_y(1.935F, -1.0F, -15, 15);
}
/// And on each of the others.
inline void add_back(Room& room) {
  room.across_x(-2.985F, 1.0F, -15, 15);
  room.across_y(-1.935F, 1.0F, -15, 15);
}
/// 48 points on a pillar in its middle, more than half a metre from any wall.
inline void add_pillar(Room& room) {
  room.across_x(0.495F, 1.0F, -6, 6);
  room.across_x(-0.495F, -1.0F, -6, 6);
  room.across_y(1.095F, 1.0F, -6, 6);
  room.across_y(-1.095F, -1.0F, -6, 6);
}

inline PointCloud front() {
  Room room;
  add_front(room);
  return room.seen;
}
inline PointCloud back() {
  Room room;
  add_back(room);
  return room.seen;
}
inline PointCloud walls(float from_x_m = 0.0F) {
  Room room{{}, from_x_m};
  add_front(room);
  add_back(room);
  return room.seen;
}
inline PointCloud pillar(float from_x_m = 0.0F) {
  Room room{{}, from_x_m};
  add_pillar(room);
  return room.seen;
}

inline PointCloud room_and_pillar(float walls_from_x_m, float pillar_from_x_m) {
  PointCloud seen = walls(walls_from_x_m);
  append(seen, pillar(pillar_from_x_m));
  return seen;
}

/// Five times as high, row over row.
inline PointCloud tall(const PointCloud& seen) {
  PointCloud all;
  for (int row = 0; row < 5; ++row) {
    PointCloud higher = seen;
    for (auto& p : higher.points) p.z() += 0.12F * static_cast<float>(row);
    append(all, higher);
  }
  return all;
}

/// Points as a robot sees them that stands there in the room.
inline PointCloud seen_from(const Pose2& T_room_base, const PointCloud& in_room) {
  return transform(in_room, to_se3(inverse(T_room_base)));
}

inline constexpr double kSureWheels_m = 0.001;

/// Keyframes in a room, the first of which is where nothing has been driven.
class InARoom {
 public:
  explicit InARoom(const PointCloud& seen, const LoopOptions& loops = {.close = true})
      : graph_(loops, {}) {
    graph_.begin(seen, {1.5, -2.5, 0.4});
  }
  /// @return whether there are new loops
  bool go(const PointCloud& seen, double driven_m, double forward_m = 0.0,
          double sigma_m = kSureWheels_m, double sigma_rad = 0.001) {
    WheelStep step;
    step.T_previous_now = {forward_m, 0.0, 0.0};
    step.covariance = Eigen::Vector3d(sigma_m, sigma_m, sigma_rad).cwiseAbs2().asDiagonal();
    step.driven_m = driven_m;
    graph_.add(seen, step);
    return graph_.close_loops();
  }
  bool stay(double driven_m) { return go(walls(), driven_m); }
  [[nodiscard]] const KeyframeGraph& graph() const { return graph_; }
  [[nodiscard]] double moved_m() const {
    const Pose2 from = graph_.T_world_bases().front();
    const Pose2 to = graph_.T_world_bases().back();
    return std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
  }

 private:
  KeyframeGraph graph_;
};

}  // namespace vantage::test_room
