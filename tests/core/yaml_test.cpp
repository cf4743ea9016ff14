#include "vantage/core/yaml.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <fstream>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/fields.hpp"

namespace vantage {
namespace {

ConfigNode parse(const std::string& text) { return parse_yaml(text, "e.yaml"); }

std::string yaml_error_of(const std::string& text) {
  try {
    (void)parse(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(Yaml, TreeWithOriginsAndKeys) {
  const ConfigNode root = parse("a: 1\nmap:\n  cells: [2, 3]\n  name: \"x\"\nnone:\n");
  EXPECT_EQ(root.kind, ConfigNode::Kind::map);
  EXPECT_EQ(root.find("a")->scalar, "1");
  EXPECT_FALSE(root.find("a")->quoted);
  const ConfigNode& cells = *root.find("map")->find("cells");
  EXPECT_EQ(cells.where(), "e.yaml:3: map.cells");
  EXPECT_EQ(cells.items[1].where(), "e.yaml:3: map.cells[1]");
  EXPECT_TRUE(root.find("map")->find("name")->quoted);
  EXPECT_EQ(root.find("map")->find("name")->where(), "e.yaml:4: map.name");
  EXPECT_EQ(root.find("none")->kind, ConfigNode::Kind::null);
}

TEST(Yaml, EveryQuotedOrBlockScalarIsText) {
  const ConfigNode root = parse("a: '1'\nb: \"1\"\nc: |\n  1\nd: >\n  1\n");
  for (const auto& [key, node] : root.entries) EXPECT_TRUE(node.quoted) << key;
}

TEST(Yaml, NothingIsNull) {
  EXPECT_EQ(parse("").kind, ConfigNode::Kind::null);
  EXPECT_EQ(parse("").where(), "e.yaml");
  EXPECT_EQ(parse("# only a comment\n").kind, ConfigNode::Kind::null);
}

TEST(Yaml, DuplicateKeys) {
  EXPECT_EQ(yaml_error_of("a: 1\nb: 2\na: 3\n"), "e.yaml:3: a: duplicate key");
  EXPECT_EQ(yaml_error_of("m:\n  x: 1\n  x: 1\n"), "e.yaml:3: m.x: duplicate key");
  EXPECT_EQ(yaml_error_of("a: 1\n\"a\": 3\n"), "e.yaml:2: a: duplicate key");
  EXPECT_EQ(yaml_error_of("m: {x: 1, y: 2, x: 1}\n"), "e.yaml:1: m.x: duplicate key");
  EXPECT_EQ(yaml_error_of("m: [{x: 1}, {x: 1}]\n"), "");
}

TEST(Yaml, AnchorsAliasesAndTags) {
  EXPECT_EQ(yaml_error_of("a: 1\nb: &x 1\n"), "e.yaml:2: an anchor (&) is not accepted here");
  EXPECT_NE(yaml_error_of("a: &x [1]\nb: *x\n"), "");
  EXPECT_NE(yaml_error_of("a: &x [*x]\n"), "");  // holds itself
  EXPECT_NE(yaml_error_of("a: &x {b: 1}\nc:\n  <<: *x\n"), "");
  EXPECT_NE(yaml_error_of("a: &x\n"), "");
  EXPECT_EQ(yaml_error_of("a: !!int \"1\"\n"),
            "e.yaml:1: the tag 'tag:yaml.org,2002:int' is not accepted here");
  EXPECT_NE(yaml_error_of("a: !python/object {}\n"), "");
  EXPECT_NE(yaml_error_of("a: !mine [1]\n"), "");
}

TEST(Yaml, OneDocumentOnly) {
  EXPECT_EQ(yaml_error_of("---\na: 1\n"), "");
  EXPECT_EQ(yaml_error_of("a: 1\n---\nb: 1\n"), "e.yaml: more than one YAML document");
  // Found by ./fuzz: yaml-cpp makes empty documents of it without end.
  EXPECT_EQ(yaml_error_of(","), "e.yaml: more than one YAML document");
}

TEST(Yaml, KeysThatAreNotText) {
  EXPECT_NE(yaml_error_of("[1, 2]: 3\n").find("e.yaml:1: a key under '' is not plain text"),
            std::string::npos);
  EXPECT_NE(yaml_error_of("m:\n  ~: 3\n").find("e.yaml:2: a key under 'm' is not plain text"),
            std::string::npos);
}

TEST(Yaml, SyntaxErrorsNameTheLine) {
  EXPECT_EQ(yaml_error_of("a: 1\nb: [1, 2\n").find("e.yaml:"), 0U);
  EXPECT_EQ(yaml_error_of("a: 1\n b: 2\n").find("e.yaml:2: not valid YAML"), 0U);
  EXPECT_NE(yaml_error_of("a: \"open\nb: 1\n"), "");
  EXPECT_NE(yaml_error_of("a: 'open\n\n# comment\n\n"), "");
  EXPECT_NE(yaml_error_of("a: *nowhere\n"), "");
}

TEST(Yaml, DeepNestingIsAnErrorAndNoCrash) {
  EXPECT_NE(yaml_error_of(std::string(100000, '[')), "");
  EXPECT_NE(yaml_error_of("a: " + std::string(100000, '{')), "");
}

TEST(Yaml, ReadsFiles) {
  const support::TemporaryDirectory directory;
  std::ofstream(directory / "e.yaml") << "a: 1\n";
  const ConfigNode root = read_yaml(directory / "e.yaml");
  EXPECT_EQ(root.find("a")->origin, (directory / "e.yaml").string() + ":1");
  EXPECT_THROW(read_yaml(directory / "missing.yaml"), InputError);
}

TEST(Yaml, WritesWhatItReads) {
  const std::string text = "a: 1\nb: [1, 2.5]\nc:\n  d: \"1\"\n  e: []\nf: ~\n";
  EXPECT_EQ(to_yaml(parse(text)), text);
  const std::string mixed = "a:\n  - 1\n  - b: 2\n";
  EXPECT_EQ(to_yaml(parse(mixed)), mixed);
}

// Any text at all, however much it looks like a number, null, a date, a comment or syntax.
RC_GTEST_PROP(Yaml, TextSurvivesWritingAndReading, ()) {
  const auto printable = rc::gen::container<std::string>(rc::gen::inRange<char>(' ', '~'));
  const auto text = *rc::gen::oneOf(
      printable, rc::gen::element<std::string>("null", "~", "true", "1", "010", "-", "---", "...",
                                               "a: b", "#x", "", " ", "\n", "a\nb", "\t", "'", "\"",
                                               "NULL", "Null", ".inf", "*x", "&x", "!t", "ä"));
  ConfigNode node = ConfigNode::make_map();
  node.set("key", detail::write_value(text));
  std::string read;
  read_into(*parse(to_yaml(node)).find("key"), read);
  RC_ASSERT(read == text);
}

}  // namespace
}  // namespace vantage
