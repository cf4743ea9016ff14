/// One picture of an import: read, cut, written.
#pragma once

#include "vantage/dataset/pictures/import_pictures.hpp"
#include "vantage/dataset/pictures/imported_picture.hpp"

namespace vantage {

/// Writes all files of the view but its pose, which waits for the elevations of the others; or
/// notes why the picture is bad.
/// @throws OutputError
void take_in(ImportedPicture& picture, const ImportOptions& options, const PictureNotes& notes);

}  // namespace vantage
