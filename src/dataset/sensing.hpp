/// From an image of the simulator to the view a real camera and its segmentation would give.
#pragma once

#include "vantage/core/rng.hpp"
#include "vantage/dataset/turntable.hpp"
#include "vantage/perception/object_view.hpp"
#include "vantage/sim/render/renderer.hpp"

namespace vantage {

/// Averages colours over the rays of a pixel, adds the noise of colour and depth, grows the mask
/// over the object's edge and cuts the view out round it; or cuts it out by depth.
/// @param drawn what Turntable::draw made, `object_geom` the object's id in its segmentation
/// @return an empty view (width 0) if nothing of the object is seen.
ObjectView sense(const RenderedImages& drawn, int object_geom, const Session& session,
                 const DatasetOptions& options, Rng& rng);

}  // namespace vantage
