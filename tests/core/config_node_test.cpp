#include "vantage/core/config_node.hpp"

#include <gtest/gtest.h>

#include "vantage/core/names.hpp"
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

/// Lists of numbers are told, what is a command is not.
TEST(LabelOf, TellsWhatIsNotTheDefault) {
  const auto numbers = [](const std::vector<std::string>& values) {
    ConfigNode list = ConfigNode::make_list();
    for (const std::string& value : values) list.items.push_back(ConfigNode::make_scalar(value));
    return list;
  };
  const auto options = [&](const ConfigNode& sigma_m, const std::string& samples) {
    ConfigNode node = ConfigNode::make_map();
    node.set("sigma_m", sigma_m);
    node.set("samples", ConfigNode::make_scalar(samples));
    return node;
  };
  const ConfigNode usual = options(numbers({"1", "1", "0.5"}), "20");
  EXPECT_EQ(label_of("stomp", usual, usual), "stomp");
  EXPECT_EQ(label_of("stomp", options(numbers({"1", "1", "0.4"}), "20"), usual),
            "stomp sigma_m=[1, 1, 0.4]");
  EXPECT_EQ(label_of("stomp", options(numbers({"1", "1", "0.5"}), "30"), usual),
            "stomp samples=30");
  EXPECT_EQ(label_of("stomp", options(numbers({"python3", "mine.py"}), "20"), usual), "stomp");
  EXPECT_EQ(label_of("stomp", options(numbers({"python3", "2"}), "20"), usual), "stomp");
}

TEST(ConfigNode, IsOfNothingAtFirst) {
  const ConfigNode node;
  EXPECT_EQ(node.kind, ConfigNode::Kind::null);
  EXPECT_FALSE(node.quoted);
  EXPECT_FALSE(ConfigNode::make_scalar("1").quoted);
}

}  // namespace
}  // namespace vantage
