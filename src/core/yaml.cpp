#include "vantage/core/yaml.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <sstream>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

std::string origin_of(const std::string& name, const YAML::Mark& mark) {
  return mark.is_null() ? name : fmt::format("{}:{}", name, mark.line + 1);
}

/// Refuses, before anything is built, the parts of YAML that this project does without. An alias
/// may refer to a node that holds it, which no tree can.
class PlainYamlOnly : public YAML::EventHandler {
 public:
  explicit PlainYamlOnly(const std::string& name) : name_(name) {}
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { inspect(mark, "", anchor); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { refuse(mark, "an alias (*)"); }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string&) override {
    inspect(mark, tag, anchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    inspect(mark, tag, anchor);
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    inspect(mark, tag, anchor);
  }
  void OnMapEnd() override {}

 private:
  void inspect(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) const {
    if (anchor != YAML::NullAnchor) refuse(mark, "an anchor (&)");
    if (!tag.empty() && tag != "?" && tag != "!") refuse(mark, fmt::format("the tag '{}'", tag));
  }
  [[noreturn]] void refuse(const YAML::Mark& mark, std::string_view what) const {
    throw ConfigError(fmt::format("{}: {} is not accepted here", origin_of(name_, mark), what));
  }
  const std::string& name_;
};

/// yaml-cpp closes an open quote at the end of a file itself, unless the file ends without a
/// newline: a forgotten quote would swallow the keys behind it unseen.
/// A second document is an error, and the last that is looked for: of what begins none, as a comma,
/// yaml-cpp makes empty ones without end.
void inspect(std::string_view text, const std::string& name) {
  const auto last = text.find_last_not_of(" \t\r\n");
  std::istringstream stream{std::string(text.substr(0, last == text.npos ? 0 : last + 1))};
  YAML::Parser parser(stream);
  PlainYamlOnly inspector(name);
  if (parser.HandleNextDocument(inspector) && parser.HandleNextDocument(inspector)) {
    throw ConfigError(name + ": more than one YAML document");
  }
}

std::string join_key(const std::string& parent, const std::string& child) {
  return parent.empty() ? child : parent + "." + child;
}

ConfigNode convert(const YAML::Node& yaml, const std::string& name, const std::string& key);

void convert_map(const YAML::Node& yaml, const std::string& name, ConfigNode& node) {
  node.kind = ConfigNode::Kind::map;
  for (const auto& entry : yaml) {
    const std::string origin = origin_of(name, entry.first.Mark());
    if (!entry.first.IsScalar()) {
      throw ConfigError(fmt::format("{}: a key under '{}' is not plain text", origin, node.key));
    }
    const auto child = entry.first.Scalar();
    if (node.find(child) != nullptr) {
      throw ConfigError(fmt::format("{}: {}: duplicate key", origin, join_key(node.key, child)));
    }
    node.entries.emplace_back(child, convert(entry.second, name, join_key(node.key, child)));
    node.entries.back().second.origin = origin;
  }
}

ConfigNode convert(const YAML::Node& yaml, const std::string& name, const std::string& key) {
  ConfigNode node;
  node.origin = origin_of(name, yaml.Mark());
  node.key = key;
  switch (yaml.Type()) {
    case YAML::NodeType::Undefined:
    case YAML::NodeType::Null: break;
    case YAML::NodeType::Scalar:
      node.kind = ConfigNode::Kind::scalar;
      node.scalar = yaml.Scalar();
      node.quoted = yaml.Tag() == "!";
      break;
    case YAML::NodeType::Sequence:
      node.kind = ConfigNode::Kind::list;
      for (std::size_t i = 0; i < yaml.size(); ++i) {
        node.items.push_back(convert(yaml[i], name, fmt::format("{}[{}]", key, i)));
      }
      break;
    case YAML::NodeType::Map: convert_map(yaml, name, node); break;
  }
  return node;
}

/// Without an origin, the nodes keep theirs.
void relabel(ConfigNode& node, const std::string& origin, const std::string& key) {
  if (!origin.empty()) node.origin = origin;
  node.key = key;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    relabel(node.items[i], origin, fmt::format("{}[{}]", key, i));
  }
  for (auto& [name, child] : node.entries) relabel(child, origin, join_key(key, name));
}

void emit(YAML::Emitter& out, const ConfigNode& node) {
  switch (node.kind) {
    case ConfigNode::Kind::null: out << YAML::Null; break;
    case ConfigNode::Kind::scalar:
      if (node.quoted) out << YAML::DoubleQuoted;
      out << node.scalar;
      break;
    case ConfigNode::Kind::list:
      if (std::ranges::all_of(node.items, [](const ConfigNode& item) {
            return item.kind == ConfigNode::Kind::scalar;
          })) {
        out << YAML::Flow;
      }
      out << YAML::BeginSeq;
      for (const auto& item : node.items) emit(out, item);
      out << YAML::EndSeq;
      break;
    case ConfigNode::Kind::map:
      out << YAML::BeginMap;
      for (const auto& [name, child] : node.entries) {
        out << YAML::Key << name << YAML::Value;
        emit(out, child);
      }
      out << YAML::EndMap;
      break;
  }
}

void set_value(ConfigNode& root, const std::string& key, ConfigNode value) {
  if (root.kind == ConfigNode::Kind::scalar || root.kind == ConfigNode::Kind::list) {
    throw ConfigError(
        fmt::format("{}: expected a map, got {}", root.where(), kind_name(root.kind)));
  }
  relabel(value, {}, key);
  ConfigNode* node = &root;
  std::size_t begin = 0;
  for (auto dot = key.find('.'); dot != std::string::npos; dot = key.find('.', begin)) {
    const std::string name = key.substr(begin, dot - begin);
    const ConfigNode* child = node->find(name);
    if (child == nullptr || child->kind != ConfigNode::Kind::map) {
      ConfigNode made = ConfigNode::make_map();
      // `gain: adaptive` is short for `gain: {name: adaptive}`; --set gain.x=1 refines it.
      if (child != nullptr && child->kind == ConfigNode::Kind::scalar) made.set("name", *child);
      made.origin = value.origin;
      made.key = key.substr(0, dot);
      node->set(name, std::move(made));
    }
    node = const_cast<ConfigNode*>(node->find(name));
    begin = dot + 1;
  }
  const std::string last = key.substr(begin);
  // Another strategy has other options: those of the one before go with it.
  const ConfigNode* name = begin > 0 && last == "name" ? node->find("name") : nullptr;
  if (name != nullptr && to_yaml(*name) != to_yaml(value)) node->entries.clear();
  node->set(last, std::move(value));
}

/// What an assignment says of `key`: its own value, a part of it, or the name that it stands for.
const ConfigNode* said_of(const KeyValue& assignment, std::string_view key) {
  const auto& [known, value] = assignment;
  if (key == known) return &value;
  if (!key.starts_with(known + ".")) return nullptr;
  const std::string_view rest = key.substr(known.size() + 1);
  if (value.kind == ConfigNode::Kind::scalar) return rest == "name" ? &value : nullptr;
  return find_value(value, rest);
}

}  // namespace

ConfigNode read_yaml(const std::filesystem::path& path) {
  return parse_yaml(read_file(path), path.string());
}

ConfigNode parse_yaml(std::string_view text, const std::string& name) {
  try {
    inspect(text, name);
    const YAML::Node root = YAML::Load(std::string(text));
    if (!root.IsNull()) return convert(root, name, "");
  } catch (const YAML::Exception& error) {
    throw ConfigError(
        fmt::format("{}: not valid YAML: {}", origin_of(name, error.mark), error.msg));
  }
  ConfigNode empty;
  empty.origin = name;
  return empty;
}

const ConfigNode* find_value(const ConfigNode& root, std::string_view key) {
  const ConfigNode* node = &root;
  while (node != nullptr && !key.empty()) {
    const auto dot = key.find('.');
    node = node->find(key.substr(0, dot));
    key.remove_prefix(dot == key.npos ? key.size() : dot + 1);
  }
  return node;
}

KeyValue parse_override(const std::string& assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw ConfigError(fmt::format("--set {}: expected key=value", assignment));
  }
  const std::string key = assignment.substr(0, equals);
  ConfigNode value = parse_yaml(assignment.substr(equals + 1), "--set " + key);
  relabel(value, std::string(kOverrideOrigin), key);
  return {key, std::move(value)};
}

void set_values(ConfigNode& root, std::vector<KeyValue> values) {
  std::ranges::stable_sort(values, {}, [](const KeyValue& value) {
    const bool name = value.first.ends_with(".name");  // comes before the options of its strategy
    return std::pair(std::ranges::count(value.first, '.'), name ? 0 : 1);
  });
  for (auto value = values.begin(); value != values.end(); ++value) {
    for (auto before = values.begin(); before != value; ++before) {
      const ConfigNode* said = said_of(*before, value->first);
      if (said == nullptr || to_yaml(*said) == to_yaml(value->second)) continue;
      throw ConfigError(fmt::format("{}: set twice, to different values{}", value->second.where(),
                                    before->second.origin == value->second.origin
                                        ? ""
                                        : ", also at " + before->second.origin));
    }
  }
  for (auto& [key, value] : values) set_value(root, key, std::move(value));
}

void apply_overrides(ConfigNode& root, const std::vector<std::string>& assignments) {
  std::vector<KeyValue> values;
  for (const std::string& assignment : assignments) values.push_back(parse_override(assignment));
  set_values(root, std::move(values));
}

std::string to_yaml(const ConfigNode& root) {
  YAML::Emitter out;
  emit(out, root);
  return std::string(out.c_str()) + "\n";
}

}  // namespace vantage
