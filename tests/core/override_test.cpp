// apply_overrides: --set key=value on top of a file.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "vantage/core/error.hpp"
#include "vantage/core/yaml.hpp"

namespace vantage {
namespace {

ConfigNode overridden(const std::string& yaml, const std::string& assignment) {
  ConfigNode root = parse_yaml(yaml, "e.yaml");
  apply_overrides(root, {assignment});
  return root;
}

std::string result(const std::string& yaml, const std::string& assignment) {
  return to_yaml(overridden(yaml, assignment));
}

TEST(Override, ReplacesAndAdds) {
  EXPECT_EQ(result("a: 1\nb: 2\n", "a=3"), "a: 3\nb: 2\n");
  EXPECT_EQ(result("a: 1\n", "b=3"), "a: 1\nb: 3\n");
  EXPECT_EQ(result("", "a=3"), "a: 3\n");
}

TEST(Override, MakesMapsOnTheWay) {
  EXPECT_EQ(result("", "a.b.c=1"), "a:\n  b:\n    c: 1\n");
  EXPECT_EQ(result("a:\n  x: 1\n", "a.b=2"), "a:\n  x: 1\n  b: 2\n");
  EXPECT_EQ(result("a:\n", "a.b=2"), "a:\n  b: 2\n");
}

TEST(Override, RefinesAStrategyWrittenAsItsName) {
  EXPECT_EQ(result("gain: adaptive\n", "gain.prior=0.5"),
            "gain:\n  name: adaptive\n  prior: 0.5\n");
  EXPECT_EQ(result("gain:\n  name: adaptive\n  prior: 0.1\n", "gain=simple"), "gain: simple\n");
}

TEST(Override, AnotherNameTakesTheOptionsOfTheOneBeforeAway) {
  ConfigNode root = parse_yaml("gain: {name: adaptive, a: 1, b: 2}", "file");
  apply_overrides(root, {"gain.c=3", "gain.name=simple"});
  EXPECT_EQ(to_yaml(root), to_yaml(parse_yaml("gain: {name: simple, c: 3}", "file")));
  apply_overrides(root, {"gain.name=simple"});
  EXPECT_EQ(to_yaml(root), to_yaml(parse_yaml("gain: {name: simple, c: 3}", "file")));
}

TEST(Override, TheValueIsYaml) {
  EXPECT_EQ(result("", "a=[1, 2]"), "a: [1, 2]\n");
  EXPECT_EQ(result("", "a={b: 1}"), "a:\n  b: 1\n");
  EXPECT_EQ(result("", "a=\"1\""), "a: \"1\"\n");
  EXPECT_EQ(result("", "a=x=y"), "a: x=y\n");
  EXPECT_EQ(overridden("", "a=").find("a")->kind, ConfigNode::Kind::null);
}

TEST(Override, IsNamedInErrors) {
  const ConfigNode root = overridden("a:\n  b: 1\n", "a.b=[1, {c: 2}]");
  const ConfigNode& value = *root.find("a")->find("b");
  EXPECT_EQ(value.where(), "--set: a.b");
  EXPECT_EQ(value.items[0].where(), "--set: a.b[0]");
  EXPECT_EQ(value.items[1].find("c")->where(), "--set: a.b[1].c");
}

TEST(Override, TheirOrderDoesNotMatter) {
  std::vector<std::string> assignments{"gain=beer_lambert", "gain.a=0.9", "choice.x=1", "b.c.d=3",
                                       "b={e: 4}"};
  std::ranges::sort(assignments);
  std::set<std::string> results;
  do {
    ConfigNode root = parse_yaml("b: 0\nchoice: greedy\ngain: {name: fsmi, d: 1}\n", "e.yaml");
    apply_overrides(root, assignments);
    results.insert(to_yaml(root));
  } while (std::ranges::next_permutation(assignments).found);
  EXPECT_EQ(results, std::set<std::string>{"b:\n  e: 4\n  c:\n    d: 3\n"
                                           "choice:\n  name: greedy\n  x: 1\n"
                                           "gain:\n  name: beer_lambert\n  a: 0.9\n"});
}

TEST(Override, AKeyHasOneValue) {
  ConfigNode root;
  apply_overrides(root, {"a=1", "a=1"});
  EXPECT_EQ(to_yaml(root), "a: 1\n");
  EXPECT_THROW(apply_overrides(root, {"a=1", "a=2"}), ConfigError);
  EXPECT_THROW(apply_overrides(root, {"b=1", "a=1", "a=2"}), ConfigError);
  EXPECT_THROW(apply_overrides(root, {"gain.name=simple", "gain=fsmi"}), ConfigError);
  EXPECT_THROW(apply_overrides(root, {"gain={name: fsmi, d: 2}", "gain.d=3"}), ConfigError);
  ConfigNode refined;
  apply_overrides(refined, {"gain={name: fsmi, d: 2}", "gain.e=3", "gain.name=fsmi"});
  EXPECT_EQ(to_yaml(refined), "gain:\n  name: fsmi\n  d: 2\n  e: 3\n");
}

TEST(Override, RefusesWhatIsNoAssignment) {
  EXPECT_THROW(overridden("", "a"), ConfigError);
  EXPECT_THROW(overridden("", "=1"), ConfigError);
  EXPECT_THROW(overridden("", ""), ConfigError);
  EXPECT_THROW(overridden("", "a=[1"), ConfigError);
  EXPECT_THROW(overridden("", "a=&x 1"), ConfigError);
}

TEST(Override, DoesNotHideAFileThatIsNoMap) {
  EXPECT_THROW(overridden("- 1\n", "a=1"), ConfigError);
  EXPECT_THROW(overridden("just text\n", "a=1"), ConfigError);
}

TEST(Override, AValueFromAnotherFileKeepsItsPlaceThere) {
  ConfigNode root = parse_yaml("a: 1\n", "e.yaml");
  const ConfigNode study = parse_yaml("x:\n  b.c:\n    d: [1]\n", "s.yaml");
  set_values(root, {{"b.c", *study.find("x")->find("b.c")}});
  const ConfigNode& value = *root.find("b")->find("c");
  EXPECT_EQ(value.where(), "s.yaml:2: b.c");
  EXPECT_EQ(value.find("d")->where(), "s.yaml:3: b.c.d");
}

TEST(Override, OfTwoValuesSaysWhereBothAreUnlessThatIsOnePlace) {
  const auto refusal = [](std::vector<KeyValue> values) -> std::string {
    ConfigNode root;
    try {
      set_values(root, std::move(values));
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(refusal({parse_override("a=1"), parse_override("a=2")}),
            "--set: a: set twice, to different values");
  const ConfigNode study = parse_yaml("x: 1\ny: 2\n", "s.yaml");
  EXPECT_EQ(refusal({{"a", *study.find("x")}, {"a", *study.find("y")}}),
            "s.yaml:2: y: set twice, to different values, also at s.yaml:1");
  EXPECT_EQ(refusal({{"a", *study.find("x")}, {"a", *study.find("x")}}), "none");
}

TEST(Override, MapsThatItMakesAreItsOwn) {
  const ConfigNode root = overridden("", "a.b.c=1");
  EXPECT_EQ(root.find("a")->where(), "--set: a");
  EXPECT_EQ(root.find("a")->find("b")->where(), "--set: a.b");
}

TEST(Override, TheNameOfTheWholeTakesNothingAway) {
  EXPECT_EQ(result("name: a\nb: 1\n", "name=c"), "name: c\nb: 1\n");
}

}  // namespace
}  // namespace vantage
