// What is drawn of the flights of a study.
#include "vantage/study/collect.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

/// Of the first seed alone; of what was not run there is none.
TEST(StudyFlights, AreDrawnOnceAMethod) {
  const support::TemporaryDirectory folder;
  write_file(folder / "study.yaml",
             "episode: assets/episodes/trajectory.yaml\n"
             "factors: {method: {a: {horizon: 5}, b: {horizon: 6}, c: {horizon: 7}}}\n"
             "seeds: [1, 2]\n");
  StudyResults results;
  results.study = read_study(folder / "study.yaml");
  results.directory = folder.path();
  results.plan = plan_study(results.study);
  results.states.assign(6, EpisodeState::missing);
  results.measures.resize(6);
  const Json flight = {{"path", {{-1.0, 0.0, 1.8, 0.0}, {1.0, 0.0, 1.8, 0.0}}},
                       {"plan", {{-1.0, 0.0, 1.8, 0.0}, {1.0, 0.5, 1.8, 0.0}}},
                       {"objects", Json::array()}};
  for (std::size_t i = 0; i < 4; ++i) {
    results.states[i] = EpisodeState::completed;
    results.measures[i].emplace().scalars.resize(scalar_measures().size());
    const fs::path run = episode_folder(folder.path(), results.plan[i]);
    fs::create_directories(run);
    write_file(run / "metrics.json", flight.dump());
  }
  write_collection(results, {});
  std::vector<std::string> drawn;
  for (const auto& entry : fs::directory_iterator(folder / "figures")) {
    drawn.push_back(entry.path().filename().string());
  }
  EXPECT_THAT(drawn, testing::UnorderedElementsAre("a-1.svg", "b-1.svg"));
  const std::string svg = read_file(folder / "figures/a-1.svg");
  EXPECT_THAT(svg, HasSubstr(">a/1</text>"));
  EXPECT_THAT(svg, HasSubstr("<polygon points=")) << "the walls of its scene";
}

/// Of what is varied beside methods and panels only the first level is drawn; of other tasks
/// nothing.
TEST(StudyFlights, AreOfTheFirstLevelOfEveryOtherFactor) {
  const support::TemporaryDirectory folder;
  write_file(folder / "study.yaml",
             "episode: assets/episodes/trajectory.yaml\n"
             "factors: {pace: {slow: {horizon: 5}, fast: {horizon: 6}}, method: {a: {}, b: {}}}\n");
  StudyResults results;
  results.study = read_study(folder / "study.yaml");
  results.directory = folder.path();
  results.plan = plan_study(results.study);
  results.plan[0].resolved =
      load_episode(fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes/tabletop.yaml", {});
  results.states.assign(4, EpisodeState::completed);
  results.measures.resize(4);
  for (const std::size_t i : {1U, 3U}) {
    results.measures[i].emplace().scalars.resize(scalar_measures().size());
    const fs::path run = episode_folder(folder.path(), results.plan[i]);
    fs::create_directories(run);
    write_file(run / "metrics.json", R"({"path": [], "plan": [], "objects": []})");
  }
  write_collection(results, {});
  EXPECT_TRUE(fs::exists(folder / "figures/slow-b.svg"));
  EXPECT_FALSE(fs::exists(folder / "figures/fast-b.svg"));
}

}  // namespace
}  // namespace vantage
