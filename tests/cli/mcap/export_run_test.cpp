// A short run as an MCAP file: what its folder says, at the times it says.
#include "vantage/mcap/export_run.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "tests/cli/mcap/mcap_file.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/log.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/mcap/messages.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/runtime/log/event_log.hpp"
#include "vantage/runtime/log/state_log.hpp"
#include "vantage/tasks/run.hpp"

namespace vantage {
namespace {

using ExportJson = nlohmann::ordered_json;

struct TimedJson {
  std::uint64_t time_ns = 0;
  ExportJson json;
};
using TopicMessages = std::map<std::string, std::vector<TimedJson>>;

TopicMessages topics_of(const test::McapFile& file) {
  TopicMessages topics;
  for (const test::McapMessage& message : file.messages) {
    topics[file.channels.at(message.channel).first].push_back(
        {message.time_ns, ExportJson::parse(message.text)});
  }
  return topics;
}

/// Three scans of a table top, exported with an image every four seconds.
struct ShortExport {
  support::TemporaryDirectory folder;
  ExportedRun exported;
  std::unique_ptr<test::McapFile> file;
  TopicMessages topics;
  RecordedStates states;
  std::vector<EpisodeEvent> events;
  GridFrame frame;

  ShortExport() {
    set_verbosity(Verbosity::quiet);
    RunOptions options;
    options.directory = folder / "run";
    run(load_episode(VANTAGE_SOURCE_DIR "/assets/episodes/tabletop.yaml",
                     {"scans=3", "map.cells=[33,33,17]", "laser.scan_duration_s=2"}),
        options);
    exported = export_run(folder / "run", folder / "run.mcap",
                          {.image_period_s = 4.0, .image_height_px = 48});
    file = std::make_unique<test::McapFile>(read_file(folder / "run.mcap"));
    topics = topics_of(*file);
    states = read_states(folder / "run/states.bin");
    frame = *window(load_recorded(folder / "run")).map;
    events = read_event_log(folder / "run/story.bin", frame.size());
  }
  [[nodiscard]] std::uint64_t time_ns(std::uint64_t tick) const {
    return nanoseconds(states.state(std::min<std::size_t>(tick, states.count() - 1))[0]);
  }
  [[nodiscard]] double end_s() const { return states.state(states.count() - 1)[0]; }
};

const ShortExport& short_export() {
  static const ShortExport made;
  return made;
}

double seconds_of(std::uint64_t time_ns) { return 1e-9 * static_cast<double>(time_ns); }

TEST(ExportedRuns, TellWhatTheyHold) {
  const ShortExport& made = short_export();
  std::set<std::string> names;
  for (const auto& [topic, messages] : made.topics) names.insert(topic);
  EXPECT_EQ(names, (std::set<std::string>{"/camera", "/camera/calibration", "/camera/tf", "/cloud",
                                          "/map/occupied", "/overview", "/plan", "/pose",
                                          "/pose_estimated", "/steps", "/tf", "/views"}));
  EXPECT_EQ(made.exported.channels, 12U);
  EXPECT_EQ(made.exported.messages, made.file->messages.size());
  EXPECT_EQ(made.exported.end_s, made.end_s());
  EXPECT_TRUE(std::ranges::is_sorted(made.file->messages, {}, &test::McapMessage::time_ns));
  const auto manifest = ExportJson::parse(read_file(made.folder / "run/manifest.json"));
  const auto& entries = made.file->metadata.at("vantage");
  EXPECT_EQ(entries.at("seed"), manifest["seed"].dump());
  EXPECT_EQ(entries.at("status"), manifest["status"].get<std::string>());
  EXPECT_FALSE(entries.contains("assets"));
}

TEST(ExportedRuns, HaveThePosesOfTheTrajectories) {
  const ShortExport& made = short_export();
  for (const auto& [topic, name] : {std::pair{"/pose", "run/trajectory.tum"},
                                    {"/pose_estimated", "run/trajectory_estimated.tum"}}) {
    const auto rows = read_tum(made.folder / name);
    const auto& messages = made.topics.at(topic);
    ASSERT_EQ(messages.size(), rows.size()) << topic;
    for (const std::size_t i : {std::size_t{0}, rows.size() / 2, rows.size() - 1}) {
      EXPECT_EQ(messages[i].time_ns, nanoseconds(rows[i].time_s));
      const ExportJson& p = messages[i].json["pose"]["position"];
      EXPECT_NEAR(p["x"].get<double>(), rows[i].p_world_m.x(), 1e-9);
      EXPECT_NEAR(p["y"].get<double>(), rows[i].p_world_m.y(), 1e-9);
      const ExportJson& q = messages[i].json["pose"]["orientation"];
      EXPECT_NEAR(std::abs(q["z"].get<double>()), std::abs(rows[i].q_world_body.z()), 1e-5);
    }
  }
}

TEST(ExportedRuns, HaveTheFramesOfTheRobotTenTimesASecond) {
  const ShortExport& made = short_export();
  const auto& frames = made.topics.at("/tf");
  EXPECT_EQ(frames.front().time_ns, 0U);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_NEAR(seconds_of(frames[i].time_ns), 0.1 * static_cast<double>(i), 0.0251);
  }
  EXPECT_NEAR(static_cast<double>(frames.size()), 10.0 * made.end_s(), 2.0);
  const ExportJson& bodies = frames[10].json["transforms"];
  ASSERT_GT(bodies.size(), 1U);
  for (const auto& body : bodies) {
    EXPECT_TRUE(body["child_frame_id"].get<std::string>().starts_with("robot/"));
  }
}

TEST(ExportedRuns, HaveImagesAsOftenAsAsked) {
  const ShortExport& made = short_export();
  const auto shots = static_cast<std::size_t>(std::floor(made.end_s() / 4.0 + 1e-6)) + 1;
  for (const char* topic : {"/camera", "/overview", "/camera/tf", "/camera/calibration"}) {
    const auto& messages = made.topics.at(topic);
    ASSERT_EQ(messages.size(), shots) << topic;
    for (std::size_t i = 0; i < shots; ++i) {
      EXPECT_NEAR(seconds_of(messages[i].time_ns), 4.0 * static_cast<double>(i), 0.0251);
    }
  }
  const ExportJson& camera = made.topics.at("/camera/calibration").front().json;
  EXPECT_EQ(camera["width"], 64);
  EXPECT_EQ(camera["height"], 48);
  EXPECT_EQ(made.topics.at("/camera")[0].json["frame_id"], "camera");
  EXPECT_EQ(made.topics.at("/overview")[0].json["frame_id"], "world");
}

/// The cells that are told to be occupied up to each scan.
TEST(ExportedRuns, HaveTheMapAfterEachScan) {
  const ShortExport& made = short_export();
  const auto& clouds = made.topics.at("/map/occupied");
  std::vector<CellState> known(made.frame.size(), CellState::unobserved);
  std::size_t scans = 0;
  for (const EpisodeEvent& event : made.events) {
    const auto* change = std::get_if<MapChange>(&event.what);
    if (change == nullptr) continue;
    for (const CellRun& run : change->runs) {
      std::fill_n(known.begin() + run.first, run.count, run.state);
    }
    std::vector<Eigen::Vector3f> centres;
    for (std::size_t cell = 0; cell < known.size(); ++cell) {
      if (known[cell] != CellState::occupied) continue;
      centres.emplace_back(made.frame.centre(made.frame.cell(cell)).cast<float>());
    }
    ASSERT_LT(scans, clouds.size());
    EXPECT_GT(centres.size(), 10U);
    EXPECT_EQ(clouds[scans].time_ns, made.time_ns(event.tick));
    EXPECT_EQ(clouds[scans].json["data"], point_cloud(0.0, centres)["data"]);
    ++scans;
  }
  EXPECT_EQ(scans, 3U);
  EXPECT_EQ(clouds.size(), scans);
  ASSERT_EQ(made.topics.at("/cloud").size(), 1U);
  EXPECT_EQ(made.topics.at("/cloud")[0].time_ns, nanoseconds(made.end_s()));
}

TEST(ExportedRuns, HaveTheViewsOfEachDecision) {
  const ShortExport& made = short_export();
  const auto& views = made.topics.at("/views");
  std::size_t decisions = 0;
  for (const EpisodeEvent& event : made.events) {
    const auto* decision = std::get_if<Decision>(&event.what);
    if (decision == nullptr) continue;
    ASSERT_LT(decisions, views.size());
    EXPECT_EQ(views[decisions].time_ns, made.time_ns(event.tick));
    const ExportJson& entities = views[decisions].json["entities"];
    ASSERT_EQ(entities.size(), 2U);
    ASSERT_EQ(entities[0]["arrows"].size(), decision->candidates.size());
    double most = 0.0;
    for (const Candidate& view : decision->candidates) most = std::max(most, view.gain_bits);
    ASSERT_GT(most, 0.0);
    for (std::size_t i = 0; i < decision->candidates.size(); ++i) {
      const Candidate& view = decision->candidates[i];
      const ExportJson& arrow = entities[0]["arrows"][i];
      EXPECT_NEAR(arrow["shaft_length"].get<double>(), 0.7 * 0.25, 1e-12);
      const double share = view.gain_bits / most;
      const ExportJson& colour = arrow["color"];
      EXPECT_NEAR(colour["r"].get<double>(), view.reachable ? share : 0.5, 1e-12);
      EXPECT_NEAR(colour["g"].get<double>(), view.reachable ? 0.25 + 0.6 * share : 0.5, 1e-12);
      EXPECT_NEAR(colour["b"].get<double>(), view.reachable ? 0.9 - 0.9 * share : 0.5, 1e-12);
      EXPECT_NEAR(colour["a"].get<double>(), view.reachable ? 0.9 : 0.35, 1e-12);
    }
    const Candidate& chosen = decision->candidates.at(decision->chosen);
    ASSERT_EQ(entities[1]["arrows"].size(), 1U);
    EXPECT_NEAR(entities[1]["arrows"][0]["shaft_length"].get<double>(), 0.7 * 0.45, 1e-12);
    EXPECT_NEAR(entities[1]["arrows"][0]["pose"]["position"]["x"].get<double>(),
                chosen.T_world_sensor.translation().x(), 1e-9);
    EXPECT_EQ(entities[1]["metadata"][0]["value"], std::to_string(chosen.id));
    ++decisions;
  }
  EXPECT_EQ(decisions, 2U);
  EXPECT_EQ(views.size(), decisions);
}

TEST(ExportedRuns, HaveTheWayThatWasPlanned) {
  const ShortExport& made = short_export();
  const auto& plans = made.topics.at("/plan");
  std::size_t next = 0;
  for (const EpisodeEvent& event : made.events) {
    const auto* route = std::get_if<PlannedRoute>(&event.what);
    if (route == nullptr && !std::holds_alternative<Decision>(event.what)) continue;
    ASSERT_LT(next, plans.size());
    const ExportJson& plan = plans[next].json;
    EXPECT_EQ(plans[next++].time_ns, made.time_ns(event.tick));
    if (route == nullptr || route->path_m.empty()) {
      EXPECT_EQ(plan["entities"].size(), 0U) << "no way yet";
      EXPECT_EQ(plan["deletions"][0]["id"], "plan");
      continue;
    }
    const ExportJson& points = plan["entities"][0]["lines"][0]["points"];
    ASSERT_EQ(points.size(), route->path_m.size());
    EXPECT_EQ(points.back()["x"], route->path_m.back().x());
    EXPECT_EQ(points.back()["y"], route->path_m.back().y());
    EXPECT_EQ(points.back()["z"], 0.02);
  }
  EXPECT_EQ(next, plans.size());
  EXPECT_GE(next, 4U);
}

TEST(ExportedRuns, HaveTheRowsOfTheSteps) {
  const ShortExport& made = short_export();
  const CsvTable rows = read_csv(made.folder / "run/steps.csv");
  const auto& steps = made.topics.at("/steps");
  ASSERT_EQ(steps.size(), rows.rows.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    ASSERT_EQ(steps[i].json.size(), rows.columns.size());
    for (std::size_t column = 0; column < rows.columns.size(); ++column) {
      const std::string& field = rows.rows[i][column];
      const ExportJson& value = steps[i].json[rows.columns[column]];
      if (rows.columns[column] == "time_s") {
        EXPECT_EQ(steps[i].time_ns, nanoseconds(std::stod(field)));
      }
      if (field.empty()) {
        EXPECT_TRUE(value.is_null());
      } else if (field == "true" || field == "false") {
        EXPECT_EQ(value, field == "true");
      } else if (value.is_number()) {
        EXPECT_EQ(value.get<double>(), std::stod(field));
      } else {
        EXPECT_EQ(value, field);
      }
    }
  }
}

TEST(ExportedRuns, WithoutImagesHaveNone) {
  const ShortExport& made = short_export();
  const ExportedRun plain = export_run(made.folder / "run", made.folder / "plain.mcap",
                                       {.image_period_s = 0.0, .image_height_px = 48});
  EXPECT_EQ(plain.channels, 8U);
  EXPECT_EQ(ExportOptions{}.image_period_s, 1.0);
  EXPECT_EQ(ExportOptions{}.image_height_px, 240);
}

/// The short run once more, for what it holds to be changed.
class CopyOfTheRun {
 public:
  CopyOfTheRun() {
    std::filesystem::copy(short_export().folder / "run", run(),
                          std::filesystem::copy_options::recursive);
  }
  [[nodiscard]] std::filesystem::path run() const { return folder_ / "run"; }
  [[nodiscard]] test::McapFile exported(double image_period_s = 0.0) const {
    export_run(run(), folder_ / "run.mcap",
               {.image_period_s = image_period_s, .image_height_px = 48});
    return test::McapFile(read_file(folder_ / "run.mcap"));
  }

 private:
  support::TemporaryDirectory folder_;
};

TEST(ExportedRuns, HaveFlightsAndDecisionsForNoView) {
  Decision for_none;
  for (const double gain : {2.0, -1.0, 0.5}) {
    for_none.candidates.emplace_back().gain_bits = gain;
  }
  for_none.chosen = for_none.candidates.size();
  Decision worthless;
  for (const double gain : {0.0, -1.5}) worthless.candidates.emplace_back().gain_bits = gain;
  worthless.chosen = 1;
  const CopyOfTheRun copy;
  EventLog story(copy.run());
  story.add({0, for_none});
  story.add({40, PlannedFlight{{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}}}});
  story.add({80, worthless});
  story.commit();
  const TopicMessages topics = topics_of(copy.exported());
  const auto& views = topics.at("/views");
  ASSERT_EQ(views.size(), 2U);
  const auto reds = [&](std::size_t decision) {
    std::vector<double> found;
    for (const auto& arrow : views[decision].json["entities"][0]["arrows"]) {
      found.push_back(arrow["color"]["r"]);
    }
    return found;
  };
  EXPECT_EQ(reds(0), (std::vector<double>{1.0, 0.0, 0.25}));
  EXPECT_EQ(reds(1), (std::vector<double>{0.0, 0.0}));
  const ExportJson& none = views[0].json["entities"][1];
  EXPECT_TRUE(none["arrows"].empty() && none["metadata"].empty());
  EXPECT_EQ(
      views[1].json["entities"][1]["metadata"],
      ExportJson::parse(R"([{"key": "id", "value": "1"}, {"key": "gain", "value": "-1.5"}])"));
  const auto& plans = topics.at("/plan");
  ASSERT_EQ(plans.size(), 3U);
  for (const std::size_t i : {0U, 2U}) EXPECT_EQ(plans[i].json["deletions"].size(), 1U) << i;
  EXPECT_EQ(plans[1].time_ns, short_export().time_ns(40));
  EXPECT_EQ(plans[1].json["entities"][0]["lines"][0]["points"],
            ExportJson::parse(R"([{"x": 1, "y": 2, "z": 3}, {"x": 4, "y": 5, "z": 6}])"));
}

TEST(ExportedRuns, HaveThoseRowsOfTheStepsThatSayWhen) {
  const CopyOfTheRun copy;
  write_file(copy.run() / "steps.csv",
             "scan,time_s,view,good,way_m\n"
             "1,0.5,near,true,0.25\n"
             "2,,far,false,\n"
             "3,2.5,7,,inf\n"
             "4,later,,true,1e3\n");
  const test::McapFile file = copy.exported();
  const auto rows = topics_of(file).at("/steps");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].time_ns, 500'000'000U);
  EXPECT_EQ(rows[0].json, ExportJson::parse(R"({"scan": 1, "time_s": 0.5, "view": "near",
    "good": true, "way_m": 0.25})"));
  EXPECT_EQ(rows[1].time_ns, 2'500'000'000U);
  EXPECT_EQ(rows[1].json, ExportJson::parse(R"({"scan": 3, "time_s": 2.5, "view": 7,
    "good": null, "way_m": null})"));
  const auto schema = std::ranges::find_if(
      file.schemas, [](const auto& one) { return one.second.first == "vantage.Step"; });
  ASSERT_NE(schema, file.schemas.end());
  EXPECT_EQ(ExportJson::parse(schema->second.second), ExportJson::parse(R"({
    "title": "vantage.Step", "type": "object", "properties": {
      "scan": {"type": ["number", "null"]},
      "time_s": {"type": ["number", "boolean", "string", "null"]},
      "view": {"type": ["number", "boolean", "string", "null"]},
      "good": {"type": ["number", "boolean", "string", "null"]},
      "way_m": {"type": ["number", "null"]}}})"));
  write_file(copy.run() / "steps.csv", "scan\n1\n");
  for (const auto& [id, channel] : copy.exported().channels) EXPECT_NE(channel.first, "/steps");
}

/// What somebody moves is in no state that was recorded.
TEST(ExportedRuns, ShowWhatAFaultHasMovedFromThenOn) {
  const CopyOfTheRun copy;
  ConfigNode config = read_yaml(copy.run() / "config.yaml");
  apply_overrides(config, {"faults.moved_object_m=1", "faults.moved_object_at_s=5"});
  write_file(copy.run() / "config.yaml", to_yaml(config));
  const auto moved = topics_of(copy.exported(4.0)).at("/overview");
  const auto& before = short_export().topics.at("/overview");
  ASSERT_EQ(moved.size(), before.size());
  ASSERT_GE(moved.size(), 3U);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    EXPECT_EQ(moved[i].json["data"] == before[i].json["data"], i < 2) << 4 * i << " s";
  }
}

/// It drives 1.5 cm and turns by 0.02 rad at most from a state to the next.
TEST(ExportedRuns, HaveTheBaseWhereItsPoseIs) {
  const ShortExport& made = short_export();
  const auto& poses = made.topics.at("/pose");
  std::size_t compared = 0;
  double most_turned = 0.0;
  for (const TimedJson& frames : made.topics.at("/tf")) {
    const auto after = std::ranges::lower_bound(poses, frames.time_ns, {}, &TimedJson::time_ns);
    if (after == poses.end() || seconds_of(after->time_ns - frames.time_ns) > 0.03) continue;
    const ExportJson& base = frames.json["transforms"][0];
    ASSERT_EQ(base["child_frame_id"], "robot/base");
    const ExportJson& pose = after->json["pose"];
    for (const char* axis : {"x", "y"}) {
      EXPECT_NEAR(base["translation"][axis].get<double>(), pose["position"][axis].get<double>(),
                  0.016);
    }
    const double turned = std::abs(base["rotation"]["z"].get<double>());
    EXPECT_NEAR(turned, std::abs(pose["orientation"]["z"].get<double>()), 0.011);
    most_turned = std::max(most_turned, turned);
    ++compared;
  }
  EXPECT_GT(compared, made.topics.at("/tf").size() / 2);
  EXPECT_GT(most_turned, 0.5) << "it did not keep the heading that it began with";
}

/// However small the most is, it is the most; what comes after the last state is at its time.
TEST(ExportedRuns, ColourViewsByTheirShareOfTheMost) {
  Decision decision;
  for (const double gain : {0.5, 0.125, 0.25}) {
    decision.candidates.emplace_back().gain_bits = gain;
  }
  decision.candidates[2].reachable = false;
  decision.chosen = 0;
  const CopyOfTheRun copy;
  EventLog story(copy.run());
  story.add({0, decision});
  story.add({40, PlannedFlight{{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}}}});
  story.add({1'000'000, decision});
  story.commit();
  const TopicMessages topics = topics_of(copy.exported(1.0));
  const ExportJson& entities = topics.at("/views").at(0).json["entities"];
  ASSERT_EQ(entities[0]["arrows"].size(), 3U);
  EXPECT_EQ(entities[0]["arrows"][0]["color"]["r"], 1.0);
  EXPECT_EQ(entities[0]["arrows"][1]["color"]["r"], 0.25);
  EXPECT_EQ(entities[0]["arrows"][2]["color"],
            ExportJson::parse(R"({"r": 0.5, "g": 0.5, "b": 0.5, "a": 0.35})"));
  EXPECT_EQ(entities[1]["arrows"][0]["color"],
            ExportJson::parse(R"({"r": 0.95, "g": 0.2, "b": 0.15, "a": 1.0})"));
  EXPECT_EQ(topics.at("/plan").at(1).json["entities"][0]["lines"][0]["color"],
            ExportJson::parse(R"({"r": 0.1, "g": 0.75, "b": 0.3, "a": 1.0})"));
  EXPECT_EQ(topics.at("/views").at(1).time_ns, nanoseconds(short_export().end_s()));
  EXPECT_GT(topics.at("/overview").size(), short_export().topics.at("/overview").size());
}

TEST(ExportedRuns, HaveNothingOfFilesThatAreNotThere) {
  const CopyOfTheRun copy;
  for (const char* name : {"cloud.ply", "steps.csv", "trajectory_estimated.tum", "story.bin"}) {
    EXPECT_TRUE(std::filesystem::remove(copy.run() / name)) << name;
  }
  std::set<std::string> names;
  for (const auto& [topic, messages] : topics_of(copy.exported())) names.insert(topic);
  EXPECT_EQ(names, (std::set<std::string>{"/pose", "/tf"}));
}

}  // namespace
}  // namespace vantage
