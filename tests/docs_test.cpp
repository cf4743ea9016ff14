// Holds the pages to what they speak of: citations, equations, links, and the paths they name.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/shell.hpp"

namespace {

namespace fs = std::filesystem;
using Texts = std::map<std::string, std::string>;  ///< path from the repository root -> content

const std::string kKey = R"([A-Z][A-Za-z]+(?:18|19|20)[0-9]{2}[a-z]?)";

std::string read(const fs::path& path) {
  std::ostringstream content;
  content << std::ifstream(path).rdbuf();
  return content.str();
}

/// Every source and page, but for what is built and for this file, which has examples of errors.
Texts read_texts() {
  const fs::path repository = VANTAGE_SOURCE_DIR;
  const std::set<std::string> extensions{".cpp", ".hpp", ".md", ".py", ".yaml", ".cmake"};
  Texts texts;
  for (auto it = fs::recursive_directory_iterator(repository);
       it != fs::recursive_directory_iterator(); ++it) {
    const std::string name = it->path().filename();
    if (it->is_directory() && (name == "build" || name == "out" || name.starts_with("."))) {
      it.disable_recursion_pending();
    } else if (it->is_regular_file() && extensions.contains(it->path().extension()) &&
               name != "docs_test.cpp") {
      texts[fs::relative(it->path(), repository).generic_string()] = read(it->path());
    }
  }
  return texts;
}

const Texts& texts() {
  static const Texts all = read_texts();
  return all;
}

Texts pages() {
  Texts found;
  for (const auto& [path, text] : texts()) {
    if (path.ends_with(".md")) found[path] = text;
  }
  return found;
}

/// Matches of `group` of a pattern, in order.
std::vector<std::string> all_matches(const std::string& text, const std::regex& pattern,
                                     std::size_t group) {
  std::vector<std::string> found;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), pattern);
       it != std::sregex_iterator(); ++it) {
    found.push_back((*it)[group].str());
  }
  return found;
}

/// The insides of [Key], [Key, place] and [Key, Key], over the ends of lines of comments as well,
/// and the sources of strategies. A link of Markdown is none.
std::vector<std::string> citations_in(const std::string& text) {
  std::vector<std::string> found;
  const std::regex begins("^" + kKey + R"(\b)");
  for (auto open = text.find('['); open != std::string::npos; open = text.find('[', open + 1)) {
    if (open + 1 >= text.size() || std::isupper(static_cast<unsigned char>(text[open + 1])) == 0) {
      continue;
    }
    const auto close = text.find(']', open);
    if (close == std::string::npos || close - open > 200) continue;
    if (close + 1 < text.size() && text[close + 1] == '(') continue;
    const std::string inside = text.substr(open + 1, close - open - 1);
    if (std::regex_search(inside, begins)) found.push_back(inside);
  }
  const std::regex source(R"re(\.source\s*=\s*"([^"]+)")re");  // of a strategy
  for (const auto& inside : all_matches(text, source, 1)) found.push_back(inside);
  return found;
}

std::set<std::string> keys_in(const std::string& citation) {
  const auto keys = all_matches(citation, std::regex(R"(\b)" + kKey + R"(\b)"), 0);
  return {keys.begin(), keys.end()};
}

std::set<std::string> bibliography() {
  const auto keys = all_matches(read(fs::path(VANTAGE_SOURCE_DIR) / "docs/references.bib"),
                                std::regex(R"(@[a-z]+\{([^,\s]+),)"), 1);
  return {keys.begin(), keys.end()};
}

/// The equations "3.11", "3.12", "3.13" of "(3.11)-(3.13)", a range or single ones.
std::set<std::string> equations_in(const std::string& text) {
  std::set<std::string> found;
  const std::regex pattern(R"(\(([2-5])\.([0-9]+)\)(?:\s*(?:-|to)\s*\(\1\.([0-9]+)\))?)");
  for (auto it = std::sregex_iterator(text.begin(), text.end(), pattern);
       it != std::sregex_iterator(); ++it) {
    const int first = std::stoi((*it)[2]);
    const int last = (*it)[3].matched ? std::stoi((*it)[3]) : first;
    for (int n = first; n <= last; ++n) found.insert((*it)[1].str() + "." + std::to_string(n));
  }
  return found;
}

/// A row of a table of docs/equations.md.
struct Row {
  std::string equation, function, file, source;
};

std::vector<Row> equation_rows(const std::string& page) {
  const std::regex pattern(
      R"(\|([^|\n]*)\|[^|\n]*\|\s*`([^`|\n]+)`\s*\|\s*`([^`|\n]+)`\s*\|([^|\n]*)\|)");
  std::vector<Row> rows;
  for (auto it = std::sregex_iterator(page.begin(), page.end(), pattern);
       it != std::sregex_iterator(); ++it) {
    rows.push_back({(*it)[1], (*it)[2], (*it)[3], (*it)[4]});
  }
  return rows;
}

/// What GitHub and MkDocs make of a heading.
std::string slug(const std::string& heading) {
  std::string made;
  for (const char c : heading) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_') {
      made += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (c == ' ') {
      made += '-';
    }
  }
  return made;
}

/// Links to files of the repository, and to headings in them.
std::vector<std::string> links_in(const std::string& page) {
  auto links = all_matches(page, std::regex(R"(\]\(([^)\s]+)\))"), 1);
  std::erase_if(links,
                [](const std::string& link) { return link.find("://") != std::string::npos; });
  return links;
}

/// Why a link of the page leads nowhere; empty if it leads somewhere.
std::string dead_link(const fs::path& page, const std::string& link) {
  const auto hash = link.find('#');
  const fs::path target = hash == 0 ? page : page.parent_path() / link.substr(0, hash);
  if (!fs::exists(target)) return "there is no such file";
  if (hash == std::string::npos) return "";
  for (const auto& heading : all_matches(read(target), std::regex(R"((?:^|\n)#+ ([^\n]+))"), 1)) {
    if (slug(heading) == link.substr(hash + 1)) return "";
  }
  return "there is no such heading";
}

TEST(Docs, EveryCitationIsInTheBibliography) {
  const auto known = bibliography();
  for (const auto& [path, text] : texts()) {
    for (const auto& citation : citations_in(text)) {
      for (const auto& key : keys_in(citation))
        EXPECT_TRUE(known.contains(key)) << path << ": " << key;
    }
  }
}

TEST(Docs, EveryEntryOfTheBibliographyIsCited) {
  std::set<std::string> cited;
  for (const auto& [path, text] : texts()) {
    for (const auto& citation : citations_in(text)) cited.merge(keys_in(citation));
  }
  for (const auto& key : bibliography()) EXPECT_TRUE(cited.contains(key)) << key;
}

TEST(Docs, EveryEquationIsWhereItsRowSays) {
  const auto rows = equation_rows(texts().at("docs/equations.md"));
  EXPECT_GT(rows.size(), 60U);
  for (const Row& row : rows) {
    const auto file = texts().find(row.file);
    ASSERT_NE(file, texts().end()) << row.file;
    EXPECT_TRUE(std::regex_search(file->second, std::regex(R"(\b)" + row.function + R"(\b)")))
        << row.function << " is not in " << row.file;
  }
}

TEST(Docs, EveryEquationThatIsCitedHasARow) {
  std::set<std::string> listed;
  for (const Row& row : equation_rows(texts().at("docs/equations.md"))) {
    listed.merge(equations_in(row.equation));
  }
  for (const auto& [path, text] : texts()) {
    for (const auto& citation : citations_in(text)) {
      const auto place = citation.find("Potthast2016");
      if (place == std::string::npos) continue;
      for (const auto& equation : equations_in(citation.substr(place))) {
        EXPECT_TRUE(listed.contains(equation)) << path << ": (" << equation << ")";
      }
    }
  }
}

TEST(Docs, EveryLinkLeadsSomewhere) {
  std::size_t links = 0;
  for (const auto& [path, text] : pages()) {
    for (const auto& link : links_in(text)) {
      EXPECT_EQ(dead_link(fs::path(VANTAGE_SOURCE_DIR) / path, link), "") << path << ": " << link;
      ++links;
    }
  }
  EXPECT_GT(links, 50U);  // it read something
}

TEST(Docs, EveryPathInCodeFormatExists) {
  const std::regex pattern(
      "`((?:src|sim|planners|models|assets|bench|tests|docs|cmake)/[\\w./-]+)`");
  for (const auto& [path, text] : pages()) {
    for (const auto& named : all_matches(text, pattern, 1)) {
      EXPECT_TRUE(fs::exists(fs::path(VANTAGE_SOURCE_DIR) / named)) << path << ": " << named;
    }
  }
}

TEST(Docs, TheTutorialShowsWhatIsTested) {
  const std::string& page = texts().at("docs/tutorials/own-gain.md");
  for (const char* file : {"docs/tutorials/rim_gain.hpp", "tests/package/own_gain/own_gain.cpp"}) {
    EXPECT_NE(page.find(texts().at(file)), std::string::npos) << file;
  }
}

TEST(Docs, TheMapFitsOnAPage) {
  EXPECT_LE(fs::file_size(fs::path(VANTAGE_SOURCE_DIR) / "ARCHITECTURE.md"), 8192U);
}

/// From anywhere, before anything is installed or built.
TEST(Docs, ScriptsSayWhatTheyAreFor) {
  const fs::path repository = VANTAGE_SOURCE_DIR;
  for (const char* script :
       {"test", "check", "faults", "fuzz", "mutate", "bench/run", "bench/studies"}) {
    const std::string head = read(repository / script);
    const auto from = head.find("\n# ") + 3;
    const std::string first = head.substr(from, head.find('\n', from) - from);
    const auto said =
        vantage::support::shell("cd / && " + (repository / script).string() + " --help");
    EXPECT_EQ(said.exit_code, 0) << script;
    EXPECT_EQ(said.output.substr(0, said.output.find('\n')), first);
  }
}

// The readers themselves.

TEST(DocsReader, Citations) {
  EXPECT_EQ(citations_in("/// [Elfes1989], [Potthast2016, chapter\n/// 3]; a[Index2], [Link2010](x)"
                         " x[i] [[nodiscard]]"),
            (std::vector<std::string>{"Elfes1989", "Potthast2016, chapter\n/// 3"}));
  EXPECT_EQ(keys_in("BoEtAl2010, BoEtAl2011"), (std::set<std::string>{"BoEtAl2010", "BoEtAl2011"}));
  EXPECT_EQ(citations_in(".formula = \"a[B]\",\n .source = \"Potthast2016, (3.1)\"};"),
            (std::vector<std::string>{"Potthast2016, (3.1)"}));
}

TEST(DocsReader, Equations) {
  EXPECT_EQ(equations_in("Potthast2016, (3.9)-(3.11), (4.2)"),
            (std::set<std::string>{"3.10", "3.11", "3.9", "4.2"}));
  EXPECT_TRUE(equations_in("Potthast2016, 3.2.3").empty());
}

TEST(DocsReader, Rows) {
  const auto rows = equation_rows(
      "| equation | formula | function | file | source |\n|---|---|---|---|---|\n"
      "| (2.4) | $H$ | `entropy_bits` | `src/a.hpp` | [X2000] |\n"
      "| | $x$ | `f` | `b.hpp` | |\n| a | `b` | m |\n");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].function, "entropy_bits");
  EXPECT_EQ(rows[1].file, "b.hpp");
}

TEST(DocsReader, Links) {
  EXPECT_EQ(links_in("[a](b.md) [c](https://d.e) ![f](g.png) [h](#i)"),
            (std::vector<std::string>{"b.md", "g.png", "#i"}));
  EXPECT_EQ(slug("What the dissertation's chain predicts"),
            "what-the-dissertations-chain-predicts");
}

}  // namespace
