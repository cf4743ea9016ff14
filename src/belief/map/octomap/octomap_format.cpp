#include "vantage/belief/map/octomap/octomap_format.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstring>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr std::string_view kBinaryMagic = "# Octomap OcTree binary file";
constexpr std::string_view kFullMagic = "# Octomap OcTree file";
// Coordinates up to 32768 cells of the coarsest still have the precision of a single float.
constexpr double kMinResolution_m = 1e-6;
constexpr double kMaxResolution_m = 1e6;

template <class Number>
Number parse_number(std::string_view key, std::string_view text, const std::string& name) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) {
    throw InputError(fmt::format("{}: header key '{}' has value '{}'", name, key, text));
  }
  return number;
}

std::string_view strip(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

void read_header_line(std::string_view key, std::string_view value, const std::string& name,
                      OctomapHeader& header) {
  if (key == "id" && value != "OcTree") {
    throw InputError(fmt::format("{}: holds a tree of type '{}', expected OcTree", name, value));
  }
  if (key == "size") header.nodes = parse_number<std::size_t>(key, value, name);
  if (key == "res") header.resolution_m = parse_number<double>(key, value, name);
}

OctomapHeader parse_header(std::string_view bytes, const std::string& name) {
  if (bytes.empty()) throw InputError(name + ": is empty, expected an OctoMap file");
  OctomapHeader header{.binary = bytes.starts_with(kBinaryMagic)};
  if (!header.binary && !bytes.starts_with(kFullMagic)) {
    throw InputError(fmt::format("{}: not an OctoMap file: does not begin with '{}' or '{}'", name,
                                 kBinaryMagic, kFullMagic));
  }
  bool names_its_tree = false;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t end = bytes.find('\n', at);
    if (end == std::string_view::npos) break;
    const std::string_view line = strip(bytes.substr(at, end - at));
    at = end + 1;
    if (line == "data") {
      header.data_offset = at;
      break;
    }
    if (line.empty() || line.front() == '#') continue;
    const std::string_view key = line.substr(0, line.find_first_of(" \t"));
    read_header_line(key, strip(line.substr(key.size())), name, header);
    names_its_tree = names_its_tree || key == "id";
  }
  if (header.data_offset == 0) throw InputError(name + ": cut short within the OctoMap header");
  if (!names_its_tree) throw InputError(name + ": header key 'id' is missing, expected OcTree");
  if (!(header.resolution_m >= kMinResolution_m && header.resolution_m <= kMaxResolution_m)) {
    throw InputError(fmt::format("{}: header key 'res' is {}, must be in [{}, {}] m", name,
                                 header.resolution_m, kMinResolution_m, kMaxResolution_m));
  }
  return header;
}

/// Walks the records of a tree, from the root down.
class RecordWalk {
 public:
  RecordWalk(std::string_view data, const std::string& name, const OctomapLeafVisitor& visit)
      : data_(data), name_(name), visit_(visit) {}

  /// @return nodes of the tree, its root included
  std::size_t run(bool binary) {
    const OctomapLeaf root{.first = Eigen::Array3i::Constant(-kOctomapHalfWidth),
                           .edge_cells = 2 * kOctomapHalfWidth};
    binary ? walk_binary(root) : walk_full(root);
    return nodes_;
  }
  /// OctoMap writes nothing behind the tree.
  void require_end() const {
    if (at_ < data_.size()) damaged("the data go on behind the tree");
  }

 private:
  /// Two bits a child: 00 none, 01 free, 10 occupied, 11 an inner node with a record of its own.
  void walk_binary(const OctomapLeaf& node) {
    // What OctoMap makes of free and occupied: its default clamping thresholds.
    constexpr float kFree = -2.0F;
    constexpr float kOccupied = 3.5F;
    const std::string_view record = take(2);
    const int kinds = static_cast<unsigned char>(record[0]) | static_cast<unsigned char>(record[1])
                                                                  << 8;
    if (kinds == 0) damaged("an inner node without children");
    ++nodes_;
    for (int i = 0; i < 8; ++i) {
      const int kind = kinds >> (2 * i) & 3;
      if (kind == 0) continue;
      OctomapLeaf child = child_of(node, i);
      if (kind == 3) {
        walk_binary(child);
        continue;
      }
      child.log_odds = kind == 1 ? kFree : kOccupied;
      take_leaf(child);
    }
  }

  /// Log odds as a float, then one bit a child; every child has a record.
  void walk_full(OctomapLeaf node) {
    const std::string_view record = take(sizeof(float) + 1);
    std::memcpy(&node.log_odds, record.data(), sizeof(float));
    if (!std::isfinite(node.log_odds)) damaged("log odds that are not a number");
    const int children = static_cast<unsigned char>(record.back());
    if (children == 0) return take_leaf(node);
    ++nodes_;
    for (int i = 0; i < 8; ++i) {
      if ((children >> i & 1) != 0) walk_full(child_of(node, i));
    }
  }

  void take_leaf(const OctomapLeaf& leaf) {
    ++nodes_;
    visit_(leaf);
  }

  [[nodiscard]] OctomapLeaf child_of(const OctomapLeaf& node, int i) const {
    const int edge = node.edge_cells / 2;
    if (edge == 0) damaged("more than 16 levels");
    return {.first = node.first + edge * Eigen::Array3i(i & 1, i >> 1 & 1, i >> 2 & 1),
            .edge_cells = edge};
  }

  std::string_view take(std::size_t size) {
    if (data_.size() - at_ < size) {
      throw InputError(fmt::format("{}: cut short: the tree goes on after {} bytes of data", name_,
                                   data_.size()));
    }
    at_ += size;
    return data_.substr(at_ - size, size);
  }

  [[noreturn]] void damaged(std::string_view what) const {
    throw InputError(fmt::format("{}: damaged: {} at data byte {}", name_, what, at_));
  }

  std::string_view data_;
  const std::string& name_;
  const OctomapLeafVisitor& visit_;
  std::size_t at_ = 0;
  std::size_t nodes_ = 0;
};

}  // namespace

std::string octomap_header(const OctomapHeader& header) {
  return fmt::format("{}\n#\nid OcTree\nsize {}\nres {:.12g}\ndata\n",
                     header.binary ? kBinaryMagic : kFullMagic, header.nodes, header.resolution_m);
}

OctomapHeader parse_octomap(std::string_view bytes, const std::string& name,
                            const OctomapLeafVisitor& visit) {
  const OctomapHeader header = parse_header(bytes, name);
  RecordWalk walk(bytes.substr(header.data_offset), name, visit);
  const std::size_t found = header.nodes == 0 ? 0 : walk.run(header.binary);
  if (found != header.nodes) {
    throw InputError(fmt::format("{}: damaged: header key 'size' is {}, the data hold {} nodes",
                                 name, header.nodes, found));
  }
  walk.require_end();
  return header;
}

}  // namespace vantage
