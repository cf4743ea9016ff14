/// Arrays as NumPy writes them:
/// https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
#pragma once

#include <filesystem>
#include <vector>

namespace vantage {

/// A matrix of numbers.
struct NpyMatrix {
  int rows = 0;
  int columns = 0;
  bool integers = false;       ///< of the file's type
  std::vector<double> values;  ///< row by row
};

/// A file of version 1 to 3 that holds one matrix, or one with an axis of length 1 beside, of
/// little-endian integers or floats of 1 to 8 bytes.
/// @throws InputError naming the file and what is wrong with it.
NpyMatrix read_npy(const std::filesystem::path& file);

}  // namespace vantage
