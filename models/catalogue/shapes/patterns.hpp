/// What surfaces of everyday things look like, as patterns over a rectangle.
#pragma once

#include <string_view>

#include "vantage/core/rng.hpp"
#include "vantage/models/catalogue/shapes/texture.hpp"

namespace vantage {

Pattern bands(const RgbColour& a, const RgbColour& b, int count);  ///< `count` pairs, horizontal
Pattern stripes(const RgbColour& a, const RgbColour& b, int count,
                double slant = 0.0);  ///< vertical
Pattern checks(const RgbColour& a, const RgbColour& b, int columns, int rows);
/// Staggered rows of dots; `radius` as a fraction of the row height, at most 0.5.
Pattern dots(const RgbColour& ground, const RgbColour& dot, int columns, int rows, double radius);
Pattern zigzag(const RgbColour& a, const RgbColour& b, int columns, int rows);
Pattern gradient(const RgbColour& bottom, const RgbColour& top);
/// Boards along s with grain; the Rng decides where knots and lines lie.
Pattern wood(const RgbColour& light, const RgbColour& dark, int boards, Rng& rng);
/// Square tiles with joints and slightly different tones.
Pattern tiles(const RgbColour& tile, const RgbColour& joint, int columns, int rows, Rng& rng);
/// Cloudy mixture of two colours; `cells` is the number of blotches across.
Pattern mottled(const RgbColour& a, const RgbColour& b, int cells, Rng& rng);
/// One of the regular patterns above, for crockery and packages.
Pattern any_pattern(const RgbColour& a, const RgbColour& b, Rng& rng);

/// Capital letters, digits and spaces in a 5 x 7 raster, fitted into `rect`; others are blank.
void draw_text(Image& image, const UvRect& rect, std::string_view text, const RgbColour& colour);
/// Lines of text that cannot be read, as small print looks from a distance.
void draw_small_print(Image& image, const UvRect& rect, const RgbColour& ink, Rng& rng);
void draw_barcode(Image& image, const UvRect& rect, Rng& rng);
/// A disc or ellipse that fills `rect`.
void draw_disc(Image& image, const UvRect& rect, const RgbColour& colour);

}  // namespace vantage
