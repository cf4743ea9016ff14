#include "vantage/models/catalogue/shapes/texture.hpp"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

struct PixelBox {
  int x0, y0, x1, y1;  // half open
};

int first_centre_at_or_after(double edge, int count) {
  return std::clamp(static_cast<int>(std::ceil(edge * count - 0.5)), 0, count);
}

PixelBox pixels_of(const Image& image, const UvRect& rect) {
  return {first_centre_at_or_after(rect.u0, image.width_px),
          first_centre_at_or_after(1.0 - rect.v1, image.height_px),
          first_centre_at_or_after(rect.u1, image.width_px),
          first_centre_at_or_after(1.0 - rect.v0, image.height_px)};
}

/// libpng's descriptor of an image in memory, released on every way out.
struct PngImage {
  png_image header{};
  PngImage() { header.version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(&header); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

void describe(const Image& image, png_image& header) {
  header.width = static_cast<png_uint_32>(image.width_px);
  header.height = static_cast<png_uint_32>(image.height_px);
  header.format = PNG_FORMAT_RGB;
}

}  // namespace

RgbColour hsv(double hue, double saturation, double brightness) {
  const auto channel = [&](double offset) {
    const double k = std::fmod(offset + (hue - std::floor(hue)) * 6.0, 6.0);
    return brightness * (1.0 - saturation * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0));
  };
  return {channel(5.0), channel(3.0), channel(1.0)};
}

RgbColour mix(const RgbColour& a, const RgbColour& b, double share_of_b) {
  return a + share_of_b * (b - a);
}

Image::Image(int width, int height, const RgbColour& fill) : width_px(width), height_px(height) {
  expects(width > 0 && height > 0, "an image has pixels");
  rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  paint(*this, UvRect{}, fill);
}

namespace {
std::size_t first_byte(int width_px, int x_px, int y_px) {
  return 3 * (static_cast<std::size_t>(y_px) * static_cast<std::size_t>(width_px) +
              static_cast<std::size_t>(x_px));
}
}  // namespace

RgbColour Image::at(int x_px, int y_px) const {
  const std::size_t i = first_byte(width_px, x_px, y_px);
  return RgbColour(rgb[i], rgb[i + 1], rgb[i + 2]) / 255.0;
}

void Image::set(int x_px, int y_px, const RgbColour& colour) {
  const std::size_t i = first_byte(width_px, x_px, y_px);
  for (int c = 0; c < 3; ++c) {
    rgb[i + static_cast<std::size_t>(c)] =
        static_cast<std::uint8_t>(std::floor(std::clamp(colour[c], 0.0, 1.0) * 255.0 + 0.5));
  }
}

void paint(Image& image, const UvRect& rect, const Pattern& pattern) {
  const PixelBox box = pixels_of(image, rect);
  for (int y = box.y0; y < box.y1; ++y) {
    const double v = 1.0 - (y + 0.5) / image.height_px;
    for (int x = box.x0; x < box.x1; ++x) {
      const double u = (x + 0.5) / image.width_px;
      image.set(x, y,
                pattern((u - rect.u0) / (rect.u1 - rect.u0), (v - rect.v0) / (rect.v1 - rect.v0)));
    }
  }
}

void paint(Image& image, const UvRect& rect, const RgbColour& colour) {
  paint(image, rect, [&](double, double) { return colour; });
}

void speckle(Image& image, const UvRect& rect, double sigma, int block_px, Rng& rng) {
  const PixelBox box = pixels_of(image, rect);
  for (int y0 = box.y0; y0 < box.y1; y0 += block_px) {
    for (int x0 = box.x0; x0 < box.x1; x0 += block_px) {
      const double change = sigma * rng.normal();
      for (int y = y0; y < std::min(y0 + block_px, box.y1); ++y) {
        for (int x = x0; x < std::min(x0 + block_px, box.x1); ++x) {
          image.set(x, y, image.at(x, y) * (1.0 + change));
        }
      }
    }
  }
}

std::string png_bytes(const Image& image) {
  PngImage png;
  describe(image, png.header);
  const auto write = [&](void* memory, png_alloc_size_t& size) {
    return png_image_write_to_memory(&png.header, memory, &size, 0, image.rgb.data(), 0, nullptr);
  };
  png_alloc_size_t size = 0;
  expects(write(nullptr, size) != 0, "an image becomes a PNG");
  std::string bytes(size, '\0');
  expects(write(bytes.data(), size) != 0, "an image becomes a PNG");
  bytes.resize(size);
  return bytes;
}

void write_png(const Image& image, const std::filesystem::path& path) {
  write_file_with(path, [&](const std::filesystem::path& part) {
    PngImage png;
    describe(image, png.header);
    return png_image_write_to_file(&png.header, part.c_str(), 0, image.rgb.data(), 0, nullptr) != 0;
  });
}

Image read_png(const std::filesystem::path& path) {
  PngImage png;
  const auto fail = [&] { throw InputError(path.string() + ": " + png.header.message); };
  if (png_image_begin_read_from_file(&png.header, path.c_str()) == 0) fail();
  png.header.format = PNG_FORMAT_RGB;
  Image image;
  image.width_px = static_cast<int>(png.header.width);
  image.height_px = static_cast<int>(png.header.height);
  image.rgb.resize(PNG_IMAGE_SIZE(png.header));
  if (png_image_finish_read(&png.header, nullptr, image.rgb.data(), 0, nullptr) == 0) fail();
  return image;
}

}  // namespace vantage
