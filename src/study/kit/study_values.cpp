#include "vantage/study/kit/study_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>

#include "vantage/core/data_root.hpp"
#include "vantage/core/error.hpp"
#include "vantage/runtime/process/command_files.hpp"

namespace vantage {
namespace {

constexpr std::uint64_t kMaxSeeds = 100'000;

/// Keys of an episode that name a file or a folder.
struct FileKey {
  std::string_view key;
  bool made_later;  ///< by another command; it may be missing
};
constexpr auto kFileKeys = std::to_array<FileKey>(
    {{"scene", false}, {"robot.model", false}, {"model", true}, {"database.models", true}});

/// A program of the user's, of whose arguments some name files.
constexpr std::string_view kCommandKey = "choice.command";

void settle_command(ConfigNode& list, const std::filesystem::path& base) {
  std::vector<std::string> command;
  for (const ConfigNode& item : list.items) command.push_back(item.scalar);
  command = settled_command(std::move(command), base);
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    if (list.items[i].scalar == command[i]) continue;
    list.items[i].scalar = command[i];
    list.items[i].quoted = true;
  }
}

[[noreturn]] void wrong_seeds(const ConfigNode& node, std::string_view given) {
  throw ConfigError(fmt::format("{}: '{}' are no seeds; write 1..20, or a list as [1, 2, 5] or [7]",
                                node.where(), given));
}

std::optional<std::uint64_t> whole_number(std::string_view text) {
  std::uint64_t value = 0;
  const auto* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stopped != end) return std::nullopt;
  return value;
}

std::vector<std::uint64_t> seeds_between(const ConfigNode& node) {
  const std::string_view text = node.scalar;
  const auto dots = text.find("..");
  const auto first = whole_number(text.substr(0, dots));
  // A single number is as likely meant as how many there are.
  const auto last = dots == text.npos ? std::nullopt : whole_number(text.substr(dots + 2));
  if (!first || !last || *last < *first || *last - *first >= kMaxSeeds) wrong_seeds(node, text);
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t n = 0; n <= *last - *first; ++n) seeds.push_back(*first + n);
  return seeds;
}

void settle(ConfigNode& node, const std::string& key, const std::filesystem::path& base) {
  for (auto& [name, child] : node.entries) {
    settle(child, fmt::format("{}{}{}", key, key.empty() ? "" : ".", name), base);
  }
  if (key == kCommandKey && node.kind == ConfigNode::Kind::list) settle_command(node, base);
  const auto found = std::ranges::find(kFileKeys, key, &FileKey::key);
  if (found == kFileKeys.end() || node.kind != ConfigNode::Kind::scalar || node.scalar.empty()) {
    return;
  }
  try {
    node.scalar = lasting_name(find_input(node.scalar, base, node.where()));
    node.quoted = true;
  } catch (const InputError&) {
    if (!found->made_later) throw;
  }
}

}  // namespace

std::vector<std::uint64_t> read_seeds(const ConfigNode& node) {
  if (node.kind == ConfigNode::Kind::scalar) return seeds_between(node);
  if (node.kind != ConfigNode::Kind::list || node.items.empty()) {
    wrong_seeds(node, kind_name(node.kind));
  }
  std::vector<std::uint64_t> seeds;
  for (const ConfigNode& item : node.items) {
    const auto seed =
        item.kind == ConfigNode::Kind::scalar ? whole_number(item.scalar) : std::nullopt;
    if (!seed) wrong_seeds(item, item.scalar);
    if (std::ranges::find(seeds, *seed) != seeds.end()) {
      throw ConfigError(fmt::format("{}: seed {} is there twice", item.where(), *seed));
    }
    seeds.push_back(*seed);
  }
  return seeds;
}

void settle_files(ConfigNode& overrides, const std::filesystem::path& base) {
  settle(overrides, "", base);
}

}  // namespace vantage
