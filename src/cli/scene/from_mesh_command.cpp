#include "vantage/cli/scene/from_mesh_command.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "vantage/building/building_scene.hpp"
#include "vantage/building/mesh_file.hpp"
#include "vantage/building/scene_text.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/json.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

struct FromMeshArguments {
  fs::path mesh;
  fs::path out;
  double scale = 1.0;
  std::string up = "auto";
  double floor_m = 0.0;
  bool has_floor = false;
  bool episode = false;
  BuildingOptions options;
};

fs::path episode_file(const fs::path& scene) { return fs::path(scene).replace_extension(".yaml"); }

/// Steps of the work, told as they begin; an interrupt ends it between two.
class Steps {
 public:
  void operator()(std::string_view name) {
    throw_if_interrupted();
    progress_.update(done_++, name);
  }

 private:
  static constexpr int kSteps = 6;
  Progress progress_{"from-mesh", kSteps};
  int done_ = 0;
};

BuildingScene make_scene(const FromMeshArguments& arguments) {
  Steps steps;
  steps("reading");
  const UpAxis up = arguments.up == "auto" ? usual_up_axis(arguments.mesh)
                    : arguments.up == "y"  ? UpAxis::y
                                           : UpAxis::z;
  BuildingMesh mesh = read_building_mesh(arguments.mesh, {arguments.scale, up});
  BuildingOptions options = arguments.options;
  if (arguments.has_floor) options.floor_m = arguments.floor_m;
  BuildingScene scene = make_building_scene(std::move(mesh), options, arguments.mesh.string(),
                                            [&](std::string_view name) { steps(name); });
  steps("writing");
  return scene;
}

nlohmann::ordered_json numbers_json(const auto& values) {
  nlohmann::ordered_json array = nlohmann::ordered_json::array();
  for (const double value : values) array.push_back(value);
  return array;
}

nlohmann::ordered_json scene_json(const BuildingScene& scene, const FromMeshArguments& arguments) {
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> T = scene.T_scene_mesh.matrix();
  const Pose2& start = scene.floor.start;
  nlohmann::ordered_json json{
      {"scene", arguments.out.string()},
      {"geoms",
       {{"boxes", scene.boxes.size()},
        {"hulls", scene.hulls.size()},
        {"cell_boxes", scene.cell_boxes.size()},
        {"planes", scene.laid_floor ? 1 : 0}}},
      {"cell_m", scene.cell_m},
      {"T_scene_mesh", numbers_json(std::vector<double>(T.data(), T.data() + T.size()))},
      {"start", {start.x_m, start.y_m, start.yaw_rad}},
      {"start_clearance_m", scene.floor.clearance_m},
      {"free_area_m2", scene.floor.area_m2},
      {"size_m", numbers_json(scene.extent_m.sizes())},
      {"set", episode_overrides(scene)}};
  if (arguments.episode) json["episode"] = episode_file(arguments.out).string();
  return json;
}

std::string scene_report(const BuildingScene& scene, const FromMeshArguments& arguments) {
  const Eigen::Vector2d size_m = scene.extent_m.sizes();
  const Pose2& start = scene.floor.start;
  std::string text = fmt::format(
      "{}: {} boxes and {} other convex shapes as the mesh has them, {} boxes for the rest, whose "
      "surfaces are off by {:g} m at most\n",
      arguments.out.string(), scene.boxes.size(), scene.hulls.size(), scene.cell_boxes.size(),
      scene.cell_m);
  text += fmt::format(
      "{:.3g} x {:.3g} m; start_0 at ({:.2f}, {:.2f}), {:.2f} m clear, {:.3g} m2 of floor about "
      "it\n",
      size_m.x(), size_m.y(), start.x_m, start.y_m, scene.floor.clearance_m, scene.floor.area_m2);
  const BuildingMap map = map_of(scene);
  text += fmt::format("its map: {:g} x {:g} m, {} x {} x {} cells of {:.1f} cm\n", map.size_m.x(),
                      map.size_m.y(), map.cells.x(), map.cells.y(), map.cells.z(),
                      100.0 * map.size_m.x() / map.cells.x());
  if (arguments.episode) {
    return text + fmt::format("explore it: vantage run {}\n", episode_file(arguments.out).string());
  }
  std::string sets;
  for (const std::string& set : episode_overrides(scene)) sets += fmt::format(" --set '{}'", set);
  return text +
         fmt::format("explore it: vantage run assets/episodes/office_small.yaml --set scene={}{}\n",
                     arguments.out.string(), sets);
}

ExitCode from_mesh_command(const FromMeshArguments& arguments, const SceneFlags& flags) {
  require_absent(arguments.out, flags.overwrite);
  if (arguments.episode) require_absent(episode_file(arguments.out), flags.overwrite, "--episode");
  catch_interrupts();
  const BuildingScene scene = make_scene(arguments);
  const std::string made_by = fmt::format("made by vantage scene from-mesh of {}, cells of {:g} m",
                                          arguments.mesh.filename().string(), scene.cell_m);
  write_file(arguments.out, to_mjcf(scene, arguments.out.stem().string(), made_by));
  if (arguments.episode) {
    write_file(episode_file(arguments.out), to_episode(scene, arguments.out.filename().string()));
  }
  fmt::print("{}",
             flags.json ? json_text(scene_json(scene, arguments)) : scene_report(scene, arguments));
  return ExitCode::done;
}

}  // namespace

std::function<ExitCode()> declare_from_mesh(CLI::App& app,
                                            const std::shared_ptr<const SceneFlags>& flags) {
  auto arguments = std::make_shared<FromMeshArguments>();
  BuildingOptions& options = arguments->options;
  app.add_option("mesh", arguments->mesh, "mesh of a building: OBJ, PLY, STL, glTF")->required();
  app.add_option("--out", arguments->out, "MJCF file to write, SCENE.xml")
      ->required()
      ->check(
          [](const std::string& text) { return text.ends_with(".xml") ? "" : "must end in .xml"; });
  app.add_flag("--episode", arguments->episode,
               "write an episode that explores it beside it, SCENE.yaml");
  app.add_option("--scale", arguments->scale, "metres that 1 in the file stands for; of mm 0.001")
      ->check(CLI::Range(1e-6, 1e6))
      ->capture_default_str();
  app.add_option("--up", arguments->up, "axis that points up: y or z; auto: y of glTF, else z")
      ->check(CLI::IsMember({"auto", "y", "z"}))
      ->capture_default_str();
  CLI::Option* floor = app.add_option(
      "--floor", arguments->floor_m,
      "height of the floor in the mesh, m; where the mesh has none there, one is laid; default: "
      "the lowest large level with air above it");
  app.add_option("--height", options.height_m, "what begins higher above the floor is left out, m")
      ->check(CLI::Range(2.0, 100.0))
      ->capture_default_str();
  app.add_option("--cell", options.cell_m,
                 "edge of the cells that parts which are not convex are made of, m; lower is truer "
                 "and takes more boxes")
      ->check(CLI::Range(0.005, 1.0))
      ->capture_default_str();
  app.add_option("--clearance", options.clearance_m,
                 "room that a start needs all round, m; also what the robot is taken to pass by")
      ->check(CLI::Range(0.05, 10.0))
      ->capture_default_str();
  app.add_option("--max-geoms", options.max_geoms, "shapes that the scene may have at most")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  return [arguments, flags, floor] {
    arguments->has_floor = floor->count() > 0;
    return from_mesh_command(*arguments, *flags);
  };
}

}  // namespace vantage
