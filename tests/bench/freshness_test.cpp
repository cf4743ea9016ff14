#include "bench/pages/freshness.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "bench/pages/origins.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage::bench {
namespace {

class FreshnessOf : public testing::Test {
 protected:
  FreshnessOf() {
    git("init -q");
    first_ = commit("src/a.cpp", "1");
    results_ = commit("results.csv", "1,2");
  }
  void git(const std::string& arguments) const {
    const std::string command = fmt::format(
        "git -C '{}' -c user.name=a -c user.email=a@b -c commit.gpgsign=false {} > '{}' 2>&1",
        folder_.path().string(), arguments, log().string());
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
  }
  std::string commit(const char* file, const std::string& content) const {
    std::filesystem::create_directories((folder_.path() / file).parent_path());
    write_file(folder_.path() / file, content);
    git("add -A");
    git(fmt::format("commit -q -m '{}'", content));
    git("rev-parse --short HEAD");
    std::string name = read_file(log());
    name.pop_back();
    return name;
  }
  [[nodiscard]] Freshness of(const std::set<std::string>& commits) const {
    return freshness_of({.commits = commits,
                         .file = "results.csv",
                         .code = {"src", "bench/x.cpp"},
                         .but = {"src/view"}},
                        folder_.path());
  }
  [[nodiscard]] std::filesystem::path log() const { return logs_.path() / "log"; }

  support::TemporaryDirectory folder_;
  support::TemporaryDirectory logs_;
  std::string first_;
  std::string results_;
};

TEST_F(FreshnessOf, ResultsIsThatOfTheirCode) {
  EXPECT_EQ(of({first_}), Freshness::fresh);
  commit("docs/page.md", "of no consequence");
  EXPECT_EQ(of({first_}), Freshness::fresh);
  EXPECT_EQ(of({fmt::format("0.1.0 ({})", first_)}), Freshness::fresh);
  commit("src/view/window.cpp", "only shows");
  EXPECT_EQ(of({first_}), Freshness::fresh);
  const std::string second = commit("src/a.cpp", "2");
  EXPECT_EQ(of({first_}), Freshness::stale);
  EXPECT_EQ(of({second}), Freshness::fresh);
  EXPECT_EQ(of({first_, second}), Freshness::stale);
  commit("bench/x.cpp", "3");
  EXPECT_EQ(of({second}), Freshness::stale);
}

TEST_F(FreshnessOf, CodeThatWasNeverCommittedIsUnknownUnlessItIsStale) {
  EXPECT_EQ(of({first_ + "-dirty"}), Freshness::unknown);
  commit("src/a.cpp", "2");
  EXPECT_EQ(of({first_ + "-dirty"}), Freshness::stale);
}

TEST_F(FreshnessOf, ResultsOfNoRecordedCommitAreNoNewerThanTheirFile) {
  EXPECT_EQ(of({}), Freshness::unknown);
  commit("src/a.cpp", "2");
  EXPECT_EQ(of({}), Freshness::stale);
}

TEST_F(FreshnessOf, AnotherHistoryIsUnknown) {
  EXPECT_EQ(of({"0123456789"}), Freshness::unknown);
  EXPECT_EQ(of({"HEAD; rm -r"}), Freshness::unknown) << "asked of nobody";
  const support::TemporaryDirectory elsewhere;
  EXPECT_EQ(freshness_of({.commits = {first_}, .code = {"src"}}, elsewhere.path()),
            Freshness::unknown);
}

TEST(MarkedCommit, IsRefusedWhereASourceOfTheBenchmarkIsNotThere) {
  const support::TemporaryDirectory repository;
  for (const char* folder : {"src", "planners", "sim", "models", "assets"}) {
    std::filesystem::create_directory(repository / folder);
  }
  std::filesystem::create_directory(repository / "bench");
  for (const char* file : {"situation.cpp", "castray.cpp", "measures.cpp", "hmm.cpp"}) {
    write_file(repository.path() / "bench" / file, "");
  }
  const auto marked = [&](const std::string& benchmark) {
    return marked_commit(benchmark, "0123456", "results.json", repository.path());
  };
  EXPECT_EQ(marked("hmm"), "0123456 ?");
  try {
    marked("gone");
    ADD_FAILURE() << "it can never be stale";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what())
                  .find("results.json: benchmark gone: there is no "
                        "bench/gone.cpp"),
              0U);
  }
}

TEST(FreshnessMark, SaysNothingOfWhatIsFresh) {
  EXPECT_EQ(mark(Freshness::fresh), "");
  EXPECT_EQ(mark(Freshness::stale), " \\*");
  EXPECT_EQ(mark(Freshness::unknown), " ?");
}

}  // namespace
}  // namespace vantage::bench
