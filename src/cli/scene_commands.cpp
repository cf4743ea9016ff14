#include "vantage/cli/scene_commands.hpp"

#include <CLI/CLI.hpp>

#include <memory>

#include "vantage/cli/common_flags.hpp"
#include "vantage/cli/scene/from_mesh_command.hpp"

namespace vantage {

std::function<ExitCode()> declare_scene(CLI::App& app) {
  app.require_subcommand(1);
  CLI::App* from_mesh =
      app.add_subcommand("from-mesh", "a scene to explore, made of a building's mesh");
  auto flags = std::make_shared<SceneFlags>();
  add_overwrite(*from_mesh, flags->overwrite);
  add_json(*from_mesh, flags->json);
  return declare_from_mesh(*from_mesh, flags);
}

}  // namespace vantage
