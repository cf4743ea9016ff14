/// Views as the files of the RGB-D Object Dataset.
#pragma once

#include <filesystem>

#include "vantage/perception/dataset_index.hpp"
#include "vantage/perception/object_view.hpp"

namespace vantage {

/// Writes the five files of a view into the object's folder. Depth is rounded to millimetres.
/// @throws OutputError naming the file that could not be written.
void write_view(const ObjectView& view, const ViewEntry& entry);

/// The pose alone: the yaw, and the elevation if it is given.
void write_pose(const ViewEntry& entry);

}  // namespace vantage
