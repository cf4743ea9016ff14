#include "vantage/cli/hints/suggestion.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace vantage {
namespace {

constexpr std::size_t kNear = 2;

std::vector<std::string> subcommands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands({})) names.push_back(sub->get_name());
  return names;
}

}  // namespace

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

std::string nearest_word(std::string_view word, const std::vector<std::string>& known) {
  std::string nearest;
  std::size_t least = std::min(kNear + 1, word.size());
  for (const std::string& candidate : known) {
    const std::size_t off = letters_off(word, candidate);
    if (off >= least) continue;
    least = off;
    nearest = candidate;
  }
  return nearest;
}

std::optional<std::string> unknown_command(const CLI::App& app,
                                           const std::vector<std::string>& words) {
  const CLI::App* at = &app;
  for (const std::string& word : words) {
    const std::vector<std::string> known = subcommands(*at);
    if (known.empty()) return std::nullopt;
    if (word.starts_with('-')) continue;
    if (std::ranges::find(known, word) != known.end()) {
      at = at->get_subcommand(word);
      continue;
    }
    const std::string nearest = nearest_word(word, known);
    return fmt::format("unknown command '{}'; {}", word,
                       nearest.empty() ? fmt::format("known: {}", fmt::join(known, ", "))
                                       : fmt::format("did you mean {}?", nearest));
  }
  return std::nullopt;
}

}  // namespace vantage
