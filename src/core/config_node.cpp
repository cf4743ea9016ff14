#include "vantage/core/config_node.hpp"

namespace vantage {

ConfigNode::ConfigNode() = default;
ConfigNode::~ConfigNode() = default;
ConfigNode::ConfigNode(const ConfigNode&) = default;
ConfigNode::ConfigNode(ConfigNode&&) noexcept = default;
ConfigNode& ConfigNode::operator=(const ConfigNode&) = default;
ConfigNode& ConfigNode::operator=(ConfigNode&&) noexcept = default;

ConfigNode ConfigNode::make_scalar(std::string text, bool quoted) {
  ConfigNode node;
  node.kind = Kind::scalar;
  node.scalar = std::move(text);
  node.quoted = quoted;
  return node;
}

ConfigNode ConfigNode::make_list() {
  ConfigNode node;
  node.kind = Kind::list;
  return node;
}

ConfigNode ConfigNode::make_map() {
  ConfigNode node;
  node.kind = Kind::map;
  return node;
}

const ConfigNode* ConfigNode::find(std::string_view name) const {
  for (const auto& [entry, child] : entries) {
    if (entry == name) return &child;
  }
  return nullptr;
}

void ConfigNode::set(std::string name, ConfigNode child) {
  kind = Kind::map;
  for (auto& [entry, old] : entries) {
    if (entry == name) {
      old = std::move(child);
      return;
    }
  }
  entries.emplace_back(std::move(name), std::move(child));
}

std::string ConfigNode::where() const {
  if (origin.empty()) return key;
  return key.empty() ? origin : origin + ": " + key;
}

std::string_view kind_name(ConfigNode::Kind kind) {
  switch (kind) {
    case ConfigNode::Kind::null: return "nothing";
    case ConfigNode::Kind::scalar: return "a scalar";
    case ConfigNode::Kind::list: return "a list";
    case ConfigNode::Kind::map: return "a map";
  }
  return "?";
}

}  // namespace vantage
