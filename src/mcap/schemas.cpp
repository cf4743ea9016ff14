// The parts of Foxglove's well-known schemas that our messages have; readers know them by their
// titles.
#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

#include "vantage/core/error.hpp"
#include "vantage/mcap/messages.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;
using Properties = std::vector<std::pair<const char*, Json>>;

/// All that it has is required.
Json object(const std::string& title, const Properties& properties) {
  Json schema{{"title", title}, {"type", "object"}, {"properties", Json::object()}};
  for (const auto& [name, property] : properties) {
    schema["properties"][name] = property;
    schema["required"].push_back(name);
  }
  return schema;
}

Json foxglove(const char* name, const Properties& properties) {
  return object(std::string("foxglove.") + name, properties);
}

Json type(const char* name) { return {{"type", name}}; }
Json number() { return type("number"); }
Json text() { return type("string"); }
Json base64_bytes() { return {{"type", "string"}, {"contentEncoding", "base64"}}; }
Json natural() { return {{"type", "integer"}, {"minimum", 0}}; }
Json list(const Json& items) { return {{"type", "array"}, {"items", items}}; }
Json numbers(int count) {
  return {{"type", "array"}, {"items", number()}, {"minItems", count}, {"maxItems", count}};
}

Json clock(const char* title) {
  Json nsec = natural();
  nsec["maximum"] = 999'999'999;
  return object(title, {{"sec", natural()}, {"nsec", nsec}});
}
Json time() { return clock("time"); }

Json vector3() { return foxglove("Vector3", {{"x", number()}, {"y", number()}, {"z", number()}}); }
Json point3() { return foxglove("Point3", {{"x", number()}, {"y", number()}, {"z", number()}}); }
Json quaternion() {
  return foxglove("Quaternion",
                  {{"x", number()}, {"y", number()}, {"z", number()}, {"w", number()}});
}
Json pose() { return foxglove("Pose", {{"position", vector3()}, {"orientation", quaternion()}}); }
Json colour() {
  return foxglove("Color", {{"r", number()}, {"g", number()}, {"b", number()}, {"a", number()}});
}

Json transforms() {
  return foxglove("FrameTransforms",
                  {{"transforms", list(foxglove("FrameTransform", {{"timestamp", time()},
                                                                   {"parent_frame_id", text()},
                                                                   {"child_frame_id", text()},
                                                                   {"translation", vector3()},
                                                                   {"rotation", quaternion()}}))}});
}

Json cloud() {
  Json kind = natural();
  kind["maximum"] = 8;
  const Json field =
      foxglove("PackedElementField", {{"name", text()}, {"offset", natural()}, {"type", kind}});
  return foxglove("PointCloud", {{"timestamp", time()},
                                 {"frame_id", text()},
                                 {"pose", pose()},
                                 {"point_stride", natural()},
                                 {"fields", list(field)},
                                 {"data", base64_bytes()}});
}

Json calibration() {
  return foxglove("CameraCalibration", {{"timestamp", time()},
                                        {"frame_id", text()},
                                        {"width", natural()},
                                        {"height", natural()},
                                        {"distortion_model", text()},
                                        {"D", list(number())},
                                        {"K", numbers(9)},
                                        {"R", numbers(9)},
                                        {"P", numbers(12)}});
}

Json arrow() {
  return foxglove("ArrowPrimitive", {{"pose", pose()},
                                     {"shaft_length", number()},
                                     {"shaft_diameter", number()},
                                     {"head_length", number()},
                                     {"head_diameter", number()},
                                     {"color", colour()}});
}

Json line() {
  return foxglove("LinePrimitive", {{"type", natural()},
                                    {"pose", pose()},
                                    {"thickness", number()},
                                    {"scale_invariant", type("boolean")},
                                    {"points", list(point3())},
                                    {"color", colour()},
                                    {"colors", list(colour())},
                                    {"indices", list(natural())}});
}

Json scene() {
  const Json pair = foxglove("KeyValuePair", {{"key", text()}, {"value", text()}});
  Properties entity{{"timestamp", time()},
                    {"frame_id", text()},
                    {"id", text()},
                    {"lifetime", clock("duration")},
                    {"frame_locked", type("boolean")},
                    {"metadata", list(pair)},
                    {"arrows", list(arrow())},
                    {"lines", list(line())}};
  for (const char* unused : {"cubes", "spheres", "cylinders", "triangles", "texts", "models"}) {
    entity.emplace_back(unused, list(type("object")));
  }
  const Json deletion =
      foxglove("SceneEntityDeletion", {{"timestamp", time()}, {"type", natural()}, {"id", text()}});
  return foxglove("SceneUpdate", {{"deletions", list(deletion)},
                                  {"entities", list(foxglove("SceneEntity", entity))}});
}

}  // namespace

Json foxglove_schema(std::string_view name) {
  if (name == "FrameTransforms") return transforms();
  if (name == "PoseInFrame") {
    return foxglove("PoseInFrame", {{"timestamp", time()}, {"frame_id", text()}, {"pose", pose()}});
  }
  if (name == "PointCloud") return cloud();
  if (name == "CompressedImage") {
    return foxglove("CompressedImage", {{"timestamp", time()},
                                        {"frame_id", text()},
                                        {"data", base64_bytes()},
                                        {"format", text()}});
  }
  if (name == "CameraCalibration") return calibration();
  expects(name == "SceneUpdate", "a schema that is known here");
  return scene();
}

}  // namespace vantage
