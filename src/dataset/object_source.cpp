#include "vantage/dataset/object_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>
#include <string_view>

#include "vantage/core/atomic_file.hpp"
#include "vantage/models/catalogue/database/object_database.hpp"
#include "vantage/models/catalogue/shapes/obj.hpp"
#include "vantage/perception/dataset_index.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

constexpr auto kMesh = "model.obj";
constexpr auto kTexture = "texture.png";

/// A scanned object is a category of its own; its first instance is called "<name>_1".
std::vector<ObjectName> names_in(const fs::path& folder) {
  std::vector<ObjectName> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (!fs::exists(entry.path() / kMesh) || !fs::exists(entry.path() / kTexture)) continue;
    const std::string name = entry.path().filename().string();
    names.push_back({name, name + "_1", name});
  }
  std::ranges::sort(names, {}, &ObjectName::object);
  return names;
}

std::vector<ObjectName> scanned_names(const fs::path& folder) {
  std::vector<ObjectName> names = names_in(folder);
  if (!names.empty()) return names;
  throw InputError(fmt::format("{}: no <name>/{{{}, {}}} in it", folder.string(), kMesh, kTexture));
}

/// The three numbers of a line "v x y z".
Eigen::Vector3d parse_vertex(std::string_view line, const fs::path& file) {
  Eigen::Vector3d p;
  const char* at = line.data() + 1;
  const char* end = line.data() + line.size();
  for (double& x : p) {
    while (at != end && (*at == ' ' || *at == '\t')) ++at;
    const auto [stop, error] = std::from_chars(at, end, x);
    if (error != std::errc{}) {
      throw InputError(fmt::format("{}: no vertex: '{}'", file.string(), line));
    }
    at = stop;
  }
  return p;
}

Eigen::AlignedBox3d bounds_of_obj(std::string_view text, const fs::path& file) {
  Eigen::AlignedBox3d box;
  while (!text.empty()) {
    const auto stop = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, stop);
    if (line.starts_with("v ")) box.extend(parse_vertex(line, file));
    text.remove_prefix(std::min(stop + 1, text.size()));
  }
  if (box.isEmpty()) throw InputError(fmt::format("{}: no vertices", file.string()));
  return box;
}

TurntableObject read_scanned(const fs::path& folder) {
  TurntableObject object;
  object.obj = read_file(folder / kMesh);
  object.png = read_file(folder / kTexture);
  object.box_m = bounds_of_obj(object.obj, folder / kMesh);
  return object;
}

}  // namespace

void DatasetOptions::check() const {
  if (supersampling % 2 == 0) throw ConfigError("supersampling must be odd");
  for (const int video : videos) {
    if (!video_elevation_rad(video)) {
      throw ConfigError(fmt::format("videos: {} is none of 1, 2, 4", video));
    }
  }
  if (videos.empty() || std::set(videos.begin(), videos.end()).size() != videos.size()) {
    throw ConfigError("videos: some are needed, each once");
  }
}

int DatasetOptions::frames() const {
  return std::max(1, static_cast<int>(360.0 / step_deg + 1e-9));
}

std::vector<ObjectName> object_names(const DatasetOptions& options) {
  std::vector<ObjectName> names;
  if (!options.models.empty()) {
    names = scanned_names(options.models);
  } else {
    for (const DatabaseObject& object : object_database(options.seed)) {
      names.push_back({object.category, object.name, object.family});
    }
  }
  names.resize(std::min(names.size(), static_cast<std::size_t>(options.objects)));
  return names;
}

std::vector<fs::path> scanned_files(const DatasetOptions& options) {
  std::vector<fs::path> files;
  for (const ObjectName& name : names_in(options.models)) {
    if (files.size() >= 2 * static_cast<std::size_t>(options.objects)) break;
    for (const char* part : {kMesh, kTexture}) {
      files.push_back(fs::path(options.models) / name.category / part);
    }
  }
  return files;
}

TurntableObject make_turntable_object(const DatasetOptions& options, const ObjectName& name) {
  if (!options.models.empty()) return read_scanned(fs::path(options.models) / name.category);
  const std::vector<DatabaseObject> objects = object_database(options.seed);
  const auto found = std::ranges::find(objects, name.object, &DatabaseObject::name);
  expects(found != objects.end(), "an object of the database");
  const GeneratedObject made = generate(*found);
  return {to_obj(made.mesh), png_bytes(made.texture), made.specular, bounds(made.mesh)};
}

}  // namespace vantage
