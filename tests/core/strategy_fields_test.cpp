// Strategies in a configuration: by name, or a map with a name and options.
#include <gtest/gtest.h>

#include "vantage/core/fields.hpp"
#include "vantage/core/yaml.hpp"

namespace vantage {
namespace {

struct Simple {
  static constexpr std::string_view name = "simple";
  void fields(auto&&) {}
  bool operator==(const Simple&) const = default;
};
struct Adaptive {
  static constexpr std::string_view name = "adaptive";
  double prior = 0.1;
  double least = 0.0;
  void fields(auto&& f) {
    f("prior", prior, "prior probability", between(0.0, 1.0));
    f("least", least, "least number");
  }
  void check() const {
    if (least > prior) throw ConfigError("least must not be above prior");
  }
  bool operator==(const Adaptive&) const = default;
};
using Gain = std::variant<Simple, Adaptive>;

}  // namespace

template <>
inline constexpr std::string_view strategy_family<Gain> = "gain";

namespace {

struct Planner {
  Gain gain = Adaptive{.prior = 0.7};
  std::vector<Gain> also;
  void fields(auto&& f) {
    f("gain", gain, "what a view is worth");
    f("also", also, "more gains");
  }
  bool operator==(const Planner&) const = default;
};

Planner read_planner(const std::string& yaml) {
  Planner planner;
  read_into(parse_yaml(yaml, "e.yaml"), planner);
  return planner;
}

std::string planner_error(const std::string& yaml) {
  try {
    (void)read_planner(yaml);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(StrategyFields, ByNameWithItsOwnDefaults) {
  EXPECT_EQ(read_planner("").gain, Gain(Adaptive{.prior = 0.7}));
  EXPECT_EQ(read_planner("gain: simple\n").gain, Gain(Simple{}));
  EXPECT_EQ(read_planner("gain: adaptive\n").gain, Gain(Adaptive{}));
}

TEST(StrategyFields, AsAMap) {
  EXPECT_EQ(read_planner("gain: {name: adaptive, prior: 0.3}\n").gain,
            Gain(Adaptive{.prior = 0.3}));
  EXPECT_EQ(read_planner("gain:\n  prior: 0.3\n  name: adaptive\n").gain,
            Gain(Adaptive{.prior = 0.3}));
  EXPECT_EQ(read_planner("gain: {name: simple}\n").gain, Gain(Simple{}));
  const auto also = read_planner("also: [simple, {name: adaptive, prior: 1}]\n").also;
  EXPECT_EQ(also, (std::vector<Gain>{Simple{}, Adaptive{.prior = 1.0}}));
}

TEST(StrategyFields, UnknownNamesListTheKnownOnes) {
  EXPECT_EQ(
      planner_error("gain: adaptiv\n"),
      "e.yaml:1: gain: unknown gain 'adaptiv'; did you mean adaptive? known: simple, adaptive");
  EXPECT_EQ(
      planner_error("gain:\n  name: adaptiv\n").find("e.yaml:1: gain: unknown gain 'adaptiv'"), 0U)
      << planner_error("gain:\n  name: adaptiv\n");
}

TEST(StrategyFields, OtherErrors) {
  EXPECT_NE(planner_error("gain: {prior: 0.3}\n").find("missing key 'name'"), std::string::npos);
  EXPECT_NE(planner_error("gain: [simple]\n").find("expected a name or a map with 'name'"),
            std::string::npos);
  EXPECT_NE(planner_error("gain:\n").find("got nothing"), std::string::npos);
  EXPECT_EQ(
      planner_error("gain:\n  name: simple\n  prior: 0.3\n")
          .find("e.yaml:3: gain.prior: gain simple has no key 'prior'; it has none; it belongs to "
                "adaptive"),
      0U);
  EXPECT_EQ(planner_error("gain: {name: adaptive, priro: 1}\n"),
            "e.yaml:1: gain.priro: gain adaptive has no key 'priro'; did you mean prior? it has "
            "prior, least");
  EXPECT_NE(planner_error("gain: {name: simple, prior: 1}\n").find("; it belongs to adaptive"),
            std::string::npos);
  EXPECT_EQ(planner_error("gain: [simple]\n").find("gain"),
            planner_error("gain: [simple]\n").rfind("gain"));
  EXPECT_NE(
      planner_error("gain: {name: adaptive, prior: 3}\n").find("gain.prior: 3 is out of range"),
      std::string::npos);
  EXPECT_NE(planner_error("gain: {name: [adaptive]}\n"), "");
  EXPECT_NE(planner_error("gain: {name: adaptive, name: simple}\n").find("duplicate"),
            std::string::npos);
}

TEST(StrategyFields, TheStrategysOwnCheckRuns) {
  EXPECT_EQ(planner_error("gain: {name: adaptive, least: 0.5}\n"),
            "e.yaml:1: gain: least must not be above prior");
  EXPECT_THROW(check_options(Planner{.gain = Adaptive{.prior = 0.1, .least = 0.5}, .also = {}}),
               ConfigError);
}

TEST(StrategyFields, ACheckNamesTheOverrideItIsAbout) {
  ConfigNode root = parse_yaml("gain: {name: adaptive, prior: 0.3}\n", "e.yaml");
  apply_overrides(root, {"gain.least=0.5"});
  Planner planner;
  try {
    read_into(root, planner);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "--set gain.least: gain: least must not be above prior");
  }
}

TEST(StrategyFields, OverrideOnTopOfAName) {
  ConfigNode root = parse_yaml("gain: adaptive\n", "e.yaml");
  apply_overrides(root, {"gain.prior=0.4"});
  Planner planner;
  read_into(root, planner);
  EXPECT_EQ(planner.gain, Gain(Adaptive{.prior = 0.4}));
}

TEST(StrategyFields, WrittenAndReadBackIsEqual) {
  const Planner planner{.gain = Adaptive{.prior = 0.25}, .also = {Simple{}, Adaptive{}}};
  const std::string yaml = to_yaml(write_node(planner));
  EXPECT_NE(yaml.find("name: adaptive"), std::string::npos);
  EXPECT_EQ(read_planner(yaml), planner);
}

TEST(StrategyFields, RangesOfWhatWasFilledInFromCppAreChecked) {
  try {
    check_options(Planner{.gain = Adaptive{.prior = 3.0}, .also = {}}, "planner");
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "planner.gain.prior: 3 is out of range, allowed: [0, 1]");
  }
  EXPECT_THROW(check_options(Planner{.gain = Simple{}, .also = {Simple{}, Adaptive{.prior = 3.0}}}),
               ConfigError);
  EXPECT_NO_THROW(check_options(Planner{.gain = Simple{}, .also = {Simple{}, Adaptive{}}}));
}

}  // namespace
}  // namespace vantage
