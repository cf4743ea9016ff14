#include "vantage/runtime/scene_file.hpp"

#include <utility>

#include "vantage/report/drawn_scene.hpp"
#include "vantage/sim/render/scene_surfaces.hpp"
#include "vantage/sim/world/floor_plan.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {

void write_scene_file(const World& world, const std::filesystem::path& run_dir) {
  static_assert(DrawnScene::kParts == OuterWalls::kSides + 1);
  SceneSurfaces surfaces = scene_surfaces(world.model(), world.snapshot());
  write_drawn_scene(run_dir / "scene.bin", {.extent_m = surfaces.extent_m.cast<float>(),
                                            .vertices_m = std::move(surfaces.vertices_m),
                                            .colours = std::move(surfaces.colours),
                                            .triangles = std::move(surfaces.triangles)});
}

std::vector<FloorOutline> scene_floor_plan(const ModelSource& source) {
  const World world(source);
  return floor_plan(world.model(), world.snapshot());
}

}  // namespace vantage
