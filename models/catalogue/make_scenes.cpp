/// vantage_make_scenes DIR: writes the standard table scenes into DIR/<name>/.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>

#include "models/catalogue/scene_mjcf.hpp"
#include "src/core/error.hpp"

int main(int argc, char** argv) {
  using vantage::ExitCode;
  if (argc != 2) {
    fmt::print(stderr, "usage: {} DIR\n", argv[0]);
    return static_cast<int>(ExitCode::usage);
  }
  try {
    for (const auto& options : vantage::standard_scenes()) {
      const std::filesystem::path directory = std::filesystem::path(argv[1]) / options.name;
      vantage::write_scene(vantage::make_table_scene(options), directory);
      fmt::print("{}\n", (directory / "scene.xml").string());
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
