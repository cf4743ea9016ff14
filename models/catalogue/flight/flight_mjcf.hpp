/// Scenes to fly through as MJCF, readable by MuJoCo 2.2.2 and its viewer.
#pragma once

#include <filesystem>
#include <string>

#include "vantage/models/catalogue/flight/flight_scene.hpp"

namespace vantage {

/// The text of scene.xml: room, support surfaces, obstacles, lights and cameras. It includes
/// objects.xml.
std::string to_mjcf(const FlightScene& scene);

/// Writes scene.xml, objects.xml (placeholders: a box for each support surface), path.csv and
/// stands.csv.
/// @throws OutputError if a file cannot be written.
void write_scene(const FlightScene& scene, const std::filesystem::path& directory);

}  // namespace vantage
