#include "vantage/core/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "vantage/core/schema.hpp"

namespace vantage {
namespace {

bool holds_numbers(const ConfigNode& node) {
  return !node.items.empty() && std::ranges::all_of(node.items, [](const ConfigNode& item) {
    double number = 0.0;
    const char* end = item.scalar.data() + item.scalar.size();
    return std::from_chars(item.scalar.data(), end, number).ptr == end;
  });
}

void add_differences(const std::string& prefix, const ConfigNode& given, const ConfigNode& defaults,
                     std::string& label) {
  for (std::size_t i = 0; i < given.entries.size(); ++i) {
    const auto& [key, value] = given.entries[i];
    const ConfigNode& usual = defaults.entries[i].second;
    add_differences(prefix + key + ".", value, usual, label);
    if (holds_numbers(value) && detail::value_text(value) != detail::value_text(usual)) {
      label += fmt::format(" {}{}={}", prefix, key, detail::value_text(value));
    }
    if (value.scalar != usual.scalar) label += fmt::format(" {}{}={}", prefix, key, value.scalar);
  }
}

}  // namespace

std::string label_of(std::string_view name, const ConfigNode& given, const ConfigNode& defaults) {
  std::string label(name);
  add_differences("", given, defaults, label);
  return label;
}

std::size_t letters_off(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      const std::size_t changed = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, changed});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

std::string_view nearest_word(std::string_view word, const std::vector<std::string_view>& known) {
  constexpr std::size_t kNear = 2;
  std::string_view nearest;
  std::size_t least = std::min(kNear + 1, word.size());
  for (const std::string_view candidate : known) {
    const std::size_t off = letters_off(word, candidate);
    if (off >= least) continue;
    least = off;
    nearest = candidate;
  }
  return nearest;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& known) {
  const std::string_view nearest = nearest_word(word, known);
  return nearest.empty() ? std::string() : "did you mean " + std::string(nearest) + "? ";
}

}  // namespace vantage
