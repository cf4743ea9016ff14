// Options described to users: keys, types, units, defaults, ranges, texts.
#include "vantage/core/schema.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/core/yaml.hpp"

namespace vantage {
namespace {

struct Plain {
  static constexpr std::string_view name = "plain";
  static constexpr StrategyText text{.summary = "does nothing"};
  void fields(auto&&) {}
};

struct Fading {
  static constexpr std::string_view name = "fading";
  static constexpr StrategyText text{
      .summary = "fades", .formula = "sum a^n", .source = "Zhang2020, (3)"};
  double a = 0.5;
  void fields(auto&& f) { f("a", a, "what is left after a cell", between(0.0, 1.0)); }
};

using Way = std::variant<Plain, Fading>;

struct Part {
  std::array<double, 3> size_m{1.0, 2.0, 3.0};
  bool all = true;
  void fields(auto&& f) {
    f("size_m", size_m, "of the box", above(0.0));
    f("all", all, "everything counts");
  }
};

struct Whole {
  int scans = 10;
  std::optional<double> limit_s;
  Way way = Fading{.a = 0.25};
  std::vector<Way> others;
  Part inner;
  void fields(auto&& f) {
    f("scans", scans, "at most", at_least(1));
    f("limit_s", limit_s, "of the time");
    f("way", way, "how it fades");
    f("others", others, "tried too");
    f("inner", inner, "the box");
  }
};

const KeyDescription& of(const std::vector<KeyDescription>& keys, std::string_view key) {
  return *std::ranges::find(keys, key, &KeyDescription::key);
}

TEST(Schema, EveryKeyInOrder) {
  std::vector<std::string> names;
  for (const auto& key : describe_fields(Whole{})) names.push_back(key.key);
  EXPECT_THAT(names, testing::ElementsAre("scans", "limit_s", "way", "way.a", "others",
                                          "others[].a", "inner", "inner.size_m", "inner.all"));
}

TEST(Schema, TypeUnitDefaultRangeText) {
  const auto keys = describe_fields(Whole{});
  EXPECT_EQ(of(keys, "scans"), (KeyDescription{.key = "scans",
                                               .type = "whole number",
                                               .default_value = "10",
                                               .range = ">= 1",
                                               .text = "at most"}));
  EXPECT_EQ(of(keys, "inner.size_m"), (KeyDescription{.key = "inner.size_m",
                                                      .type = "list of 3 numbers",
                                                      .unit = "m",
                                                      .default_value = "[1, 2, 3]",
                                                      .range = "> 0",
                                                      .text = "of the box"}));
  EXPECT_EQ(of(keys, "limit_s").type, "number, or null");
  EXPECT_EQ(of(keys, "limit_s").default_value, "null");
  EXPECT_EQ(of(keys, "inner.all").type, "true or false");
  EXPECT_TRUE(of(keys, "inner").section);
}

TEST(Schema, AStrategyNamesItsAlternativesAndTheyTheirs) {
  const auto keys = describe_fields(Whole{});
  EXPECT_EQ(of(keys, "way").type, "one of plain, fading");
  EXPECT_EQ(of(keys, "way").default_value, "fading");
  EXPECT_EQ(of(keys, "way.a").default_value, "0.25");
  EXPECT_THAT(of(keys, "way.a").owners,
              testing::ElementsAre(KeyDescription::Owner{"way", "fading"}));
  EXPECT_EQ(of(keys, "others").type, "list of one of plain, fading");
  EXPECT_EQ(of(keys, "others[].a").default_value, "0.5");
}

TEST(Schema, UnitsAreTheEndOfAName) {
  EXPECT_EQ(unit_in_name("radius_m"), "m");
  EXPECT_EQ(unit_in_name("speed_m_s"), "m/s");
  EXPECT_EQ(unit_in_name("weight_per_m"), "1/m");
  EXPECT_EQ(unit_in_name("bias_rad_per_m"), "rad/m");
  EXPECT_EQ(unit_in_name("area_m2"), "m^2");
  EXPECT_EQ(unit_in_name("yaw_rad"), "rad");
  EXPECT_EQ(unit_in_name("scans"), "");
  EXPECT_EQ(unit_in_name("m"), "");
}

TEST(Schema, Ranges) {
  EXPECT_EQ(range_text({}), "");
  EXPECT_EQ(range_text(between(0.0, 1.0)), "[0, 1]");
  EXPECT_EQ(range_text(Range{0.0, 1.0, true}), "(0, 1]");
  EXPECT_EQ(range_text(above(0.0)), "> 0");
  EXPECT_EQ(range_text(at_least(2.0)), ">= 2");
  EXPECT_EQ(range_text(Range{.max = 3.0}), "<= 3");
}

TEST(Schema, StrategiesSayWhatTheyAre) {
  const auto ways = describe_strategies<Way>();
  ASSERT_EQ(ways.size(), 2U);
  EXPECT_EQ(ways[1].name, "fading");
  EXPECT_EQ(ways[1].text.formula, "sum a^n");
  ASSERT_EQ(ways[1].parameters.size(), 1U);
  EXPECT_EQ(ways[1].parameters[0].key, "a");
}

TEST(Schema, CommentsStandAboveTheirKeys) {
  Whole options;
  options.others = {Fading{}};
  EXPECT_EQ(commented_yaml(write_node(options), describe_fields(Whole{})),
            "# at most (>= 1)\n"
            "scans: 10\n"
            "# of the time (s)\n"
            "limit_s: ~\n"
            "# how it fades (one of plain, fading)\n"
            "way:\n"
            "  name: fading\n"
            "  # what is left after a cell ([0, 1])\n"
            "  a: 0.25\n"
            "# tried too\n"
            "others:\n"
            "  - name: fading\n"
            "    a: 0.5\n"
            "# the box\n"
            "inner:\n"
            "  # of the box (m, > 0)\n"
            "  size_m: [1, 2, 3]\n"
            "  # everything counts\n"
            "  all: true\n");
}

TEST(Schema, CommentedYamlReadsAsTheSame) {
  Whole options;
  options.way = Plain{};
  const ConfigNode node = write_node(options);
  const std::string text = commented_yaml(node, describe_fields(Whole{}));
  EXPECT_EQ(to_yaml(parse_yaml(text, "e.yaml")), to_yaml(node));
  EXPECT_EQ(text.find("what is left"), text.npos);  // plain has no a
}

TEST(Schema, TextIsBrokenAtSpaces) {
  EXPECT_THAT(wrapped("one two three", 7), testing::ElementsAre("one two", "three"));
  EXPECT_THAT(wrapped("abcdefghij k", 4), testing::ElementsAre("abcdefghij", "k"));
  EXPECT_THAT(wrapped("", 4), testing::IsEmpty());
}

TEST(Schema, EveryUnitIsKnown) {
  const std::vector<std::pair<std::string_view, std::string_view>> units{
      {"slope_m_per_m", "m/m"}, {"gain_per_s2", "1/s^2"}, {"a_rad_s2", "rad/s^2"},
      {"w_rad_s", "rad/s"},     {"a_m_s2", "m/s^2"},      {"gain_per_s", "1/s"},
      {"gain_per_j", "1/J"},    {"i_kg_m2", "kg m^2"},    {"volume_m3", "m^3"},
      {"turn_deg", "deg"},      {"wall_ms", "ms"},        {"time_s", "s"},
      {"rate_hz", "Hz"},        {"height_px", "px"},      {"gain_bits", "bits"},
      {"gain_nats", "nats"},    {"mass_kg", "kg"},        {"torque_nm", "N m"},
      {"force_n", "N"},         {"energy_j", "J"},        {"power_w", "W"},
      {"memory_mb", "MB"}};
  for (const auto& [name, unit] : units) EXPECT_EQ(unit_in_name(name), unit) << name;
  EXPECT_EQ(unit_in_name("_m"), "") << "a unit alone is a name";
  EXPECT_EQ(unit_in_name("x_m"), "m");
}

TEST(Schema, ValuesAreToldInOneLine) {
  EXPECT_EQ(detail::value_text(
                parse_yaml("a: [1, \"2\", ~]\nb: {name: x}\nc: {name: x, d: 1}\n", "e.yaml")),
            "{a: [1, \"2\", null], b: x, c: {name: x, d: 1}}");
  EXPECT_EQ(detail::value_text(parse_yaml("{d: 1}", "e.yaml")), "{d: 1}");
  EXPECT_EQ(detail::list_type("number", 0), "list of numbers");
  EXPECT_EQ(detail::list_type("whole number", 2), "list of 2 whole numbers");
  EXPECT_EQ(detail::list_type("text", 1), "list of 1 text");
}

TEST(Schema, LongTextsAreBrokenWhereTheyFit) {
  EXPECT_THAT(wrapped("aaaa bbbb", 4), testing::ElementsAre("aaaa", "bbbb"));
  EXPECT_THAT(wrapped("aaaa bbbb", 9), testing::ElementsAre("aaaa bbbb"));
  EXPECT_THAT(wrapped("aaaa bbbb", 8), testing::ElementsAre("aaaa", "bbbb"));
  EXPECT_THAT(wrapped("aa bb cc", 5), testing::ElementsAre("aa bb", "cc"));
  EXPECT_THAT(wrapped("a bcdefg", 3), testing::ElementsAre("a", "bcdefg"));
}

TEST(Schema, CommentsAreAsWideAsAHundredCharacters) {
  const ConfigNode root = parse_yaml("a: 1\nb:\n  c: 2\n", "e.yaml");
  const auto comments = [&](const std::string& key, std::size_t first, std::size_t second) {
    KeyDescription description;
    description.key = key;
    description.text = std::string(first, 'x') + " " + std::string(second, 'y');
    const std::string text = commented_yaml(root, {description});
    return std::count(text.begin(), text.end(), '#');
  };
  EXPECT_EQ(comments("a", 48, 49), 1) << "2 + 98";
  EXPECT_EQ(comments("a", 48, 50), 2);
  EXPECT_EQ(comments("b.c", 47, 48), 1) << "4 + 96";
  EXPECT_EQ(comments("b.c", 47, 49), 2);
}

KeyDescription key_that(const std::string& key, const std::string& text) {
  KeyDescription description;
  description.key = key;
  description.text = text;
  return description;
}

TEST(Schema, KeysBelongToStrategiesThatWereChosen) {
  KeyDescription key = key_that("a", "of it");
  key.owners = {KeyDescription::Owner{"way", "fading"}};
  const auto commented = [&](const std::string& yaml) {
    return commented_yaml(parse_yaml(yaml, "e.yaml"), {key});
  };
  EXPECT_EQ(commented("a: 1\n"), "a: 1\n");
  EXPECT_EQ(commented("way: plain\na: 1\n"), "way: plain\na: 1\n");
  EXPECT_EQ(commented("way: fading\na: 1\n"), "way: fading\n# of it\na: 1\n");
  key.owners = {KeyDescription::Owner{"way", "fading"}, KeyDescription::Owner{"other", "plain"}};
  const std::string two = "way: fading\nother: fading\na: 1\n";
  EXPECT_EQ(commented(two), two) << "of both it is neither's";
  EXPECT_EQ(commented("way: fading\nother: plain\na: 1\n"),
            "way: fading\nother: plain\n# of it\na: 1\n");
}

TEST(Schema, ALineWithoutAKeyHasNoComment) {
  EXPECT_EQ(commented_yaml(parse_yaml("a\n", "e.yaml"), {key_that("a", "none")}), "a\n");
}

TEST(Schema, KeysInsideAListHaveNoComments) {
  const std::vector<KeyDescription> keys{key_that("others.a", "none"), key_that("a", "none"),
                                         key_that("b", "after it")};
  EXPECT_EQ(commented_yaml(parse_yaml("others: [{name: x, a: 1}]\nb: 2\n", "e.yaml"), keys),
            "others:\n  - name: x\n    a: 1\n# after it\nb: 2\n");
  EXPECT_EQ(commented_yaml(parse_yaml("[{a: 1}, {a: 2}]\n", "e.yaml"), keys), "- a: 1\n- a: 2\n");
}

/// Indented by sixty.
TEST(Schema, CommentsHaveFortyCharactersHoweverDeepTheyStand) {
  std::string yaml;
  std::string path;
  for (std::size_t depth = 0; depth < 30; ++depth) {
    yaml += std::string(2 * depth, ' ') + "k:\n";
    path += "k.";
  }
  const ConfigNode root = parse_yaml(yaml + std::string(60, ' ') + "a: 1\n", "e.yaml");
  for (const std::size_t second : {20U, 21U}) {
    const std::string words = std::string(19, 'x') + ' ' + std::string(second, 'y');
    const std::string text = commented_yaml(root, {key_that(path + "a", words)});
    EXPECT_EQ(std::count(text.begin(), text.end(), '#'), second == 20 ? 1 : 2) << second;
  }
}

struct Shelves {
  std::optional<Part> top;
  std::vector<Part> boards;
  void fields(auto&& f) {
    f("top", top, "if there is one");
    f("boards", boards, "below it");
  }
};

TEST(Schema, SectionsThatMayBeThereAreDescribedToo) {
  const auto keys = describe_fields(Shelves{});
  std::vector<std::string> names;
  for (const auto& key : keys) names.push_back(key.key);
  EXPECT_THAT(names, testing::ElementsAre("top", "top.size_m", "top.all", "boards",
                                          "boards[].size_m", "boards[].all"));
  EXPECT_EQ(of(keys, "top").type, "section, or null");
  EXPECT_EQ(of(keys, "top").default_value, "null");
  EXPECT_FALSE(of(keys, "top").section);
  EXPECT_EQ(of(keys, "boards").type, "list of section");
  EXPECT_EQ(of(keys, "boards").default_value, "[]");
}

}  // namespace
}  // namespace vantage
