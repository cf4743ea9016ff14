/// RGB images as textures: the buffer, painting by patterns, PNG files.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/models/catalogue/shapes/uv_rect.hpp"

namespace vantage {

/// Red, green, blue in [0, 1].
using RgbColour = Eigen::Vector3d;

/// Hue in turns (0 red, 1/3 green, 2/3 blue), saturation and brightness in [0, 1].
RgbColour hsv(double hue, double saturation, double brightness);
RgbColour mix(const RgbColour& a, const RgbColour& b, double share_of_b);

struct Image {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgb;  ///< row-major, top row first

  Image() = default;
  Image(int width_px, int height_px, const RgbColour& fill);

  [[nodiscard]] RgbColour at(int x_px, int y_px) const;
  void set(int x_px, int y_px, const RgbColour& colour);  ///< clamps to [0, 1]
  bool operator==(const Image&) const = default;
};

/// A colour at fractions (s, t) of a rectangle, s to the right and t up.
using Pattern = std::function<RgbColour(double s, double t)>;

/// Fills the pixels whose centres lie in `rect`.
void paint(Image& image, const UvRect& rect, const Pattern& pattern);
void paint(Image& image, const UvRect& rect, const RgbColour& colour);

/// Brightness noise of standard deviation `sigma` in blocks of `block_px`.
void speckle(Image& image, const UvRect& rect, double sigma, int block_px, Rng& rng);

/// The bytes of a PNG file.
std::string png_bytes(const Image& image);
/// @throws OutputError if the file cannot be written.
void write_png(const Image& image, const std::filesystem::path& path);
/// @throws InputError if the file is missing or no PNG; other formats than RGB are converted.
Image read_png(const std::filesystem::path& path);

}  // namespace vantage
