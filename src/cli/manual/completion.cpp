#include "vantage/cli/manual/completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "generated/completion_file.hpp"

namespace vantage {
namespace {

constexpr std::string_view kOneOf = "one of ";

void put(std::string_view place, const std::string& text, std::string& script) {
  script.replace(script.find(place), place.size(), text);
}

std::string branch(const std::string& pattern, const std::string& words) {
  return words.empty() ? words : fmt::format("    \"{}\") echo \"{}\" ;;\n", pattern, words);
}

std::string flags_of(const CommandText& command) {
  std::vector<std::string> flags;
  for (const OptionText& option : command.options) {
    if (!option.positional) flags.insert(flags.end(), option.names.begin(), option.names.end());
  }
  return fmt::format("{}", fmt::join(flags, " "));
}

std::string last_word(const std::string& name) { return name.substr(name.rfind(' ') + 1); }

std::string names_of(const std::vector<CommandText>& commands) {
  std::vector<std::string> names;
  for (const CommandText& command : commands) names.push_back(last_word(command.name));
  return fmt::format("{}", fmt::join(names, " "));
}

void add_branches(const std::vector<CommandText>& commands, std::string& parts,
                  std::string& flags) {
  for (const CommandText& command : commands) {
    parts += branch(command.name, names_of(command.parts));
    flags += branch(command.name, flags_of(command));
    add_branches(command.parts, parts, flags);
  }
}

/// Of a key that several strategies have, the names that any of them takes.
std::map<std::string, std::set<std::string>> names_by_key(const std::vector<KeyDescription>& keys) {
  std::map<std::string, std::set<std::string>> names;
  for (const KeyDescription& key : keys) {
    if (key.type == "true or false") names[key.key] = {"false", "true"};
    if (!key.type.starts_with(kOneOf)) continue;
    std::string_view rest = std::string_view(key.type).substr(kOneOf.size());
    rest = rest.substr(0, rest.find(", or null"));
    while (!rest.empty()) {
      const auto comma = std::min(rest.find(", "), rest.size());
      names[key.key].insert(std::string(rest.substr(0, comma)));
      rest.remove_prefix(std::min(comma + 2, rest.size()));
    }
  }
  return names;
}

std::string keys_of(const std::vector<KeyDescription>& keys) {
  std::set<std::string> names;
  for (const KeyDescription& key : keys) {
    if (key.key.find('[') == std::string::npos) names.insert(key.key);
  }
  return fmt::format("{}", fmt::join(names, " "));
}

}  // namespace

std::string bash_completion(const std::vector<CommandText>& commands,
                            const std::vector<Completions>& words,
                            const std::vector<KeyDescription>& keys) {
  std::string parts = branch("", names_of(commands));
  std::string flags = branch("", "--help --version");
  add_branches(commands, parts, flags);
  std::string word_branches;
  for (const Completions& entry : words) {
    word_branches +=
        branch(entry.command + " " + entry.option, fmt::format("{}", fmt::join(entry.words, " ")));
  }
  std::string values;
  for (const auto& [key, names] : names_by_key(keys)) {
    values += branch(key, fmt::format("{}", fmt::join(names, " ")));
  }
  std::string script(embedded_asset("completion.bash"));
  put("@parts@", parts, script);
  put("@flags@", flags, script);
  put("@words@", word_branches, script);
  put("@values@", values, script);
  put("@keys@", keys_of(keys), script);
  return script;
}

}  // namespace vantage
