#include "vantage/cli/hints/suggestion.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "vantage/core/names.hpp"

namespace vantage {
namespace {

std::vector<std::string> subcommands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands({})) names.push_back(sub->get_name());
  return names;
}

/// key=value, the key dotted.
bool is_assignment(std::string_view word) {
  const auto equals = word.find('=');
  return equals != word.npos && equals > 0 &&
         std::ranges::all_of(word.substr(0, equals), [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '_' || c == '.';
         });
}

}  // namespace

std::vector<std::string> with_every_set(const std::vector<std::string>& words) {
  std::vector<std::string> all;
  bool ours = true;
  for (const std::string& word : words) {
    ours = ours && word != "--";
    const bool follows = ours && all.size() > 1 && all[all.size() - 2] == "--set";
    if (follows && is_assignment(word)) all.emplace_back("--set");
    all.push_back(word);
  }
  return all;
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
    const std::string_view nearest = nearest_word(word, {known.begin(), known.end()});
    return fmt::format("unknown command '{}'; {}", word,
                       nearest.empty() ? fmt::format("known: {}", fmt::join(known, ", "))
                                       : fmt::format("did you mean {}?", nearest));
  }
  return std::nullopt;
}

}  // namespace vantage
