#include "vantage/core/fields.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "vantage/core/yaml.hpp"

namespace vantage {
namespace {

struct Inner {
  double low = 1.0;
  double high = 2.0;
  void fields(auto&& f) {
    f("low", low, "lower end");
    f("high", high, "upper end");
  }
  void check() const {
    if (low >= high) throw ConfigError("low must be below high");
  }
  bool operator==(const Inner&) const = default;
};

struct Options {
  double radius_m = 0.5;
  int cells = 7;
  std::uint64_t seed = 1;
  bool video = false;
  std::string scene = "tabletop";
  std::array<double, 3> size_m{1.0, 2.0, 3.0};
  std::vector<int> ids{4, 5};
  std::optional<double> limit;
  Inner inner;
  std::vector<Inner> more;
  void fields(auto&& f) {
    f("radius_m", radius_m, "radius of a disc", above(0.0));
    f("cells", cells, "number of cells", between(1, 100));
    f("seed", seed, "seed of the random stream");
    f("video", video, "true: records a video");
    f("scene", scene, "file of the scene");
    f("size_m", size_m, "edge lengths", at_least(0.0));
    f("ids", ids, "some numbers", at_least(0.0));
    f("limit", limit, "a limit; null: none", at_least(10.0));
    f("inner", inner, "a section");
    f("more", more, "a list of sections");
  }
  bool operator==(const Options&) const = default;
};

Options read(const std::string& yaml) {
  Options options;
  read_into(parse_yaml(yaml, "e.yaml"), options);
  return options;
}

std::string error_of(const std::string& yaml) {
  try {
    (void)read(yaml);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(Fields, MissingKeysKeepTheirDefaults) {
  EXPECT_EQ(read(""), Options{});
  EXPECT_EQ(read("inner:\n"), Options{});
  const Options options = read("radius_m: 2\ninner: {high: 9}\n");
  EXPECT_EQ(options.radius_m, 2.0);
  EXPECT_EQ(options.cells, 7);
  EXPECT_EQ(options.inner.low, 1.0);
  EXPECT_EQ(options.inner.high, 9.0);
}

TEST(Fields, ReadsEveryKind) {
  const Options options = read(
      "radius_m: 1e-2\ncells: 9\nseed: 18446744073709551615\nvideo: true\nscene: \"7\"\n"
      "size_m: [0, .5, 6.]\nids: []\nlimit: 12\nmore: [{low: 0}, {}]\n");
  EXPECT_EQ(options.radius_m, 0.01);
  EXPECT_EQ(options.cells, 9);
  EXPECT_EQ(options.seed, UINT64_MAX);
  EXPECT_TRUE(options.video);
  EXPECT_EQ(options.scene, "7");
  EXPECT_EQ(options.size_m, (std::array{0.0, 0.5, 6.0}));
  EXPECT_TRUE(options.ids.empty());
  EXPECT_EQ(options.limit, 12.0);
  ASSERT_EQ(options.more.size(), 2U);
  EXPECT_EQ(options.more[0].low, 0.0);
  EXPECT_EQ(read("limit: ~\n").limit, std::nullopt);
}

TEST(Fields, UnknownKeysAreNamedWithTheKnownOnes) {
  EXPECT_EQ(error_of("cells: 1\nradius: 2\n").find("e.yaml:2: radius: unknown key 'radius'; did"),
            0U);
  EXPECT_EQ(error_of("inner:\n  hihg: 2\n"),
            "e.yaml:2: inner.hihg: unknown key 'hihg'; did you mean high? known here: low, high");
  EXPECT_NE(error_of("more: [{x: 1}]\n").find("more[0].x: unknown key 'x'"), std::string::npos);
}

TEST(Fields, EveryUnknownKeyIsNamed) {
  try {
    (void)read("radius: 2\ninner: {hihg: 2, lwo: 1}\ncell: 3\n");
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.problems().size(), 4U);
  }
}

TEST(Fields, WrongTypesNameFileLineKeyAndValue) {
  EXPECT_EQ(error_of("\nradius_m: wide\n"), "e.yaml:2: radius_m: expected a number, got 'wide'");
  EXPECT_EQ(error_of("radius_m: [1]\n"), "e.yaml:1: radius_m: expected a number, got a list");
  EXPECT_EQ(error_of("radius_m:\n"), "e.yaml:1: radius_m: expected a number, got nothing");
  EXPECT_EQ(error_of("cells: 1.5\n"), "e.yaml:1: cells: expected a whole number, got '1.5'");
  EXPECT_EQ(error_of("seed: -1\n"), "e.yaml:1: seed: expected a whole number >= 0, got '-1'");
  EXPECT_EQ(error_of("scene: {a: 1}\n"), "e.yaml:1: scene: expected text, got a map");
  EXPECT_EQ(error_of("inner: 3\n"), "e.yaml:1: inner: expected a map, got '3'");
  EXPECT_EQ(error_of("ids: 3\n"), "e.yaml:1: ids: expected a list, got '3'");
  EXPECT_EQ(error_of("ids: [1, x]\n"), "e.yaml:1: ids[1]: expected a whole number, got 'x'");
  EXPECT_EQ(error_of("- 1\n"), "e.yaml:1: expected a map, got a list");
}

// What yaml-cpp or another YAML reader would take for something else.
TEST(Fields, DoubtfulScalarsAreRefused) {
  for (const char* number : {".inf", "-.inf", ".nan", "inf",   "nan", "infinity", "010",
                             "-010", "00.5",  "0x10", "1_000", "+1",  "1,5",      "\"1\"",
                             "'1'",  "1e999", "~",    "''",    "1m",  "0o7",      "1:30"}) {
    EXPECT_NE(error_of("radius_m: " + std::string(number)), "") << number;
    EXPECT_NE(error_of("cells: " + std::string(number)), "") << number;
  }
  for (const char* truth : {"yes", "no", "on", "off", "True", "TRUE", "1", "0", "y", "\"true\""}) {
    EXPECT_NE(error_of("video: " + std::string(truth)), "") << truth;
  }
  EXPECT_NE(error_of("cells: 99999999999"), "");
  EXPECT_NE(error_of("seed: 18446744073709551616"), "");
  EXPECT_EQ(error_of("radius_m: 0.5"), "");
}

TEST(Fields, RangesNameTheValueAndWhatIsAllowed) {
  EXPECT_EQ(error_of("radius_m: 0\n"), "e.yaml:1: radius_m: 0 is out of range, allowed: > 0");
  EXPECT_EQ(error_of("cells: 101\n"), "e.yaml:1: cells: 101 is out of range, allowed: [1, 100]");
  EXPECT_EQ(error_of("size_m: [1, -2, 3]\n"),
            "e.yaml:1: size_m[1]: -2 is out of range, allowed: >= 0");
  EXPECT_EQ(error_of("ids: [1, -2]\n"), "e.yaml:1: ids[1]: -2 is out of range, allowed: >= 0");
  EXPECT_EQ(error_of("limit: 9\n"), "e.yaml:1: limit: 9 is out of range, allowed: >= 10");
  EXPECT_EQ(error_of("cells: 100\n"), "");
}

TEST(Fields, ArraysHaveTheirSize) {
  EXPECT_EQ(error_of("size_m: [1, 2]\n"), "e.yaml:1: size_m: expected a list of 3, got 2");
  EXPECT_NE(error_of("size_m: [1, 2, 3, 4]\n"), "");
  EXPECT_EQ(error_of("size_m: 1\n"), "e.yaml:1: size_m: expected a list of 3, got '1'");
}

TEST(Fields, CheckOfANestedStructNamesItsPlace) {
  EXPECT_EQ(error_of("cells: 1\ninner:\n  low: 3\n").find("e.yaml:2: inner: low must be below"), 0U)
      << error_of("cells: 1\ninner:\n  low: 3\n");
}

TEST(CheckOptions, FindsWhatWasFilledInFromCpp) {
  const auto message = [](const Options& options, const std::string& name = {}) -> std::string {
    try {
      check_options(options, name);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message({}), "");
  Options options;
  options.radius_m = -1.0;
  EXPECT_EQ(message(options, "map"), "map.radius_m: -1 is out of range, allowed: > 0");
  options = {};
  options.radius_m = std::nan("");
  EXPECT_NE(message(options), "");
  options = {};
  options.limit = 3.0;
  EXPECT_EQ(message(options), "limit: 3 is out of range, allowed: >= 10");
  options = {};
  options.size_m[2] = -1.0;
  EXPECT_NE(message(options), "");
  options = {};
  options.inner.low = std::nan("");
  EXPECT_EQ(message(options), "inner.low: nan is out of range, allowed: a finite number");
  options = {};
  options.inner.low = 5.0;
  EXPECT_EQ(message(options), "inner: low must be below high");
  options = {};
  options.more.push_back({.low = 5.0, .high = 1.0});
  EXPECT_NE(message(options), "");
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): RapidCheck makes values
RC_GTEST_PROP(Fields, WrittenAndReadBackIsEqual,
              (double radius, std::uint64_t seed, bool video, std::vector<int> ids, bool limited)) {
  Options options;
  options.radius_m = std::abs(radius) + 1e-300;
  RC_PRE(std::isfinite(options.radius_m));
  options.seed = seed;
  options.video = video;
  options.scene = *rc::gen::container<std::string>(rc::gen::inRange<char>(' ', '~'));
  for (const int id : ids) options.ids.push_back(std::abs(id % 1000));
  if (limited) options.limit = 10.0 + std::abs(radius);
  options.inner.low = std::min(radius, 1.9);
  options.more.push_back(options.inner);
  RC_ASSERT(read(to_yaml(write_node(options))) == options);
}

TEST(Fields, NumbersBeginWithAZeroOnlyBeforeTheirPoint) {
  for (const char* number : {"07", "09", "00", "-07", "-09", "-00", "09.5"}) {
    EXPECT_NE(error_of(std::string("inner: {low: ") + number + ", high: 99}"), "") << number;
  }
  for (const char* number : {"07", "09", "00"}) {
    EXPECT_NE(error_of(std::string("ids: [") + number + "]"), "") << number;
  }
  for (const char* number : {"0", "-0", "0.9", "-0.7", "70"}) {
    EXPECT_EQ(error_of(std::string("inner: {low: ") + number + ", high: 99}"), "") << number;
  }
  EXPECT_EQ(error_of("ids: [0, 90]"), "");
}

struct Outermost {
  Inner inner;
  void fields(auto&& f) { f("inner", inner, "a section"); }
  void check() const {
    if (inner.high > 5.0) throw ConfigError("inner.high must not be above 5");
  }
};

TEST(Fields, WhatIsWrongByAnOverrideInsideASectionNamesTheOverride) {
  ConfigNode root = parse_yaml("inner: {low: 1}\n", "e.yaml");
  apply_overrides(root, {"inner.high=9"});
  Outermost options;
  try {
    read_into(root, options);
    ADD_FAILURE() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "--set inner.high: inner.high must not be above 5");
  }
}

TEST(CheckOptions, RunsTheCheckOfTheWholeAsWell) {
  Outermost options;
  EXPECT_NO_THROW(check_options(options));
  options.inner.high = 9.0;
  for (const std::string name : {"", "whole"}) {
    try {
      check_options(options, name);
      ADD_FAILURE() << "accepted";
    } catch (const ConfigError& error) {
      const std::string front = name.empty() ? "" : "whole: ";
      EXPECT_EQ(error.what(), front + "inner.high must not be above 5");
    }
  }
}

/// With a key of the name that strategies have theirs under.
struct NamedThing {
  std::string name = "thing";
  double size = 1.0;
  void fields(auto&& f) {
    f("name", name, "what it is called");
    f("size", size, "how large it is");
  }
};

TEST(Fields, ANameMakesNoStrategyOfASection) {
  const auto problems = [](const std::string& yaml) {
    NamedThing thing;
    try {
      read_into(parse_yaml(yaml, "e.yaml"), thing);
    } catch (const ConfigError& error) {
      return error.problems();
    }
    return std::vector<std::string>{};
  };
  const std::string unknown = ": siz: unknown key 'siz'; did you mean size? known here: name, size";
  EXPECT_EQ(problems("siz: 1\n"), std::vector{"e.yaml:1" + unknown});
  EXPECT_EQ(problems("name: [1]\nsiz: 1\n"),
            (std::vector<std::string>{"e.yaml:1: name: expected text, got a list",
                                      "e.yaml:2" + unknown}));
  EXPECT_EQ(error_of("inner: {name: x}\n"),
            "e.yaml:1: inner.name: unknown key 'name'; known here: low, high");
}

TEST(Fields, TextIsQuotedUnlessEveryReaderTakesItForText) {
  for (const char* text : {"a", "Z9", "_a", "/a/b", "a.b-c", "a.", "a-", "nullx"}) {
    EXPECT_FALSE(detail::write_value(std::string(text)).quoted) << text;
  }
  for (const char* text : {"", "-a", ".a", "a b", "a:b", "a,b", " a", "null", "Null", "NULL"}) {
    EXPECT_TRUE(detail::write_value(std::string(text)).quoted) << text;
  }
}

}  // namespace
}  // namespace vantage
