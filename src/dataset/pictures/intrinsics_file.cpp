#include "vantage/dataset/pictures/intrinsics_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

bool is_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// The number that `text` begins with, which is taken off it; nothing if it begins with none, or
/// with one beyond every number, which is taken off too. No regular expressions: those of the
/// standard library go down a level for each character.
std::optional<double> take_number(std::string_view& text) {
  std::string_view digits = text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(digits.begin(), digits.end(), number);
  if (error == std::errc::invalid_argument) return std::nullopt;
  text = digits.substr(static_cast<std::size_t>(end - digits.begin()));
  if (error != std::errc{} || !std::isfinite(number)) return std::nullopt;
  return number;
}

/// After the key as a whole word, maybe in quotes, and a colon or equals sign.
std::optional<double> value_of(std::string_view text, std::string_view key) {
  for (std::size_t at = text.find(key); at != std::string_view::npos; at = text.find(key, at + 1)) {
    if (at > 0 && is_of_word(text[at - 1])) continue;
    std::string_view rest = text.substr(at + key.size());
    if (rest.starts_with('"') || rest.starts_with('\'')) rest.remove_prefix(1);
    const auto skip_blanks = [&] {
      rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r\n"), rest.size()));
    };
    skip_blanks();
    if (!rest.starts_with(':') && !rest.starts_with('=')) continue;
    rest.remove_prefix(1);
    skip_blanks();
    if (const auto number = take_number(rest)) return number;
  }
  return std::nullopt;
}

std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  while (!text.empty()) {
    const std::size_t left = text.size();
    if (const auto number = take_number(text)) numbers.push_back(*number);
    if (text.size() == left) text.remove_prefix(1);
  }
  return numbers;
}

}  // namespace

Intrinsics read_intrinsics(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  std::vector<double> found;
  const auto fx = value_of(text, "fx"), fy = value_of(text, "fy");
  const auto cx = value_of(text, "cx"), cy = value_of(text, "cy");
  if (fx && cx && cy) {
    found = {*fx, fy.value_or(*fx), *cx, *cy};
  } else if (const std::vector<double> all = numbers_in(text); all.size() == 9) {
    found = {all[0], all[4], all[2], all[5]};
  } else if (all.size() == 4) {
    found = all;
  }
  const bool sane = found.size() == 4 && found[0] > 10.0 && found[1] > 10.0 &&
                    std::abs(found[0] - found[1]) < 0.05 * found[0];
  if (!sane) {
    throw InputError(fmt::format(
        "{}: expected fx, fy, cx, cy in pixels, as keys, as four numbers or as a 3 x 3 matrix, fx "
        "and fy within 5 %",
        file.string()));
  }
  return {.focal_px = 0.5 * (found[0] + found[1]), .centre_px = {found[2], found[3]}};
}

}  // namespace vantage
