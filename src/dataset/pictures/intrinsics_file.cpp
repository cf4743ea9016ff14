#include "vantage/dataset/pictures/intrinsics_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr auto kNumber = R"(([-+]?[0-9]*\.?[0-9]+(?:[eE][-+]?[0-9]+)?))";

std::optional<double> value_of(const std::string& text, const std::string& key) {
  std::smatch match;
  const std::regex form("\\b" + key + R"(\b["']?\s*[:=]\s*)" + kNumber);
  if (!std::regex_search(text, match, form)) return std::nullopt;
  return std::stod(match[1]);
}

std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  const std::regex number(kNumber);
  for (std::sregex_iterator it(text.begin(), text.end(), number), end; it != end; ++it) {
    numbers.push_back(std::stod(it->str()));
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
