/// What kernel descriptors compare at each pixel of an image.
#pragma once

#include <Eigen/Core>

#include "vantage/perception/features/kit/object_pixels.hpp"
#include "vantage/perception/object_view.hpp"

namespace vantage {

struct AttributeImage {
  int width_px = 0;
  int height_px = 0;
  Eigen::MatrixXf attributes;  ///< axes x pixels, row-major pixels
  Eigen::VectorXf weights;     ///< of each pixel, >= 0; 0 beside the object
};

/// The view at the size kernel descriptors are taken at: its shorter side enlarged to 45 px, its
/// longer side shrunk to 300 px, where they differ.
ObjectView at_kernel_size(const ObjectView& view);

/// (gx, gy) / norm, weight norm: of grey in 0 .. 1, by derivatives of a Gaussian of sigma 0.8 px
/// that answer 1 to a step of 1.
AttributeImage rgb_gradient_image(const ObjectView& view, const ObjectPixels& pixels);
/// The same of depth, m, where it is known all around.
AttributeImage depth_gradient_image(const ObjectView& view, const ObjectPixels& pixels);

/// Pattern of the 8 neighbours that are at least as bright as the pixel, clockwise from the upper
/// left as bits from the lowest; weight: standard deviation of the 3 x 3 pixels.
/// [OjalaEtAl2002]
AttributeImage lbp_image(const ObjectView& view, const ObjectPixels& pixels);
/// The same of depth, m, where it is known all around.
AttributeImage depth_lbp_image(const ObjectView& view, const ObjectPixels& pixels);

/// (rgb - m) / sd / 4, weight sd: m the mean over channels and 5 x 5 pixels, sd = sqrt(v + 0.001),
/// v the mean over 5 x 5 pixels of the channels' summed squares of rgb - m; rgb in 0 .. 1.
AttributeImage normalised_rgb_image(const ObjectView& view, const ObjectPixels& pixels);

}  // namespace vantage
