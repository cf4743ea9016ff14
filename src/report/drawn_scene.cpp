#include "vantage/report/drawn_scene.hpp"

#include <span>
#include <string>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/bytes.hpp"

namespace vantage {
namespace {

constexpr std::string_view kSceneMagic = "VTGSCN01";
constexpr std::size_t kVertexBytes = 16;
constexpr std::size_t kTriangleBytes = 12;

DrawnScene::Triangle take_triangle(ByteReader& reader, std::size_t vertices) {
  DrawnScene::Triangle triangle{};
  for (std::uint32_t& index : triangle) {
    index = reader.number<std::uint32_t>("a triangle");
    reader.require(index < vertices, "a triangle has a vertex that is not there");
  }
  return triangle;
}

}  // namespace

void write_drawn_scene(const std::filesystem::path& path, const DrawnScene& scene) {
  std::string bytes(kSceneMagic);
  for (const Eigen::Vector3f& corner : {scene.extent_m.min(), scene.extent_m.max()}) {
    for (int axis = 0; axis < 3; ++axis) put(bytes, corner[axis]);
  }
  put(bytes, static_cast<std::uint64_t>(scene.vertices_m.size()));
  for (const auto& part : scene.triangles) put(bytes, static_cast<std::uint64_t>(part.size()));
  for (std::size_t i = 0; i < scene.vertices_m.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) put(bytes, scene.vertices_m[i][axis]);
    for (const std::uint8_t value : scene.colours[i]) put(bytes, value);
    put(bytes, std::uint8_t{0});
  }
  for (const auto& part : scene.triangles) {
    for (const DrawnScene::Triangle& triangle : part) {
      for (const std::uint32_t index : triangle) put(bytes, index);
    }
  }
  write_file(path, bytes);
}

DrawnScene read_drawn_scene(const std::filesystem::path& path) {
  const std::string content = read_file(path);
  ByteReader reader(content, path.string() + ": not the scene of a run");
  reader.require(content.starts_with(kSceneMagic), "bad header");
  reader.block(kSceneMagic.size(), "the header");
  DrawnScene scene;
  for (Eigen::Vector3f* corner : {&scene.extent_m.min(), &scene.extent_m.max()}) {
    for (int axis = 0; axis < 3; ++axis) (*corner)[axis] = reader.number<float>("the extent");
  }
  const auto vertices = reader.number<std::uint64_t>("the header");
  std::array<std::uint64_t, DrawnScene::kParts> triangles{};
  for (std::uint64_t& count : triangles) count = reader.number<std::uint64_t>("the header");
  reader.require_items(vertices, kVertexBytes, "the vertices");
  for (std::uint64_t i = 0; i < vertices; ++i) {
    Eigen::Vector3f& p = scene.vertices_m.emplace_back();
    for (int axis = 0; axis < 3; ++axis) p[axis] = reader.number<float>("a vertex");
    reader.require(p.allFinite(), "a vertex is out of range");
    auto& colour = scene.colours.emplace_back();
    for (std::uint8_t& value : colour) value = reader.number<std::uint8_t>("a vertex");
    reader.block(1, "a vertex");
  }
  for (std::size_t part = 0; part < triangles.size(); ++part) {
    reader.require_items(triangles[part], kTriangleBytes, "the triangles");
    for (std::uint64_t i = 0; i < triangles[part]; ++i) {
      scene.triangles[part].push_back(take_triangle(reader, scene.vertices_m.size()));
    }
  }
  reader.require(reader.left() == 0, "more than the header says");
  return scene;
}

}  // namespace vantage
