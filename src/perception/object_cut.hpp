/// The object of a picture, told from what is around it by depth alone: for pictures without a
/// mask, cropped round the object or whole ones of an object on a table.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/perception/object_view.hpp"

namespace vantage {

/// How the object's pixels are told. A model that learnt from one way expects no other.
enum class ObjectCut {
  mask,   ///< by a mask that came with the picture
  depth,  ///< by cut_by_depth()
  whole,  ///< all pixels
};
std::string_view to_string(ObjectCut cut);
/// @param where for the message @throws ConfigError if `text` is none of them.
ObjectCut object_cut_of(std::string_view text, std::string_view where);

struct CutObject {
  /// The picture cropped round the object, with its mask.
  std::optional<ObjectView> view;
  std::string reason;  ///< why there is none; empty when found
  /// Of the camera over the support surface, if the picture shows one.
  std::optional<double> elevation_rad;
};

/// What is before the background's planes and hangs together, nearest to the middle of the picture;
/// without such planes, what hangs together in depth there. Holes of depth within it belong to it,
/// but not those at its edge. The same picture is always cut the same way.
/// @param picture colour, depth, intrinsics; a mask does not count
CutObject cut_by_depth(const ObjectView& picture);

/// The picture with this mask, cropped round it. @param mask of its size, not empty
ObjectView crop_to_mask(const ObjectView& picture, const std::vector<std::uint8_t>& mask);

/// The picture with a mask of all its pixels.
ObjectView cut_nothing(ObjectView picture);

}  // namespace vantage
