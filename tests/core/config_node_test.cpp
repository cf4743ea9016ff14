#include "vantage/core/config_node.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace vantage
