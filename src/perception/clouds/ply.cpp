#include "vantage/perception/clouds/ply.hpp"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cstring>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

static_assert(std::endian::native == std::endian::little,
              "floats are copied as they lie in memory");

constexpr std::array<std::string_view, 3> kPosition{"x", "y", "z"};
constexpr std::array<std::string_view, 3> kNormal{"nx", "ny", "nz"};
constexpr std::array<std::string_view, 3> kColour{"red", "green", "blue"};
constexpr std::string_view kEndOfHeader = "end_header\n";

struct Property {
  std::string name;
  std::string type;
  std::size_t offset = 0;  ///< bytes from the vertex's start
};

struct Header {
  std::size_t vertices = 0;
  std::size_t stride = 0;  ///< bytes a vertex
  std::vector<Property> properties;
};

std::string header_text(std::size_t vertices, bool normals, bool colours) {
  std::string text = "ply\nformat binary_little_endian 1.0\n";
  text += fmt::format("element vertex {}\n", vertices);
  for (const auto name : kPosition) text += fmt::format("property float {}\n", name);
  if (normals) {
    for (const auto name : kNormal) text += fmt::format("property float {}\n", name);
  }
  if (colours) {
    for (const auto name : kColour) text += fmt::format("property uchar {}\n", name);
  }
  return text.append(kEndOfHeader);
}

void append_vector(std::string& bytes, const Eigen::Vector3f& v) {
  bytes.append(reinterpret_cast<const char*>(v.data()), 3 * sizeof(float));
}

[[noreturn]] void malformed(const std::filesystem::path& path, const std::string& why) {
  throw InputError(fmt::format("{}: not a usable PLY file: {}", path.string(), why));
}

std::size_t size_of_type(const std::filesystem::path& path, std::string_view type) {
  if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
  if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
  if (type == "int" || type == "uint" || type == "int32" || type == "uint32") return 4;
  if (type == "float" || type == "float32") return 4;
  if (type == "double" || type == "float64") return 8;
  malformed(path, fmt::format("property type '{}' is not supported", type));
}

std::size_t parse_count(const std::filesystem::path& path, const std::string& text) {
  std::size_t count = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, count);
  if (error != std::errc{} || stopped != end) {
    malformed(path, fmt::format("vertex count '{}' is not a number", text));
  }
  return count;
}

std::vector<std::string> split_words(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

void add_property(const std::filesystem::path& path, const std::vector<std::string>& words,
                  Header& header) {
  if (words.size() != 3) malformed(path, "only scalar properties are supported");
  header.properties.push_back({words[2], words[1], header.stride});
  header.stride += size_of_type(path, words[1]);
}

Header parse_header(const std::filesystem::path& path, const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  Header header;
  bool has_vertex = false;
  bool has_format = false;
  std::getline(lines, line);  // "ply", checked by the caller
  while (std::getline(lines, line)) {
    const auto words = split_words(line);
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "format") {
      if (words.size() != 3 || words[1] != "binary_little_endian") {
        malformed(path, fmt::format("'{}', expected binary_little_endian", line));
      }
      has_format = true;
    } else if (words[0] == "element") {
      if (has_vertex || words.size() != 3 || words[1] != "vertex") {
        malformed(path, fmt::format("'{}', expected the one element vertex", line));
      }
      header.vertices = parse_count(path, words[2]);
      has_vertex = true;
    } else if (words[0] == "property" && has_vertex) {
      add_property(path, words, header);
    } else {
      malformed(path, fmt::format("unexpected header line '{}'", line));
    }
  }
  if (!has_format || !has_vertex) malformed(path, "format or element vertex is missing");
  return header;
}

using Offsets = std::array<std::size_t, 3>;

/// Where three properties lie in a vertex; none if the first is absent.
std::optional<Offsets> find_properties(const std::filesystem::path& path, const Header& header,
                                       const std::array<std::string_view, 3>& names,
                                       std::string_view type, std::string_view type_alias) {
  Offsets offsets{};
  std::array<int, 3> found{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (const Property& property : header.properties) {
      if (property.name != names[i]) continue;
      if (property.type != type && property.type != type_alias) {
        malformed(path,
                  fmt::format("property '{}' is {}, expected {}", names[i], property.type, type));
      }
      offsets[i] = property.offset;
      ++found[i];
    }
  }
  if (found == std::array{0, 0, 0}) return std::nullopt;
  if (found != std::array{1, 1, 1}) {
    malformed(path, fmt::format("needs each of {}, {}, {} once", names[0], names[1], names[2]));
  }
  return offsets;
}

Eigen::Vector3f vector_at(const char* vertex, const Offsets& offsets) {
  Eigen::Vector3f v;
  for (std::size_t i = 0; i < 3; ++i) {
    std::memcpy(v.data() + i, vertex + offsets[i], sizeof(float));
  }
  return v;
}

Rgb colour_at(const char* vertex, const Offsets& offsets) {
  Rgb colour{};
  for (std::size_t i = 0; i < 3; ++i) colour[i] = static_cast<std::uint8_t>(vertex[offsets[i]]);
  return colour;
}

}  // namespace

void write_ply(const std::filesystem::path& path, const PointCloud& cloud,
               const std::vector<Rgb>& rgb) {
  expects(rgb.empty() || rgb.size() == cloud.size(), "a colour for each point, or none");
  const bool colours = !rgb.empty();
  std::string bytes = header_text(cloud.size(), cloud.has_normals(), colours);
  bytes.reserve(bytes.size() + cloud.size() * (6 * sizeof(float) + 3));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    append_vector(bytes, cloud.points[i]);
    if (cloud.has_normals()) append_vector(bytes, cloud.normals[i]);
    if (colours) bytes.append(reinterpret_cast<const char*>(rgb[i].data()), rgb[i].size());
  }
  write_file(path, bytes);
}

ColouredCloud read_ply(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  if (!bytes.starts_with("ply\n")) malformed(path, "does not begin with 'ply'");
  const std::size_t end = bytes.find("\n" + std::string(kEndOfHeader));
  if (end == std::string::npos) malformed(path, "header has no end_header");
  const Header header = parse_header(path, bytes.substr(0, end));
  const auto position = find_properties(path, header, kPosition, "float", "float32");
  const auto normal = find_properties(path, header, kNormal, "float", "float32");
  const auto colour = find_properties(path, header, kColour, "uchar", "uint8");
  if (!position) malformed(path, "needs properties x, y, z");
  const std::size_t body = end + 1 + kEndOfHeader.size();
  // Division, not multiplication: a made-up count must not overflow its way past the check.
  const std::size_t available = bytes.size() - body;
  if (available % header.stride != 0 || available / header.stride != header.vertices) {
    malformed(path, fmt::format("header promises {} vertices of {} bytes, but {} bytes follow",
                                header.vertices, header.stride, available));
  }
  ColouredCloud read;
  read.cloud.points.reserve(header.vertices);
  for (std::size_t i = 0; i < header.vertices; ++i) {
    const char* vertex = bytes.data() + body + i * header.stride;
    read.cloud.points.push_back(vector_at(vertex, *position));
    if (normal) read.cloud.normals.push_back(vector_at(vertex, *normal));
    if (colour) read.rgb.push_back(colour_at(vertex, *colour));
  }
  return read;
}

}  // namespace vantage
