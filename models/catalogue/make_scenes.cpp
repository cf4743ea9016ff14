/// vantage_make_scenes DIR: writes the table scenes, offices and rooms to fly through into
/// DIR/<name>/.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>

#include "vantage/core/error.hpp"
#include "vantage/models/catalogue/flight/flight_mjcf.hpp"
#include "vantage/models/catalogue/office/corridor_plan.hpp"
#include "vantage/models/catalogue/office/office_list.hpp"
#include "vantage/models/catalogue/office/office_mjcf.hpp"
#include "vantage/models/catalogue/table/clutter_scene.hpp"
#include "vantage/models/catalogue/table/scene_mjcf.hpp"

int main(int argc, char** argv) {
  using vantage::ExitCode;
  if (argc != 2) {
    fmt::print(stderr, "usage: {} DIR\n", argv[0]);
    return static_cast<int>(ExitCode::usage);
  }
  try {
    const std::filesystem::path scenes = argv[1];
    for (const auto& options : vantage::standard_scenes()) {
      vantage::write_scene(vantage::make_table_scene(options), scenes / options.name);
      fmt::print("{}\n", (scenes / options.name / "scene.xml").string());
    }
    for (const auto& options : vantage::clutter_scenes()) {
      vantage::write_scene(vantage::make_clutter_scene(options), scenes / options.name);
      fmt::print("{}\n", (scenes / options.name / "scene.xml").string());
    }
    for (const auto& options : vantage::office_scenes()) {
      vantage::write_scene(vantage::make_office_scene(options), scenes / options.name);
      fmt::print("{}\n", (scenes / options.name / "scene.xml").string());
    }
    for (const auto& options : vantage::corridor_scenes()) {
      vantage::write_scene(vantage::make_corridor_scene(options), scenes / options.name);
      fmt::print("{}\n", (scenes / options.name / "scene.xml").string());
    }
    for (const auto& options : vantage::door_scenes()) {
      vantage::write_scene(vantage::make_office_scene(options), scenes / options.name);
      fmt::print("{}\n", (scenes / options.name / "scene.xml").string());
    }
    for (const auto& scene : vantage::flight_scenes()) {
      vantage::write_scene(scene, scenes / scene.name);
      fmt::print("{}\n", (scenes / scene.name / "scene.xml").string());
    }
  } catch (const vantage::Error& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    fmt::print(stderr, "internal error: {}\n", error.what());
    return static_cast<int>(ExitCode::internal);
  }
  return static_cast<int>(ExitCode::done);
}
