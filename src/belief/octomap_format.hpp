/// OctoMap's two file formats: headers, and a check of every byte before OctoMap itself sees them,
/// whose reader recurses without bound on damaged data and prints to stderr.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vantage {

/// Levels below the root.
inline constexpr int kOctomapDepth = 16;

struct OctomapHeader {
  bool binary = false;  ///< .bt: two bits a child; else .ot: log odds
  double resolution_m = 0.0;
  std::size_t nodes = 0;        ///< inner ones included
  std::size_t data_offset = 0;  ///< of the root's record
};

/// The text in front of the data, up to and including the line "data".
std::string octomap_header(const OctomapHeader& header);

/// The header of a whole, well-formed OcTree file. `name` stands for the file in messages.
/// @throws InputError if `bytes` are empty, no OctoMap file, another kind of tree, cut short, or
/// hold a number of nodes other than the header says.
OctomapHeader check_octomap(std::string_view bytes, const std::string& name);

}  // namespace vantage
