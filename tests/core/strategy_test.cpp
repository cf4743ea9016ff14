#include "vantage/core/strategy.hpp"

#include <gtest/gtest.h>

#include "vantage/core/names.hpp"

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

TEST(Names, LettersOffCountsChanges) {
  EXPECT_EQ(letters_off("", ""), 0U);
  EXPECT_EQ(letters_off("", "abc"), 3U);
  EXPECT_EQ(letters_off("abcd", ""), 4U);
  EXPECT_EQ(letters_off("gain", "gain"), 0U);
  EXPECT_EQ(letters_off("gain", "grain"), 1U) << "one left out";
  EXPECT_EQ(letters_off("gaiin", "gain"), 1U) << "one too many";
  EXPECT_EQ(letters_off("gain", "gaim"), 1U) << "one changed";
  EXPECT_EQ(letters_off("gian", "gain"), 1U) << "two swapped";
  EXPECT_EQ(letters_off("agin", "gain"), 1U) << "the first two";
  EXPECT_EQ(letters_off("ca", "abc"), 3U) << "no change within what was swapped";
  EXPECT_EQ(letters_off("kitten", "sitting"), 3U);
}

TEST(Names, NearestIsTheFirstOfTheNearestThatIsNear) {
  const std::vector<std::string_view> known{"random", "greedy", "tour", "four"};
  EXPECT_EQ(nearest_word("gredy", known), "greedy");
  EXPECT_EQ(nearest_word("gerdy", known), "greedy") << "two off";
  EXPECT_EQ(nearest_word("grdx", known), "") << "three off";
  EXPECT_EQ(nearest_word("our", known), "tour") << "the first of two";
  EXPECT_EQ(nearest_word("tx", {{"ty"}}), "ty");
  EXPECT_EQ(nearest_word("ab", {{"xy"}}), "") << "nothing of it is left";
  EXPECT_EQ(nearest_word("", known), "");
  EXPECT_EQ(did_you_mean("gredy", known), "did you mean greedy? ");
  EXPECT_EQ(did_you_mean("nothing", known), "");
}

struct Bent {
  static constexpr std::string_view name = "bent";
  double angle = 0.5;
  int parts = 3;
  void fields(auto&& f) {
    f("angle", angle, "how far");
    f("parts", parts, "of how many");
  }
};
struct Straight {
  static constexpr std::string_view name = "straight";
  void fields(auto&&) {}
};
struct Chained {
  static constexpr std::string_view name = "chained";
  std::variant<Straight, Bent> link = Bent{};
  int times = 2;
  void fields(auto&& f) {
    f("link", link, "what is chained");
    f("times", times, "how often");
  }
};

TEST(Names, LabelsSayWhatIsNoDefault) {
  using Shape = std::variant<Straight, Bent, Chained>;
  EXPECT_EQ(strategy_label(Shape(Straight{})), "straight");
  EXPECT_EQ(strategy_label(Shape(Bent{})), "bent");
  EXPECT_EQ(strategy_label(Shape(Bent{.angle = 0.25})), "bent angle=0.25");
  EXPECT_EQ(strategy_label(Shape(Bent{.angle = 0.25, .parts = 4})), "bent angle=0.25 parts=4");
  EXPECT_EQ(strategy_label(Shape(Chained{.link = Bent{.angle = 0.5, .parts = 5}, .times = 1})),
            "chained link.parts=5 times=1");
}

}  // namespace
}  // namespace vantage
