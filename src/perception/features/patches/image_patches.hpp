/// Kernel descriptors of the patches of an attribute image.
#pragma once

#include "vantage/perception/features/kit/object_pixels.hpp"
#include "vantage/perception/features/patches/attribute_image.hpp"
#include "vantage/perception/features/patches/patch_set.hpp"
#include "vantage/perception/features/patches/product_basis.hpp"

namespace vantage {

/// E vec(A diag(m) S') of patches of 16 x 16 px every 8 px that have at least 64 px on the object
/// [BoEtAl2010, (13)]; m = weights / max(norm of the weights, 0.8).
///
/// Sums over a patch are taken first along its rows, shared by the patches above each other, then
/// along its columns, one eigenfunction of position at a time.
/// @param basis its axes: those of the attributes, then x and y within the patch, 0 .. 15/16
PatchSet describe_patches(const AttributeImage& image, const ObjectPixels& pixels,
                          const ProductBasis& basis);

}  // namespace vantage
