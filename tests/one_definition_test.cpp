// A type is defined once: two of one name in one namespace, of different sources of a program, are
// merged without a word where they are not inlined.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/source_files.hpp"

namespace {

/// Of the types that a text defines in named namespaces, their own namespace before each; what is
/// in a namespace without a name, or in a type or function, is nobody else's.
std::vector<std::string> types_of(const std::string& text) {
  static const std::regex opens(R"(^namespace(?: ([\w:]+))? \{)");
  static const std::regex type(
      R"(^(?:struct|class|union|enum class|enum) (\w+)(?: final)?(?: : [^;()]*)? \{.*)");
  std::vector<std::string> found;
  std::vector<std::string> spaces;
  std::istringstream lines(text);
  std::smatch match;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_search(line, match, opens)) {
      spaces.push_back(match[1]);
    } else if (line.starts_with("}  // namespace")) {
      if (!spaces.empty()) spaces.pop_back();
    } else if (std::regex_match(line, match, type) && std::ranges::count(spaces, "") == 0) {
      std::string name;
      for (const std::string& space : spaces) name += space + "::";
      found.push_back(name + match[1].str());
    }
  }
  return found;
}

TEST(OneDefinition, EveryTypeHasANameOfItsOwn) {
  std::map<std::string, std::string> first;  // type -> file
  for (const auto& [path, text] : vantage::support::read_sources(
           {"src", "sim", "planners", "models", "python", "bench", "tests"})) {
    for (const std::string& name : types_of(text)) {
      const auto [at, is_new] = first.emplace(name, path);
      EXPECT_TRUE(is_new) << name << " is defined in " << at->second << " and in " << path;
    }
  }
  EXPECT_GT(first.size(), 500U);
  EXPECT_TRUE(first.contains("vantage::OccupancyGrid"));
}

TEST(OneDefinitionChecker, ReadsDefinitions) {
  EXPECT_EQ(
      types_of("namespace vantage {\nstruct A {\n  struct B {\n  };\n};\nclass C final : public "
               "A {\n};\nenum class D { one };\nstruct E;\nstruct A f() {\n}\n"
               "}  // namespace vantage\nnamespace vantage::bench {\nstruct A {};\n"
               "}  // namespace vantage::bench\n"),
      (std::vector<std::string>{"vantage::A", "vantage::C", "vantage::D", "vantage::bench::A"}));
  EXPECT_EQ(types_of("namespace vantage {\nnamespace {\nstruct A {};\n}  // namespace\nstruct B {"
                     "};\n}  // namespace vantage\n"),
            std::vector<std::string>{"vantage::B"});
}

}  // namespace
