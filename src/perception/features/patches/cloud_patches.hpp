/// Kernel descriptors of the patches of a surface. [BoEtAl2011]
#pragma once

#include "vantage/perception/features/kit/object_pixels.hpp"
#include "vantage/perception/features/kit/object_surface.hpp"
#include "vantage/perception/features/patches/patch_set.hpp"
#include "vantage/perception/features/patches/product_basis.hpp"

namespace vantage {

/// Every 8th pixel's neighbours within 5 cm, 10 to 256 of them, thinned evenly: mean over them of
/// the angle between the normals and the place as a spin image has it, along and off the normal.
/// @param basis its axes: angle (rad), along (m), off (m)
PatchSet describe_spins(const ObjectView& view, const ObjectPixels& pixels,
                        const ObjectSurface& surface, const ProductBasis& basis);

/// Mean over up to 1600 points of the object, taken evenly, of the distance to every 8th pixel's.
/// @param basis its axis: distance (m)
PatchSet describe_sizes(const ObjectPixels& pixels, const ObjectSurface& surface,
                        const ProductBasis& basis);

}  // namespace vantage
