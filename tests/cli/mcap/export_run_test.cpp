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

/// Three scans of a table top, exported with an image every four seconds.
struct ShortExport {
  support::TemporaryDirectory folder;
  ExportedRun exported;
  std::unique_ptr<test::McapFile> file;
  std::map<std::string, std::vector<TimedJson>> topics;
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
    for (const test::McapMessage& message : file->messages) {
      topics[file->channels.at(message.channel).first].push_back(
          {message.time_ns, ExportJson::parse(message.text)});
    }
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

}  // namespace
}  // namespace vantage
