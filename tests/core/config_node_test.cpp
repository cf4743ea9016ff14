#include "vantage/core/config_node.hpp"

#include <gtest/gtest.h>

#include "vantage/core/yaml.hpp"

namespace vantage {
namespace {

TEST(ConfigNode, SetReplacesOrAppendsInOrder) {
  ConfigNode node;
  node.set("b", ConfigNode::make_scalar("1"));
  node.set("a", ConfigNode::make_scalar("2"));
  node.set("b", ConfigNode::make_scalar("3"));
  EXPECT_EQ(node.kind, ConfigNode::Kind::map);
  ASSERT_EQ(node.entries.size(), 2U);
  EXPECT_EQ(node.entries[0].first, "b");
  EXPECT_EQ(node.find("b")->scalar, "3");
  EXPECT_EQ(node.find("c"), nullptr);
}

TEST(ConfigNode, WhereNamesOriginAndKey) {
  ConfigNode node;
  EXPECT_EQ(node.where(), "");
  node.key = "map.cells";
  EXPECT_EQ(node.where(), "map.cells");
  node.origin = "e.yaml:3";
  EXPECT_EQ(node.where(), "e.yaml:3: map.cells");
  node.key.clear();
  EXPECT_EQ(node.where(), "e.yaml:3");
}

TEST(ConfigNode, KindsHaveNames) {
  EXPECT_EQ(kind_name(ConfigNode{}.kind), "nothing");
  EXPECT_EQ(kind_name(ConfigNode::make_scalar("x").kind), "a scalar");
  EXPECT_EQ(kind_name(ConfigNode::make_list().kind), "a list");
  EXPECT_EQ(kind_name(ConfigNode::make_map().kind), "a map");
}

TEST(ConfigNode, IsFoundByItsDottedKey) {
  const ConfigNode root = parse_yaml("a: {b: {c: 1}, d: 2}\ne: 3\n", "e.yaml");
  EXPECT_EQ(find_value(root, "")->kind, ConfigNode::Kind::map);
  EXPECT_EQ(find_value(root, "e")->scalar, "3");
  EXPECT_EQ(find_value(root, "a.d")->scalar, "2");
  EXPECT_EQ(find_value(root, "a.b.c")->scalar, "1");
  EXPECT_EQ(find_value(root, "a.b.x"), nullptr);
  EXPECT_EQ(find_value(root, "x.b.c"), nullptr);
  EXPECT_EQ(find_value(root, "e.f"), nullptr);
}

}  // namespace
}  // namespace vantage
