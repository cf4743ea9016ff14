/// Images stuck onto objects from one side.
#pragma once

#include "vantage/models/catalogue/objects/families.hpp"

namespace vantage {

struct Sticker {
  double heading_rad = 0.0;  ///< from the object's axis towards those who see it
  double middle = 0.5;       ///< height of its middle over the object's
  double width_m = 0.03;     ///< across the line of sight
  double height_m = 0.03;    ///< along z
  Image sticker_image;
};

/// Lays the image onto what is seen of the object along the sticker's heading, as a thin sheet of
/// its own; parts that find no surface, or one seen edge-on, are left out. The image goes into a
/// strip of texture below the others.
/// @return share of the image that found a surface, [0, 1].
double apply_sticker(GeneratedObject& object, const Sticker& sticker);

}  // namespace vantage
