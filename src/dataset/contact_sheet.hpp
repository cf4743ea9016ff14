/// One view of each object of a dataset, in a grid.
#pragma once

#include <filesystem>

#include "vantage/perception/dataset_index.hpp"

namespace vantage {

struct ContactSheetOptions {
  int cell_px = 96;      ///< side of a cell without its caption
  int columns = 20;      ///< cells in a row
  int video = 2;         ///< 1, 2 or 4, where an object has it
  double yaw_rad = 5.2;  ///< the view nearest to this is shown
};

/// Writes a PNG: objects in the order of the index, each under its name.
/// @throws ConfigError if the name does not end in .png, InputError if a view cannot be read,
/// OutputError if the file cannot be written.
void write_contact_sheet(const DatasetIndex& index, const ContactSheetOptions& options,
                         const std::filesystem::path& path);

}  // namespace vantage
