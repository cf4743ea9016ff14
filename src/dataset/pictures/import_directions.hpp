/// From where imported pictures were taken.
#pragma once

#include <vector>

#include "vantage/dataset/pictures/import_pictures.hpp"
#include "vantage/dataset/pictures/imported_picture.hpp"

namespace vantage {

/// Opens the poses beside the pictures; `top` and `bottom` have elevations by their name.
/// @throws InputError naming a pose that cannot be read.
void read_poses(std::vector<ImportedPicture>& pictures);

/// Sets the yaw of every picture, and the bins of the outcome's notes.
/// @throws ConfigError if options name views that are not there, or give angles to some and leave
/// others without; InputError if some pictures have angles and others names without one.
void direct_views(const ImportOptions& options, std::vector<ImportedPicture>& pictures,
                  ImportOutcome& outcome);

}  // namespace vantage
