#include "src/belief/octomap_format.hpp"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "src/core/error.hpp"

namespace vantage {
namespace {

constexpr std::string_view kBinaryMagic = "# Octomap OcTree binary file";
constexpr std::string_view kFullMagic = "# Octomap OcTree file";

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
  }
  if (header.data_offset == 0) throw InputError(name + ": cut short within the OctoMap header");
  if (!(header.resolution_m > 0.0) || !std::isfinite(header.resolution_m)) {
    throw InputError(
        fmt::format("{}: header key 'res' is {}, must be above 0", name, header.resolution_m));
  }
  return header;
}

/// Walks the records of a tree without building it.
class RecordWalk {
 public:
  RecordWalk(std::string_view data, bool binary, const std::string& name)
      : data_(data), binary_(binary), name_(name) {}

  /// @return nodes of the subtree whose record begins here, its root included
  std::size_t count(int depth) { return binary_ ? count_binary(depth) : count_full(depth); }

 private:
  /// Two bits a child: 00 none, 01 or 10 a leaf, 11 an inner node with a record of its own.
  std::size_t count_binary(int depth) {
    const std::string_view record = take(2);
    std::size_t nodes = 1;
    int inner = 0;
    for (const char byte : record) {
      for (int shift = 0; shift < 8; shift += 2) {
        const int kind = (static_cast<unsigned char>(byte) >> shift) & 3;
        if (kind == 3) ++inner;
        if (kind == 1 || kind == 2) ++nodes;
      }
    }
    if (nodes == 1 && inner == 0) damaged("an inner node without children");
    require_depth(depth, inner > 0 ? 2 : 1);
    for (; inner > 0; --inner) nodes += count(depth + 1);
    return nodes;
  }

  /// Log odds as a float, then one bit a child; every child has a record.
  std::size_t count_full(int depth) {
    const std::string_view record = take(sizeof(float) + 1);
    float log_odds = 0.0F;
    std::memcpy(&log_odds, record.data(), sizeof(float));
    if (!std::isfinite(log_odds)) damaged("log odds that are not a number");
    std::size_t nodes = 1;
    int children = std::popcount(static_cast<unsigned char>(record.back()));
    require_depth(depth, children > 0 ? 1 : 0);
    for (; children > 0; --children) nodes += count(depth + 1);
    return nodes;
  }

  void require_depth(int depth, int levels_below) const {
    if (depth + levels_below > kOctomapDepth) damaged("more than 16 levels");
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
  bool binary_;
  const std::string& name_;
  std::size_t at_ = 0;
};

}  // namespace

std::string octomap_header(const OctomapHeader& header) {
  return fmt::format("{}\n#\nid OcTree\nsize {}\nres {:.12g}\ndata\n",
                     header.binary ? kBinaryMagic : kFullMagic, header.nodes, header.resolution_m);
}

OctomapHeader check_octomap(std::string_view bytes, const std::string& name) {
  const OctomapHeader header = parse_header(bytes, name);
  if (header.nodes == 0) return header;
  const std::size_t found =
      RecordWalk(bytes.substr(header.data_offset), header.binary, name).count(0);
  if (found != header.nodes) {
    throw InputError(fmt::format("{}: damaged: header key 'size' is {}, the data hold {} nodes",
                                 name, header.nodes, found));
  }
  return header;
}

}  // namespace vantage
