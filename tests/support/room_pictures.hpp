/// Pictures as a user takes them: an object on a table before a wall, by a depth camera that leaves
/// holes, in rooms of different light. Written without the code under test.
#pragma once

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "vantage/core/rng.hpp"

namespace vantage::support {

/// A box, upright; its six sides in shades of its own.
struct Block {
  cv::Vec3d middle;
  cv::Vec3d half;
  std::array<cv::Vec3d, 6> rgb;  ///< -x, +x, -y, +y, -z, +z; 0 .. 1
};

struct RoomObject {
  std::string name;
  std::vector<Block> blocks;
};

struct Room {
  std::uint64_t seed = 1;
  double elevation_rad = 0.6;
  double distance_m = 0.85;
  double holes = 0.15;  ///< share of the picture without depth, about
  double margin = 0.5;  ///< round the object, of its size; below 0: the whole picture
};

struct RoomPicture {
  cv::Mat3b bgr;
  cv::Mat1f depth_m;  ///< 0: hole
  cv::Mat1b mask;     ///< of the object
};

inline constexpr double kRoomFocal_px = 285.0;  ///< at 320 x 240 px

inline const std::vector<std::string>& named_views() {
  static const std::vector<std::string> names{"front", "front_left", "left",       "back_left",
                                              "back",  "right",      "front_right"};
  return names;
}
inline double yaw_of_named_view(std::size_t view) {
  constexpr std::array kDegrees{0.0, 315.0, 270.0, 225.0, 180.0, 90.0, 45.0};
  return kDegrees.at(view) * std::numbers::pi / 180.0;
}

/// Objects of two to three blocks that differ in colours, shape and sides.
inline RoomObject made_up_object(const std::string& name, std::uint64_t seed) {
  Rng rng = Rng::stream(seed, "object " + name);
  RoomObject object{name, {}};
  const auto colours = [&] {
    std::array<cv::Vec3d, 6> sides;
    for (auto& c : sides) c = {rng.uniform(0.1, 0.9), rng.uniform(0.1, 0.9), rng.uniform(0.1, 0.9)};
    return sides;
  };
  const double a = rng.uniform(0.03, 0.07), b = rng.uniform(0.03, 0.07), h = rng.uniform(0.03, 0.1);
  object.blocks.push_back({{0, 0, h}, {a, b, h}, colours()});
  const double c = rng.uniform(0.015, 0.03), g = rng.uniform(0.01, 0.04);
  object.blocks.push_back(
      {{rng.uniform(-0.4, 0.4) * a, rng.uniform(-0.4, 0.4) * b, 2 * h + g}, {c, c, g}, colours()});
  object.blocks.push_back({{a + c, 0, 0.5 * h}, {c, 0.5 * b, 0.5 * h}, colours()});
  return object;
}

namespace detail {
struct Hit {
  double t = 1e9;
  cv::Vec3d rgb;
  bool object = false;
};

inline void hit_block(const Block& block, const cv::Vec3d& eye, const cv::Vec3d& ray, Hit& hit) {
  double enter = 0.0, leave = 1e9;
  int side = -1;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(ray[k]) < 1e-12) {
      if (std::abs(eye[k] - block.middle[k]) > block.half[k]) return;
      continue;
    }
    double low = (block.middle[k] - block.half[k] - eye[k]) / ray[k];
    double high = (block.middle[k] + block.half[k] - eye[k]) / ray[k];
    const bool flipped = low > high;
    if (flipped) std::swap(low, high);
    if (low > enter) {
      enter = low;
      side = 2 * k + (flipped ? 1 : 0);
    }
    leave = std::min(leave, high);
  }
  if (side < 0 || enter >= leave || enter >= hit.t) return;
  hit = {enter, block.rgb[static_cast<std::size_t>(side)], true};
}

/// A board of two colours of the room.
inline cv::Vec3d board(const cv::Vec3d& a, const cv::Vec3d& b, double u, double v, double size_m) {
  const bool even = (static_cast<int>(std::floor(u / size_m) + std::floor(v / size_m)) & 1) == 0;
  return even ? a : b;
}
}  // namespace detail

/// At `yaw_rad`, counter-clockwise from above, of the object.
inline RoomPicture room_picture(const RoomObject& object, double yaw_rad, const Room& room) {
  constexpr int kWidth = 320, kHeight = 240;
  Rng of_room = Rng::stream(room.seed, "room");
  const auto colour = [&] {
    return cv::Vec3d(of_room.uniform(0.1, 0.9), of_room.uniform(0.1, 0.9),
                     of_room.uniform(0.1, 0.9));
  };
  const cv::Vec3d table_a = colour(), table_b = colour(), wall_a = colour(), wall_b = colour();
  const cv::Vec3d light(of_room.uniform(0.85, 1.1), of_room.uniform(0.85, 1.1),
                        of_room.uniform(0.85, 1.1));
  const double wall_m = of_room.uniform(0.35, 0.7);  // behind the object
  Rng rng = Rng::stream(room.seed, fmt::format("{} at {:.3f}", object.name, yaw_rad));
  const double elevation = room.elevation_rad + rng.uniform(-0.03, 0.03);
  const double yaw = yaw_rad + rng.uniform(-0.08, 0.08);
  const double distance = room.distance_m * rng.uniform(0.93, 1.07);
  // The camera stands at +x of the object, which is turned below it.
  const cv::Vec3d aim(0, 0, 0.08);
  const cv::Vec3d back(std::cos(elevation), 0, std::sin(elevation));
  const cv::Vec3d eye = aim + distance * back;
  const cv::Vec3d right(0, 1, 0), down = -cv::Vec3d(-std::sin(elevation), 0, std::cos(elevation));
  const auto turned = [&](const cv::Vec3d& v) {
    return cv::Vec3d(std::cos(yaw) * v[0] + std::sin(yaw) * v[1],
                     -std::sin(yaw) * v[0] + std::cos(yaw) * v[1], v[2]);
  };
  const cv::Vec3d object_eye = turned(eye);
  RoomPicture picture{cv::Mat3b(kHeight, kWidth), cv::Mat1f(kHeight, kWidth),
                      cv::Mat1b(kHeight, kWidth)};
  const double cx = kWidth / 2.0, cy = kHeight / 2.0;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const cv::Vec3d ray =
          -back + (column - cx) / kRoomFocal_px * right + (row - cy) / kRoomFocal_px * down;
      detail::Hit hit;
      if (ray[2] < 0.0) {
        hit.t = -eye[2] / ray[2];
        const cv::Vec3d p = eye + hit.t * ray;
        hit.rgb = detail::board(table_a, table_b, p[0], p[1], 0.06);
      }
      const double wall_t = (-wall_m - eye[0]) / ray[0];
      if (wall_t > 0.0 && wall_t < hit.t) {
        const cv::Vec3d p = eye + wall_t * ray;
        hit = {wall_t, detail::board(wall_a, wall_b, p[1], p[2], 0.11), false};
      }
      for (const Block& block : object.blocks) {
        detail::hit_block(block, object_eye, turned(ray), hit);
      }
      picture.mask(row, column) = hit.object ? 255 : 0;
      const double z = hit.t;  // the ray's component along the axis is 1
      const double noise = 0.0015 * z * z * std::sqrt(-2.0 * std::log(1.0 - rng.uniform())) *
                           std::cos(2.0 * std::numbers::pi * rng.uniform());
      picture.depth_m(row, column) = static_cast<float>(std::round(1000.0 * (z + noise)) / 1000.0);
      for (int c = 0; c < 3; ++c) {
        const double value = 255.0 * hit.rgb[c] * light[c] + 12.0 * (rng.uniform() - 0.5);
        picture.bgr(row, column)[2 - c] = cv::saturate_cast<std::uint8_t>(value);
      }
    }
  }
  // Holes: the projector's shadow to the left of what is near, and blobs that are dark or shiny.
  cv::Mat1f whole = picture.depth_m.clone();
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 1; column < kWidth; ++column) {
      if (whole(row, column - 1) - whole(row, column) < 0.02F) continue;
      const int width = 1 + static_cast<int>(rng.uniform_index(5));
      for (int x = std::max(0, column - width); x <= column; ++x) picture.depth_m(row, x) = 0.0F;
    }
  }
  const double area = kWidth * kHeight;
  for (double lost = 0.0; lost < room.holes * area;) {
    const int radius = 1 + static_cast<int>(rng.uniform_index(6));
    const cv::Point at(static_cast<int>(rng.uniform_index(kWidth)),
                       static_cast<int>(rng.uniform_index(kHeight)));
    cv::circle(picture.depth_m, at, radius, 0.0, cv::FILLED);
    lost += std::numbers::pi * radius * radius;
  }
  if (room.margin < 0.0) return picture;
  cv::Rect box = cv::boundingRect(picture.mask);
  const auto grow = [&](int size) {
    return static_cast<int>(room.margin * size * rng.uniform(0.5, 1.0));
  };
  const int left = grow(box.width), top = grow(box.height);
  box = cv::Rect(box.x - left, box.y - top, box.width + left + grow(box.width),
                 box.height + top + grow(box.height)) &
        cv::Rect(0, 0, kWidth, kHeight);
  return {picture.bgr(box).clone(), picture.depth_m(box).clone(), picture.mask(box).clone()};
}

/// As NumPy's float32.
inline void write_npy(const std::filesystem::path& file, const cv::Mat1f& values) {
  std::string header = fmt::format(
      "{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}), }}", values.rows, values.cols);
  header.resize((10 + header.size() + 64) / 64 * 64 - 11, ' ');
  header += '\n';
  std::ofstream stream(file, std::ios::binary);
  stream << std::string("\x93NUMPY\x01\x00", 8) << static_cast<char>(header.size() % 256)
         << static_cast<char>(header.size() / 256) << header;
  for (int row = 0; row < values.rows; ++row) {
    stream.write(reinterpret_cast<const char*>(values.ptr<float>(row)),
                 static_cast<std::streamsize>(sizeof(float)) * values.cols);
  }
}

enum class DepthFormat { png_mm, npy_m };

/// `<folder>/<view>_rgb.png` and `<view>_depth.png` or `.npy`.
inline void put_picture(const std::filesystem::path& folder, const std::string& view,
                        const RoomPicture& picture, DepthFormat format, bool mask = false) {
  std::filesystem::create_directories(folder);
  const std::string stem = (folder / view).string();
  cv::imwrite(stem + "_rgb.png", picture.bgr);
  if (mask) cv::imwrite(stem + "_mask.png", picture.mask);
  if (format == DepthFormat::npy_m) return write_npy(stem + "_depth.npy", picture.depth_m);
  cv::Mat1w mm;
  picture.depth_m.convertTo(mm, CV_16U, 1000.0);
  cv::imwrite(stem + "_depth.png", mm);
}

/// `count` objects, seven named views each, under `root/<object>/`.
inline void put_room(const std::filesystem::path& root, int count, const Room& room,
                     DepthFormat format = DepthFormat::png_mm, bool masks = false) {
  for (int k = 0; k < count; ++k) {
    const RoomObject object = made_up_object(fmt::format("thing{}", static_cast<char>('a' + k)), 7);
    for (std::size_t v = 0; v < named_views().size(); ++v) {
      put_picture(root / object.name, named_views()[v],
                  room_picture(object, yaw_of_named_view(v), room), format, masks);
    }
  }
}

}  // namespace vantage::support
