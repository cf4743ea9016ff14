/// The reference: everything that a user meets by name, from the code that reads and writes it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>
#include <vector>

#include "vantage/core/schema.hpp"

namespace vantage {

struct ReferenceEntry {
  std::string name = {};   ///< "gain.a", "beer_lambert", "time_s"
  std::string place = {};  ///< where it stands: "episode", "gain", "steps.csv"
  std::string type = {};
  std::string unit = {};
  std::string default_value = {};
  std::string range = {};
  std::string text = {};
  std::string formula = {};
  std::string source = {};
  std::vector<KeyDescription> parameters = {};  ///< of a strategy
  std::vector<std::string> applies =
      {};  ///< "task: tabletop, exploration", "gain: fsmi"; empty: always
  std::vector<std::string> keys_below = {};  ///< of a section
};

/// Keys of configuration files and of --set, each place by itself.
std::vector<ReferenceEntry> key_entries();
/// What a key may name: gains, choices, features, optimisers ...
std::vector<ReferenceEntry> strategy_entries();
/// What runs, studies and commands write: files, their columns and keys, exit codes.
std::vector<ReferenceEntry> record_entries();

/// As entries of `place`.
std::vector<ReferenceEntry> entries_of(const std::vector<KeyDescription>& keys,
                                       const std::string& place);

/// Fills in the keys below of those that are sections.
void add_keys_below(std::vector<ReferenceEntry>& all);

/// Those of that name; else those whose name ends so, as a of gain.a; else all of that place; else
/// those of the only name that begins so. Empty if there are none.
std::vector<ReferenceEntry> find_entries(const std::vector<ReferenceEntry>& all,
                                         std::string_view name);
/// The names that begin so, each once, without those in a section among them.
std::vector<std::string> names_beginning(const std::vector<ReferenceEntry>& all,
                                         std::string_view name);
/// The names that are nearest to one that there is not, at most `count`.
std::vector<std::string> nearest_names(const std::vector<ReferenceEntry>& all,
                                       std::string_view name, std::size_t count);

/// A few lines for a terminal.
std::string entry_text(const ReferenceEntry& entry);
nlohmann::ordered_json entry_json(const ReferenceEntry& entry);

}  // namespace vantage
