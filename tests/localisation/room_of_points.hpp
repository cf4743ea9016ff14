/// What a robot sees that never turns, in a room of few points that no voxel of 3 cm joins.
#pragma once

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

}  // namespace vantage::test_room
