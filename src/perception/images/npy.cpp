#include "vantage/perception/images/npy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <string>
#include <string_view>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::int64_t kMaxSide = 20000;

[[noreturn]] void wrong_file(const std::filesystem::path& file, const std::string& why) {
  throw InputError(fmt::format("{}: {}", file.string(), why));
}

struct Header {
  std::string text;
  std::size_t end = 0;  ///< where the numbers begin
};

Header header_of(const std::string& bytes, const std::filesystem::path& file) {
  if (bytes.size() < 12 || !bytes.starts_with(kMagic)) wrong_file(file, "is no NPY file");
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const bool small = byte(6) == 1;
  const std::size_t start = small ? 10 : 12;
  std::size_t length = byte(8) + 256UL * byte(9);
  if (!small) length += 65536UL * byte(10) + 16777216UL * byte(11);
  if (bytes.size() < start + length) wrong_file(file, "is cut short");
  return {bytes.substr(start, length), start + length};
}

/// What follows the key, blanks left out. No regular expressions: those of the standard library go
/// down a level for each character.
std::string_view after_key(std::string_view header, std::string_view key,
                           const std::filesystem::path& file) {
  const std::size_t at = header.find(key);
  if (at == std::string_view::npos) wrong_file(file, "its header is not that of an array");
  const std::size_t value = header.find_first_not_of(" \t\n", at + key.size());
  return value == std::string_view::npos ? std::string_view() : header.substr(value);
}

/// Between the character that the entry begins with and the one that it ends with.
std::string_view entry(std::string_view header, std::string_view key, char open, char close,
                       const std::filesystem::path& file) {
  const std::string_view value = after_key(header, key, file);
  const std::size_t end = value.find(close, 1);
  if (!value.starts_with(open) || end == std::string_view::npos) {
    wrong_file(file, "its header is not that of an array");
  }
  return value.substr(1, end - 1);
}

bool is_by_columns(std::string_view header, const std::filesystem::path& file) {
  const std::string_view value = after_key(header, "'fortran_order':", file);
  if (!value.starts_with("True") && !value.starts_with("False")) {
    wrong_file(file, "its header is not that of an array");
  }
  return value.starts_with("True");
}

std::vector<std::int64_t> shape_of(std::string_view header, const std::filesystem::path& file) {
  const std::string_view text = entry(header, "'shape':", '(', ')', file);
  std::vector<std::int64_t> shape;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    std::string_view side_text = rest.substr(0, comma);
    rest.remove_prefix(std::min(comma + 1, rest.size()));
    side_text.remove_prefix(std::min(side_text.find_first_not_of(" \t\n"), side_text.size()));
    if (side_text.empty()) continue;
    std::int64_t side = 0;
    const auto [end, error] = std::from_chars(side_text.begin(), side_text.end(), side);
    if (error != std::errc{}) wrong_file(file, "its header is not that of an array");
    shape.push_back(side);
  }
  while (shape.size() > 2) {  // channels of one
    const auto one = std::ranges::find(shape.rbegin(), shape.rend(), 1);
    if (one == shape.rend()) break;
    shape.erase(std::next(one).base());
  }
  while (shape.size() < 2) shape.push_back(1);
  const bool sane = shape.size() == 2 && shape[0] > 0 && shape[1] > 0 && shape[0] <= kMaxSide &&
                    shape[1] <= kMaxSide;
  if (!sane)
    wrong_file(file, fmt::format("has shape ({}), expected (rows, columns)", text.substr(0, 100)));
  return shape;
}

template <class T>
double value_at(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

/// IEEE 754 binary16.
double half_at(const char* bytes) {
  std::uint16_t bits = 0;
  std::memcpy(&bits, bytes, sizeof(bits));
  const int exponent = bits >> 10 & 31;
  const int fraction = bits & 1023;
  double value =
      exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
  if (exponent == 31) value = fraction == 0 ? INFINITY : NAN;
  return (bits & 0x8000) != 0 ? -value : value;
}

using Reader = double (*)(const char*);

Reader reader_of(std::string_view type) {
  const std::string_view kind = type.substr(std::min<std::size_t>(1, type.size()));
  if (kind == "u1" || kind == "b1") return value_at<std::uint8_t>;
  if (kind == "i1") return value_at<std::int8_t>;
  if (type.starts_with('>')) return nullptr;
  if (kind == "u2") return value_at<std::uint16_t>;
  if (kind == "i2") return value_at<std::int16_t>;
  if (kind == "u4") return value_at<std::uint32_t>;
  if (kind == "i4") return value_at<std::int32_t>;
  if (kind == "u8") return value_at<std::uint64_t>;
  if (kind == "i8") return value_at<std::int64_t>;
  if (kind == "f2") return half_at;
  if (kind == "f4") return value_at<float>;
  if (kind == "f8") return value_at<double>;
  return nullptr;
}

}  // namespace

NpyMatrix read_npy(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  const Header header = header_of(bytes, file);
  const std::string type(entry(header.text, "'descr':", '\'', '\'', file));
  const bool by_columns = is_by_columns(header.text, file);
  const std::vector<std::int64_t> shape = shape_of(header.text, file);
  const Reader read = reader_of(type);
  if (read == nullptr)
    wrong_file(file, fmt::format("holds numbers of type '{}', expected <u2 or <f4", type));
  const auto size = static_cast<std::size_t>(type.back() - '0');
  const auto count = static_cast<std::size_t>(shape[0] * shape[1]);
  if (bytes.size() - header.end < count * size) wrong_file(file, "is cut short");
  NpyMatrix matrix{.rows = static_cast<int>(shape[0]),
                   .columns = static_cast<int>(shape[1]),
                   .integers = type.find('f') == std::string::npos,
                   .values = std::vector<double>(count)};
  const auto rows = static_cast<std::size_t>(matrix.rows);
  const auto columns = static_cast<std::size_t>(matrix.columns);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t place = by_columns ? i % rows * columns + i / rows : i;
    matrix.values[place] = read(bytes.data() + header.end + i * size);
  }
  return matrix;
}

}  // namespace vantage
