// What an attempt leaves behind, whoever else is at the same episode.
#include "vantage/study/sweep/attempt.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/study/manifest_of_files.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

class Attempts : public testing::Test {
 protected:
  Attempts() {
    const auto base = fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes/tabletop.yaml";
    episode_ = {"near/simple", {0, 0}, load_episode(base, {"gain=simple"})};
    published_ = episode_folder(study_.path(), episode_);
    claims_ = claims_folder(study_.path(), episode_);
  }
  Attempt begin(int number) {
    auto attempt = Attempt::begin(study_.path(), episode_, number, this_worker());
    EXPECT_TRUE(attempt);
    return *attempt;
  }
  /// @param mark tells whose result it is
  void complete(const fs::path& folder, const std::string& mark) {
    fs::create_directories(folder);
    std::ofstream(folder / "config.yaml") << episode_yaml(episode_.resolved);
    std::ofstream(folder / "manifest.json") << manifest_of_files(episode_.resolved);
    std::ofstream(folder / "metrics.json") << R"({"status": "completed"})";
    std::ofstream(folder / "mark") << mark;
  }
  std::string mark() { return read_file(published_ / "mark"); }

  support::TemporaryDirectory study_;
  PlannedEpisode episode_;
  fs::path published_, claims_;
  ResultCheck check_;
};

TEST_F(Attempts, TakeThePlaceOfWhatCrashed) {
  fs::create_directories(published_);
  std::ofstream(published_ / "failure.json") << "{}";
  const Attempt attempt = begin(1);
  complete(attempt.folder(), "first");
  EXPECT_EQ(check_(study_.path(), episode_), EpisodeState::crashed);
  EXPECT_EQ(attempt.publish(check_), EpisodeState::completed);
  EXPECT_EQ(mark(), "first");
  EXPECT_FALSE(fs::exists(published_ / "failure.json"));
  EXPECT_TRUE(claim_in_force(claims_)->released);
  EXPECT_EQ(std::distance(fs::directory_iterator(claims_), {}), 1);
}

TEST_F(Attempts, LeaveAResultThatIsThere) {
  const Attempt late = begin(1);
  complete(late.folder(), "late");
  complete(published_, "early");
  EXPECT_EQ(late.publish(check_), EpisodeState::completed);
  EXPECT_EQ(mark(), "early");
  EXPECT_FALSE(fs::exists(late.folder()));
}

TEST_F(Attempts, ThatWereTakenOverPublishNothing) {
  const Attempt believed_dead = begin(1);
  complete(believed_dead.folder(), "dead");
  const Attempt heir = begin(2);
  EXPECT_FALSE(fs::exists(believed_dead.folder()));
  complete(believed_dead.folder(), "dead");  // it is not, and goes on
  EXPECT_EQ(believed_dead.publish(check_), EpisodeState::missing);
  EXPECT_FALSE(fs::exists(published_));
  EXPECT_FALSE(claim_in_force(claims_)->released) << "of the heir";
  complete(heir.folder(), "heir");
  EXPECT_EQ(heir.publish(check_), EpisodeState::completed);
  EXPECT_EQ(mark(), "heir");
}

TEST_F(Attempts, ThatAreDroppedLeaveTheEpisodeToOthers) {
  begin(1).drop();
  EXPECT_TRUE(claim_in_force(claims_)->released);
  EXPECT_FALSE(fs::exists(published_));
  EXPECT_FALSE(Attempt::begin(study_.path(), episode_, 1, this_worker()));
  EXPECT_TRUE(Attempt::begin(study_.path(), episode_, 2, this_worker()));
}

TEST_F(Attempts, ThatCannotBePublishedAreAnError) {
  std::ofstream(study_ / "episodes") << "no folder";
  const Attempt attempt = begin(1);
  complete(attempt.folder(), "first");
  EXPECT_THROW(attempt.publish(check_), OutputError);
}

/// It cannot be moved away here, as if it had come a moment later.
TEST_F(Attempts, LeaveWhatHasComeIntoTheirPlaceMeanwhile) {
  fs::create_directories(published_);
  std::ofstream(published_ / "failure.json") << "{}";
  const Attempt attempt = begin(1);
  complete(attempt.folder(), "first");
  const fs::path former = attempt.folder().string() + ".former";
  fs::create_directories(former / "something");
  EXPECT_EQ(attempt.publish(check_), EpisodeState::crashed);
  EXPECT_TRUE(fs::exists(published_ / "failure.json"));
  EXPECT_FALSE(fs::exists(attempt.folder()));
  EXPECT_FALSE(fs::exists(former));
  EXPECT_TRUE(claim_in_force(claims_)->released);
}

}  // namespace
}  // namespace vantage
