#include "vantage/core/strategy.hpp"

#include <gtest/gtest.h>

namespace vantage {
namespace {

struct Left {
  static constexpr std::string_view name = "left";
  int steps = 3;
};
struct Right {
  static constexpr std::string_view name = "right";
};
using Turn = std::variant<Left, Right>;

TEST(Strategy, NamesInOrder) {
  EXPECT_EQ(strategy_names<Turn>(), (std::vector<std::string_view>{"left", "right"}));
  EXPECT_EQ(strategy_name_of(Turn(Right{})), "right");
}

TEST(Strategy, MadeByNameWithDefaults) {
  EXPECT_TRUE(std::holds_alternative<Right>(make_strategy<Turn>("right")));
  EXPECT_EQ(std::get<Left>(make_strategy<Turn>("left")).steps, 3);
}

TEST(Strategy, UnknownName) {
  for (const char* wrong : {"", "Left", "left ", "up"}) {
    EXPECT_THROW(make_strategy<Turn>(wrong), ConfigError) << wrong;
  }
  EXPECT_EQ(unknown_strategy("turn", "up", strategy_names<Turn>()),
            "unknown turn 'up'; known: left, right");
}

}  // namespace
}  // namespace vantage
