// What a recipe of a model means, before anything is made of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/recipe/model_recipe.hpp"

namespace vantage {
namespace {

constexpr auto kMadeUpRecipe = R"(render: {objects: 6, step_deg: 45, models: mine}
recordings:
  - {session: 1, distance_m: 1.1}
  - {session: 2, objects: 3, step_deg: 90}
train: {videos: [1, 2], features: [soft_colour, sift], costs_s: [0.001, 0.002]}
)";

class RecipeFile : public testing::Test {
 protected:
  RecipeFile() {
    std::filesystem::create_directories(folder_ / "mine");
    write_file(folder_ / "recipe.yaml", kMadeUpRecipe);
  }
  ModelRecipe read(const std::vector<std::string>& overrides = {}) {
    return read_model_recipe(folder_ / "recipe.yaml", overrides);
  }
  support::TemporaryDirectory folder_;
};

TEST_F(RecipeFile, RecordingsSayWhereTheyDifferFromWhatIsCommon) {
  const ModelRecipe recipe = read();
  ASSERT_EQ(recipe.recordings.size(), 2U);
  EXPECT_EQ(recipe.recordings[0].session, 1);
  EXPECT_EQ(recipe.recordings[0].objects, 6);
  EXPECT_EQ(recipe.recordings[0].step_deg, 45.0);
  EXPECT_EQ(recipe.recordings[0].distance_m, 1.1);
  EXPECT_EQ(recipe.recordings[1].session, 2);
  EXPECT_EQ(recipe.recordings[1].objects, 3);
  EXPECT_EQ(recipe.recordings[1].step_deg, 90.0);
  EXPECT_EQ(recipe.recordings[1].distance_m, DatasetOptions{}.distance_m);
  EXPECT_THAT(recipe.train.videos, testing::ElementsAre(1, 2));
}

TEST_F(RecipeFile, ObjectsAreFoundBesideIt) {
  for (const DatasetOptions& recording : read().recordings) {
    EXPECT_EQ(recording.models, (folder_ / "mine").string());
  }
  EXPECT_THROW(read({"render.models=nowhere"}), InputError);
}

TEST_F(RecipeFile, OverridesOfWhatIsCommonReachEveryRecording) {
  const ModelRecipe recipe = read({"render.objects=12", "render.supersampling=1"});
  EXPECT_EQ(recipe.recordings[0].objects, 12);
  EXPECT_EQ(recipe.recordings[1].objects, 3) << "it says so itself";
  EXPECT_EQ(recipe.recordings[1].supersampling, 1);
}

TEST_F(RecipeFile, RecordingsMayBeOfOurOwnObjectsBesideScannedOnes) {
  write_file(folder_ / "recipe.yaml",
             "recordings:\n  - {session: 1}\n  - {session: 2, models: mine}\n");
  const ModelRecipe recipe = read();
  ASSERT_EQ(recipe.recordings.size(), 2U);
  EXPECT_EQ(recipe.recordings[0].models, "");
  EXPECT_EQ(recipe.recordings[1].models, (folder_ / "mine").string());
}

TEST(RecipeCheck, WantsRecordingsThatDifferAndHaveItsVideos) {
  const auto problem_of = [](const ModelRecipe& recipe) {
    try {
      recipe.check();
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  ModelRecipe recipe;
  recipe.train.videos = {1, 2};
  EXPECT_EQ(problem_of(recipe), "recordings: some are needed");
  recipe.recordings.resize(2);
  EXPECT_EQ(problem_of(recipe), "recordings: two of session 1 are the same");
  recipe.recordings[1].session = 2;
  EXPECT_EQ(problem_of(recipe), "");
  recipe.recordings[1].videos = {4, 1};
  EXPECT_EQ(problem_of(recipe), "train.videos: 2 is not recorded in session 2");
  recipe.train.videos = {4, 1};
  EXPECT_EQ(problem_of(recipe), "");
}

}  // namespace
}  // namespace vantage
