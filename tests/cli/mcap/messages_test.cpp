// Messages, their schemas, and the order in which they come.
#include "vantage/mcap/messages.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include "vantage/mcap/timeline.hpp"

namespace vantage {
namespace {

using MessageJson = nlohmann::ordered_json;

const MessageJson kTime = MessageJson::parse(R"({"sec": 12, "nsec": 250000000})");
const MessageJson kNoTurn = MessageJson::parse(R"({"position": {"x": 0, "y": 0, "z": 0},
                           "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}})");

bool names(const MessageJson& list, const std::string& name) {
  return std::any_of(list.begin(), list.end(),
                     [&](const MessageJson& item) { return item.get<std::string>() == name; });
}

/// As much of JSON schemas as ours have.
void expect_valid(const MessageJson& value, const MessageJson& schema, const std::string& at) {
  const std::string type = schema.at("type");
  const bool fits =
      (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
      (type == "string" && value.is_string()) || (type == "boolean" && value.is_boolean()) ||
      (type == "number" && value.is_number()) || (type == "integer" && value.is_number_integer());
  ASSERT_TRUE(fits) << at << ": " << type;
  if (schema.contains("minimum")) {
    EXPECT_GE(value, schema["minimum"]) << at;
  }
  if (schema.contains("maximum")) {
    EXPECT_LE(value, schema["maximum"]) << at;
  }
  if (schema.contains("minItems")) {
    EXPECT_EQ(value.size(), schema["minItems"]) << at;
    EXPECT_EQ(value.size(), schema["maxItems"]) << at;
  }
  if (type == "array") {
    for (const auto& item : value) expect_valid(item, schema.at("items"), at + "[]");
  }
  if (type != "object" || !schema.contains("properties")) return;
  ASSERT_EQ(schema["required"].size(), schema["properties"].size()) << at;
  EXPECT_EQ(value.size(), schema["properties"].size()) << at;
  for (const auto& [name, property] : schema["properties"].items()) {
    ASSERT_TRUE(value.contains(name)) << at << "." << name;
    EXPECT_TRUE(names(schema["required"], name)) << at << "." << name;
    expect_valid(value[name], property, fmt::format("{}.{}", at, name));
  }
}

TEST(McapMessages, TimesAreWholeNanoseconds) {
  EXPECT_EQ(nanoseconds(1.5), 1'500'000'000U);
  EXPECT_EQ(nanoseconds(0.1234567894), 123'456'789U);
  EXPECT_EQ(nanoseconds(0.1234567896), 123'456'790U);
  EXPECT_EQ(nanoseconds(-1.0), 0U);
}

TEST(McapMessages, OfPosesAndFrames) {
  const Pose turned = make_pose({1.0, 2.0, 3.0}, 0.6);
  const MessageJson pose = pose_in_frame(12.25, turned);
  EXPECT_EQ(pose["timestamp"], kTime);
  EXPECT_EQ(pose["frame_id"], "world");
  EXPECT_EQ(pose["pose"]["position"], MessageJson::parse(R"({"x": 1, "y": 2, "z": 3})"));
  EXPECT_NEAR(pose["pose"]["orientation"]["z"].get<double>(), std::sin(0.3), 1e-12);
  EXPECT_NEAR(pose["pose"]["orientation"]["w"].get<double>(), std::cos(0.3), 1e-12);
  const MessageJson frames =
      frame_transforms(12.25, {{"base", turned}, {"head", make_pose({4.0, 5.0, 6.0}, 0.0)}});
  ASSERT_EQ(frames["transforms"].size(), 2U);
  const MessageJson& head = frames["transforms"][1];
  EXPECT_EQ(head["timestamp"], kTime);
  EXPECT_EQ(head["parent_frame_id"], "world");
  EXPECT_EQ(head["child_frame_id"], "head");
  EXPECT_EQ(head["translation"], MessageJson::parse(R"({"x": 4, "y": 5, "z": 6})"));
  EXPECT_EQ(head["rotation"], kNoTurn["orientation"]);
  expect_valid(pose, foxglove_schema("PoseInFrame"), "pose");
  expect_valid(frames, foxglove_schema("FrameTransforms"), "frames");
}

TEST(McapMessages, OfPointsAndImages) {
  const std::vector<Eigen::Vector3f> points{{1.0F, 2.0F, 3.0F}, {4.0F, 5.5F, -6.0F}};
  const MessageJson cloud = point_cloud(12.25, points);
  EXPECT_EQ(cloud, MessageJson::parse(R"({
    "timestamp": {"sec": 12, "nsec": 250000000}, "frame_id": "world",
    "pose": {"position": {"x": 0, "y": 0, "z": 0},
             "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}},
    "point_stride": 12,
    "fields": [{"name": "x", "offset": 0, "type": 7}, {"name": "y", "offset": 4, "type": 7},
               {"name": "z", "offset": 8, "type": 7}],
    "data": "AACAPwAAAEAAAEBAAACAQAAAsEAAAMDA"})"));
  const MessageJson image = compressed_image(12.25, "camera", "abc");
  EXPECT_EQ(image, MessageJson::parse(R"({"timestamp": {"sec": 12, "nsec": 250000000},
    "frame_id": "camera", "data": "YWJj", "format": "png"})"));
  expect_valid(cloud, foxglove_schema("PointCloud"), "cloud");
  expect_valid(image, foxglove_schema("CompressedImage"), "image");
}

TEST(McapMessages, OfACamera) {
  const MessageJson camera = camera_calibration(12.25, "camera", 320, 240, 277.5);
  EXPECT_EQ(camera["timestamp"], kTime);
  EXPECT_EQ(camera["width"], 320);
  EXPECT_EQ(camera["height"], 240);
  const MessageJson& K = camera["K"];
  const MessageJson& P = camera["P"];
  EXPECT_EQ(K, (MessageJson{277.5, 0, 159.5, 0, 277.5, 119.5, 0, 0, 1}));
  EXPECT_EQ(P, (MessageJson{277.5, 0, 159.5, 0, 0, 277.5, 119.5, 0, 0, 0, 1, 0}));
  EXPECT_EQ(camera["R"], (MessageJson{1, 0, 0, 0, 1, 0, 0, 0, 1}));
  expect_valid(camera, foxglove_schema("CameraCalibration"), "camera");
}

TEST(McapMessages, OfArrowsAndLines) {
  const SceneEntity entity{.id = "views",
                           .arrows = {{Pose::Identity(), 2.0, {0.1, 0.2, 0.3, 0.4}}},
                           .path_m = {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}},
                           .path_colour = {0.5, 0.6, 0.7, 0.8},
                           .metadata = {{"id", "7"}}};
  const MessageJson update = scene_update(12.25, {entity, {.id = "bare"}}, {"old"});
  EXPECT_EQ(update["deletions"], MessageJson::parse(R"([{"timestamp": {"sec": 12,
    "nsec": 250000000}, "type": 0, "id": "old"}])"));
  ASSERT_EQ(update["entities"].size(), 2U);
  const MessageJson& views = update["entities"][0];
  EXPECT_EQ(views["timestamp"], kTime);
  EXPECT_EQ(views["id"], "views");
  EXPECT_EQ(views["lifetime"], MessageJson::parse(R"({"sec": 0, "nsec": 0})"));
  EXPECT_EQ(views["frame_locked"], false);
  EXPECT_EQ(views["metadata"], MessageJson::parse(R"([{"key": "id", "value": "7"}])"));
  ASSERT_EQ(views["arrows"].size(), 1U);
  const MessageJson& arrow = views["arrows"][0];
  EXPECT_EQ(arrow["pose"], kNoTurn);
  EXPECT_NEAR(arrow["shaft_length"].get<double>(), 1.4, 1e-12);
  EXPECT_NEAR(arrow["shaft_diameter"].get<double>(), 0.2, 1e-12);
  EXPECT_NEAR(arrow["head_length"].get<double>(), 0.6, 1e-12);
  EXPECT_NEAR(arrow["head_diameter"].get<double>(), 0.5, 1e-12);
  EXPECT_EQ(arrow["color"], MessageJson::parse(R"({"r": 0.1, "g": 0.2, "b": 0.3, "a": 0.4})"));
  EXPECT_EQ(views["lines"], MessageJson::parse(R"([{"type": 0,
    "pose": {"position": {"x": 0, "y": 0, "z": 0},
             "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}},
    "thickness": 0.03, "scale_invariant": false,
    "points": [{"x": 1, "y": 2, "z": 3}, {"x": 4, "y": 5, "z": 6}],
    "color": {"r": 0.5, "g": 0.6, "b": 0.7, "a": 0.8}, "colors": [], "indices": []}])"));
  const MessageJson& bare = update["entities"][1];
  for (const char* kind : {"arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts",
                           "models", "metadata"}) {
    EXPECT_EQ(bare[kind], MessageJson::array()) << kind;
  }
  expect_valid(update, foxglove_schema("SceneUpdate"), "update");
}

TEST(McapMessages, HaveSchemasThatBoundWhatIsCounted) {
  for (const char* name : {"FrameTransforms", "PoseInFrame", "PointCloud", "CompressedImage",
                           "CameraCalibration", "SceneUpdate"}) {
    const MessageJson schema = foxglove_schema(name);
    EXPECT_EQ(schema["title"], "foxglove." + std::string(name));
    EXPECT_EQ(schema["type"], "object");
    EXPECT_EQ(schema["required"].size(), schema["properties"].size());
  }
  const MessageJson camera = foxglove_schema("CameraCalibration")["properties"];
  for (const auto& [key, count] : {std::pair{"K", 9}, {"R", 9}, {"P", 12}}) {
    EXPECT_EQ(camera[key]["minItems"], count);
    EXPECT_EQ(camera[key]["maxItems"], count);
  }
  EXPECT_EQ(camera["width"], MessageJson::parse(R"({"type": "integer", "minimum": 0})"));
  EXPECT_EQ(camera["timestamp"], MessageJson::parse(R"({"title": "time", "type": "object",
    "properties": {"sec": {"type": "integer", "minimum": 0},
                   "nsec": {"type": "integer", "minimum": 0, "maximum": 999999999}},
    "required": ["sec", "nsec"]})"));
  const MessageJson cloud = foxglove_schema("PointCloud")["properties"];
  EXPECT_EQ(cloud["fields"]["items"]["properties"]["type"],
            MessageJson::parse(R"({"type": "integer", "minimum": 0, "maximum": 8})"));
  EXPECT_EQ(cloud["data"], MessageJson::parse(R"({"type": "string",
    "contentEncoding": "base64"})"));
  const MessageJson scene = foxglove_schema("SceneUpdate")["properties"];
  EXPECT_EQ(scene["entities"]["items"]["properties"].size(), 14U);
  EXPECT_EQ(scene["deletions"]["items"]["title"], "foxglove.SceneEntityDeletion");
}

TEST(Timeline, ComesInTheOrderOfTimesAndThenAsItWasAdded) {
  Timeline timeline;
  EXPECT_EQ(timeline.add_stream("/pose", "PoseInFrame"), 0U);
  EXPECT_EQ(timeline.add_stream("/cloud", "PointCloud"), 1U);
  EXPECT_EQ(timeline.streams[1].topic, "/cloud");
  EXPECT_EQ(timeline.streams[1].schema_name, "foxglove.PointCloud");
  EXPECT_EQ(MessageJson::parse(timeline.streams[1].schema), foxglove_schema("PointCloud"));
  const auto telling = [](int number) { return [number] { return MessageJson(number); }; };
  timeline.add(0, 2.0, telling(1));
  timeline.add(1, 1.0, telling(2));
  timeline.add(0, 1.0, telling(3));
  timeline.add(1, 0.5, telling(4));
  timeline.sort();
  std::vector<int> told;
  for (const TimedMessage& message : timeline.messages) told.push_back(message.make().get<int>());
  EXPECT_EQ(told, (std::vector<int>{4, 2, 3, 1}));
  EXPECT_EQ(timeline.messages[0].time_ns, 500'000'000U);
  EXPECT_EQ(timeline.messages[1].stream, 1U);
  EXPECT_EQ(timeline.messages[2].stream, 0U);
}

}  // namespace
}  // namespace vantage
