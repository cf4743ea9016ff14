/// A configuration as a tree that remembers where each part came from, so that an error can name
/// file, line and key.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vantage {

struct ConfigNode {
  enum class Kind { null, scalar, list, map };

  Kind kind = Kind::null;
  std::string origin;  ///< "file.yaml:12", or "--set"
  std::string key;     ///< dotted path from the root, "map.cells"
  std::string scalar;
  bool quoted = false;  ///< a quoted scalar is text, never a number
  std::vector<ConfigNode> items;
  std::vector<std::pair<std::string, ConfigNode>> entries;

  ConfigNode();
  ~ConfigNode();
  ConfigNode(const ConfigNode&);
  ConfigNode(ConfigNode&&) noexcept;
  ConfigNode& operator=(const ConfigNode&);
  ConfigNode& operator=(ConfigNode&&) noexcept;

  static ConfigNode make_scalar(std::string text, bool quoted = false);
  static ConfigNode make_list();
  static ConfigNode make_map();

  [[nodiscard]] const ConfigNode* find(std::string_view name) const;
  void set(std::string name, ConfigNode child);  ///< replaces or appends; kind becomes map

  /// "file.yaml:12: map.cells" for the front of an error message.
  [[nodiscard]] std::string where() const;
};

/// The origin of what the command line set.
inline constexpr std::string_view kOverrideOrigin = "--set";

std::string_view kind_name(ConfigNode::Kind kind);

}  // namespace vantage
