/// Colour, depth and masks from files of the formats that cameras' programs write.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace vantage {

struct ColourImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 bytes a pixel, row by row
};

struct DepthImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> depth_m;  ///< row by row; 0: no measurement
  double unit_m = 0.001;       ///< what 1 in the file stands for
};

struct MaskImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> mask;  ///< 1 where the file is not black
};

/// PNG, JPEG, BMP, PPM or TIFF of 8 bits: colour, with or without alpha, or grey.
/// @throws InputError naming the file if it is missing, cut short or something else.
ColourImage read_colour_image(const std::filesystem::path& file);

/// NPY, or PNG or TIFF of one channel of 16 bits or floats. What is not finite, not positive or
/// the greatest number of 16 bits is no measurement.
/// @param unit_m what 1 in the file stands for; 0: found out, integers are millimetres, floats
/// millimetres or metres by their size
/// @throws InputError naming the file if it is missing, cut short or something else, if nothing in
/// it is a measurement but the greatest number, or its unit cannot be told.
DepthImage read_depth_image(const std::filesystem::path& file, double unit_m = 0.0);

/// Of 1, 8 or 16 bits, grey or colour.
/// @throws InputError as read_colour_image()
MaskImage read_mask_image(const std::filesystem::path& file);

/// What a file may be by what it holds; a TIFF is opened for it.
enum class ImageKind { colour, depth, mask, other };
/// NPY and images of 16 bits or floats are depth; of 8 bits colour, grey ones `mask`.
ImageKind image_kind(const std::filesystem::path& file);

}  // namespace vantage
