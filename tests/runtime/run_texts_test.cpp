// What the files of a run folder say: JSON, measures of it, texts about it.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>

#include "vantage/core/yaml.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/runtime/measure.hpp"
#include "vantage/runtime/record_text.hpp"
#include "vantage/runtime/run_summary.hpp"

namespace vantage {
namespace {

using RunJson = nlohmann::ordered_json;

TEST(RunJson, IsIndentedOrInOneLine) {
  const RunJson json{{"b", 1}, {"a", {2, 3}}};
  EXPECT_EQ(json_text(json), "{\n  \"b\": 1,\n  \"a\": [\n    2,\n    3\n  ]\n}\n");
  EXPECT_EQ(json_line(json), "{\"b\":1,\"a\":[2,3]}");
  EXPECT_EQ(json_line(RunJson("a\xff\xc3\xa4")), "\"a\xef\xbf\xbd\xc3\xa4\"");
  EXPECT_EQ(json_text(RunJson("\xff")), "\"\xef\xbf\xbd\"\n");
}

TEST(RunJson, OfAConfigurationHasItsNumbersAndTexts) {
  const ConfigNode node = parse_yaml(
      "a: 1\nb: \"1\"\nc: true\nd: text\ne: [1, 2.5, [3]]\nf: {g: -2}\nh: ~\ni: []\nj: {}\n"
      "k: \"true\"\n",
      "e.yaml");
  EXPECT_EQ(json_line(config_json(node)),
            R"({"a":1,"b":"1","c":true,"d":"text","e":[1,2.5,[3]],"f":{"g":-2},"h":null,"i":[],)"
            R"("j":{},"k":"true"})");
}

TEST(RunJson, OfBoxesAndViews) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d(1.0, 2.0, 3.0), Eigen::Vector3d(4.0, 5.5, 6.0));
  EXPECT_EQ(json_line(box_json(box)), R"({"min_m":[1.0,2.0,3.0],"max_m":[4.0,5.5,6.0]})");
  const RunJson view = view_json(make_pose({1.0, 2.0, 3.0}, 0.7, 0.4));
  EXPECT_EQ(view["x_m"], 1.0);
  EXPECT_EQ(view["y_m"], 2.0);
  EXPECT_EQ(view["z_m"], 3.0);
  EXPECT_NEAR(view["yaw_rad"].get<double>(), 0.7, 1e-12);
  EXPECT_EQ(view.size(), 4U);
}

TEST(RunJson, OfCandidatesKeepsTheirOrderAndIds) {
  std::array<Candidate, 2> views;
  views[0].id = 4;
  views[0].T_world_sensor = make_pose({1.0, 2.0, 3.0}, 0.0);
  views[1].id = 2;
  views[1].T_world_sensor = make_pose({4.0, 5.0, 6.0}, 0.0);
  const RunJson list = candidates_json(views);
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0]["id"], 4);
  EXPECT_EQ(list[0]["z_m"], 3.0);
  EXPECT_EQ(list[1]["id"], 2);
  EXPECT_EQ(list[1]["x_m"], 4.0);
  EXPECT_TRUE(candidates_json({}).is_array());
}

TEST(Measures, SayWhichDirectionIsBetter) {
  EXPECT_EQ(direction_text(Better::lower), "lower is better");
  EXPECT_EQ(direction_text(Better::higher), "higher is better");
  EXPECT_EQ(direction_text(Better::unsaid), "");
  EXPECT_EQ(measure_text({"a", "area, m^2", Better::higher}), "area, m^2, higher is better");
  EXPECT_EQ(measure_text({"a", "area, m^2"}), "area, m^2");
  EXPECT_EQ(measure_text(kPathLength.name), "path length, m, lower is better");
  EXPECT_EQ(measure_text(kCollisions.name), "collisions, lower is better");
  EXPECT_EQ(measure_text(kSimulatedTime.name), "simulated time, s, lower is better");
  EXPECT_FALSE(kPathLength.name.wall);
}

TEST(Measures, AreReadFromTheMetrics) {
  const RunJson metrics{{"path_length_m", 2.5},
                        {"collisions", 3},
                        {"simulated_time_s", 40.25},
                        {"reached", true},
                        {"left", false},
                        {"time_to_80_s", nullptr},
                        {"scans", RunJson::array({{{"cells", 7}}, {{"cells", 2.5}}})}};
  const MeasuredEpisode episode{metrics, 2};
  EXPECT_EQ(kPathLength.of(episode), 2.5);
  EXPECT_EQ(kCollisions.of(episode), 3.0);
  EXPECT_EQ(kSimulatedTime.of(episode), 40.25);
  EXPECT_EQ(number_of(episode, "reached"), 1.0);
  EXPECT_EQ(number_of(episode, "left"), 0.0);
  EXPECT_EQ(number_of(episode, "time_to_80_s"), std::nullopt);
  EXPECT_EQ(number_if_measured(episode, "collisions"), 3.0);
  EXPECT_EQ(number_if_measured(episode, "of_a_later_version"), std::nullopt);
  EXPECT_EQ(step_values(episode, "scans", "cells"), (Curve{7.0, 2.5}));
}

TEST(Measures, HaveAMeanUnlessThereAreNone) {
  EXPECT_EQ(mean_of({}), std::nullopt);
  EXPECT_EQ(mean_of({1.0, 2.0, 6.0}), 3.0);
}

TEST(RunSummary, SaysHowTheEpisodeEnded) {
  EXPECT_EQ(status_name(EpisodeStatus::completed), "completed");
  EXPECT_EQ(status_name(EpisodeStatus::failed), "failed");
  EXPECT_EQ(status_name(EpisodeStatus::diverged), "diverged");
  EXPECT_EQ(status_name(EpisodeStatus::interrupted), "interrupted");
  RunSummary summary{.status = EpisodeStatus::failed,
                     .reason = "no way",
                     .simulated_time_s = 5.0,
                     .wall_time_s = 2.0,
                     .path_length_m = 1.5,
                     .collisions = 4,
                     .state_hash = 0x1f};
  const RunIdentity identity{"exploration", 9, "scene.xml", "greedy"};
  EXPECT_EQ(json_line(summary_json(identity, summary)),
            R"({"task":"exploration","status":"failed","reason":"no way","seed":9,)"
            R"("scene":"scene.xml","method":"greedy","simulated_time_s":5.0,"wall_time_s":2.0,)"
            R"("real_time_factor":2.5,"path_length_m":1.5,"collisions":4,)"
            R"("state_hash":"000000000000001f"})");
  summary.wall_time_s = 0.0;
  EXPECT_EQ(summary_json(identity, summary)["real_time_factor"], 0.0);
}

TEST(RunSummary, IsOfNothingUnlessTold) {
  EXPECT_EQ(json_line(summary_json({}, {})),
            R"({"task":"","status":"completed","reason":"","seed":0,"scene":"","method":"",)"
            R"("simulated_time_s":0.0,"wall_time_s":0.0,"real_time_factor":0.0,)"
            R"("path_length_m":0.0,"collisions":0,"state_hash":"0000000000000000"})");
}

TEST(RecordTexts, AreJoinedInTheirOrder) {
  const RecordTexts first{{"a", "b", "c"}};
  const std::array<RecordText, 2> more{{{"d", "e", "f"}, {"g", "h", "i"}}};
  const RecordTexts all = joined(first, more);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].name, "b");
  EXPECT_EQ(all[1].file, "d");
  EXPECT_EQ(all[2].text, "i");
}

}  // namespace
}  // namespace vantage
