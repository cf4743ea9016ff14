#include "vantage/report/report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>

#include "generated/report_assets.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/perception/clouds/ply.hpp"
#include "vantage/report/page.hpp"
#include "vantage/report/report_data.hpp"

namespace vantage {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

constexpr std::size_t kMaxTrajectorySamples = 4000;

json read_json_object(const fs::path& path) {
  const std::string text = read_file(path);
  json value;
  try {
    value = json::parse(text);
  } catch (const json::exception& error) {
    throw InputError(fmt::format("{}: not valid JSON: {}", path.string(), error.what()));
  }
  if (!value.is_object()) throw InputError(path.string() + ": expected a JSON object");
  return value;
}

bool is_number(const json& value) { return value.is_number() || value.is_null(); }  // null: NaN
bool is_text(const json& value) { return value.is_string(); }
bool is_object(const json& value) { return value.is_object(); }
bool is_objects(const json& value) {
  return value.is_array() && std::all_of(value.begin(), value.end(), is_object);
}

struct KeyType {
  const char* key;
  bool (*is_type)(const json&);
  std::string_view expected;
};
constexpr KeyType kMetricsTypes[] = {
    {"scene", is_text, "a text"},
    {"method", is_text, "a text"},
    {"state_hash", is_text, "a text"},
    {"simulated_time_s", is_number, "a number"},
    {"wall_time_s", is_number, "a number"},
    {"real_time_factor", is_number, "a number"},
    {"path_length_m", is_number, "a number"},
    {"collisions", is_number, "a number"},
    {"observable_cells", is_number, "a number"},
    {"map", is_object, "an object"},
    {"region", is_object, "an object"},
    {"scans", is_objects, "a list of objects"},
    {"observations", is_objects, "a list of objects"},
    {"candidates", is_objects, "a list of objects"},
    {"objects", is_objects, "a list of objects"},
};
constexpr KeyType kScanTypes[] = {
    {"unobserved_cells", is_number, "a number"},
    {"observable_unobserved_cells", is_number, "a number"},
    {"predicted", is_object, "an object"},
    {"actual_new_cells", is_number, "a number"},
    {"chosen_view", is_number, "a number"},
    {"plan_time_s", is_number, "a number"},
    {"path_length_m", is_number, "a number"},
    {"pose_error_m", is_number, "a number"},
    {"pose_error_before_registration_m", is_number, "a number"},
    {"view", is_object, "an object"},
};

/// Keys that are there have their types; `place` is the file, or the file and the object in it.
void require_types(const std::string& place, const json& object, std::span<const KeyType> types) {
  for (const KeyType& type : types) {
    const auto found = object.find(type.key);
    if (found == object.end() || type.is_type(*found)) continue;
    throw InputError(fmt::format("{}: {}: expected {}", place, type.key, type.expected));
  }
}

json read_metrics(const fs::path& path, const ReportSections& sections) {
  json metrics = read_json_object(path);
  for (const char* key : {"task", "status"}) {
    if (!metrics.contains(key) || !metrics[key].is_string()) {
      throw InputError(fmt::format("{}: {}: expected a text", path.string(), key));
    }
  }
  require_types(path.string(), metrics, kMetricsTypes);
  if (sections.map) {
    if (!metrics.contains("scans")) throw InputError(path.string() + ": scans: missing");
    for (std::size_t i = 0; i < metrics["scans"].size(); ++i) {
      require_types(fmt::format("{}: scans[{}]", path.string(), i), metrics["scans"][i],
                    kScanTypes);
    }
  }
  return metrics;
}

std::string read_config(const fs::path& path) {
  try {
    const ConfigNode config = read_yaml(path);
    if (config.kind != ConfigNode::Kind::null) detail::require_kind(config, ConfigNode::Kind::map);
  } catch (const ConfigError& error) {
    throw InputError(error.what());
  }
  return read_file(path);
}

CsvTable read_steps(const fs::path& path) {
  CsvTable steps = read_csv(path);
  if (steps.columns.front() != "time_s") {
    throw InputError(path.string() + ":1: expected a header that starts with time_s");
  }
  return steps;
}

double rounded(double value, double step) { return std::round(value / step) * step; }

/// [[t, x, y, z, yaw], ...], thinned evenly, the last sample always kept.
json trajectory_json(const fs::path& path) {
  const auto samples = read_tum(path);
  const std::size_t every = std::max<std::size_t>(
      1, (samples.size() + kMaxTrajectorySamples - 1) / kMaxTrajectorySamples);
  json list = json::array();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i % every != 0 && i + 1 != samples.size()) continue;
    const TrajectorySample& s = samples[i];
    list.push_back({rounded(s.time_s, 1e-3), rounded(s.p_world_m.x(), 1e-4),
                    rounded(s.p_world_m.y(), 1e-4), rounded(s.p_world_m.z(), 1e-4),
                    rounded(s.yaw_rad, 1e-4)});
  }
  return list;
}

json vector_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Cell indices and steps as base64 of little-endian u16 quadruples.
json voxels_json(const fs::path& path) {
  const VoxelMap map = read_voxels(path);
  const PackedVoxels packed = pack_voxels(map, kMaxReportVoxels);
  static_assert(sizeof(PackedVoxel) == 8);
  const std::string_view bytes(reinterpret_cast<const char*>(packed.voxels.data()),
                               packed.voxels.size() * sizeof(PackedVoxel));
  return {{"cell_size_m", vector_json(map.cell_size_m)},
          {"min_m", vector_json(map.box_m.min())},
          {"max_m", vector_json(map.box_m.max())},
          {"cells", {packed.cells.x(), packed.cells.y(), packed.cells.z()}},
          {"total", packed.total},
          {"surface", packed.surface},
          {"kept", packed.kept},
          {"data", base64(bytes)}};
}

/// Every n-th point, n such that there are not too many, quantised to 16 bits inside their box.
json cloud_json(const fs::path& path) {
  const std::vector<Eigen::Vector3f> all = read_ply(path).cloud.points;
  if (all.empty()) return nullptr;
  const std::size_t every = (all.size() - 1) / (kMaxReportVoxels / 2) + 1;
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < all.size(); i += every) points.push_back(all[i]);
  Eigen::AlignedBox3f box;
  for (const auto& p : points) box.extend(p);
  const Eigen::Array3f scale = box.sizes().array().max(1e-6F) / 65535.0F;
  std::vector<std::uint16_t> values;
  values.reserve(3 * points.size());
  for (const auto& p : points) {
    const Eigen::Array3f q = ((p - box.min()).array() / scale).round();
    for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<std::uint16_t>(q[axis]));
  }
  const std::string_view bytes(reinterpret_cast<const char*>(values.data()), 2 * values.size());
  return {{"min_m", vector_json(box.min().cast<double>())},
          {"scale_m", vector_json(scale.matrix().cast<double>())},
          {"total", all.size()},
          {"kept", points.size()},
          {"data", base64(bytes)}};
}

/// The last image of `frames/` by name, as a data URI; null if there is none.
json last_frame(const fs::path& folder) {
  fs::path last;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto extension = entry.path().extension();
    const bool image = extension == ".png" || extension == ".jpg";
    const bool part = entry.path().stem().extension() == ".part";
    if (image && !part && (last.empty() || entry.path() > last)) last = entry.path();
  }
  if (last.empty()) return nullptr;
  const std::string type = last.extension() == ".png" ? "png" : "jpeg";
  return "data:image/" + type + ";base64," + base64(read_file(last));
}

json media_json(const fs::path& run_dir) {
  if (fs::exists(run_dir / "video.mp4")) return {{"video", "video.mp4"}};
  return {{"frame", last_frame(run_dir / "frames")}};
}

/// What the page knows of the task, by name.
json sections_json(const ReportSections& sections) {
  return {{"figures", sections.figures},
          {"steps", sections.steps},
          {"step_word", sections.step_word},
          {"view_heading", sections.view_heading}};
}

json run_json(const fs::path& run_dir, const ReportSections& sections) {
  json run;
  run["metrics"] = read_metrics(run_dir / "metrics.json", sections);
  run["sections"] = sections_json(sections);
  run["manifest"] = read_json_object(run_dir / "manifest.json");
  run["config"] = read_config(run_dir / "config.yaml");
  const CsvTable steps = read_steps(run_dir / "steps.csv");
  run["steps"] = {{"columns", steps.columns}, {"rows", steps.rows}};
  run["trajectory"] = {{"truth", trajectory_json(run_dir / "trajectory.tum")},
                       {"estimated", trajectory_json(run_dir / "trajectory_estimated.tum")}};
  const fs::path voxels = run_dir / "voxels.bin";
  if (sections.map && !fs::exists(voxels)) {
    throw InputError(voxels.string() + ": missing; a run with --lean leaves it out");
  }
  run["voxels"] = sections.map ? voxels_json(voxels) : json(nullptr);
  const fs::path cloud = run_dir / "cloud.ply";
  run["cloud"] = fs::exists(cloud) ? cloud_json(cloud) : json(nullptr);
  run["media"] = media_json(run_dir);
  return run;
}

/// JSON that may stand inside a <script> element: no '<' or '&' survives, so neither an end tag
/// nor a comment can begin.
std::string script_safe(const json& value) {
  const std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<' || c == '>' || c == '&') {
      safe += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      safe += c;
    }
  }
  return safe;
}

std::string page_title(const json& metrics) {
  const auto text = [&](const char* key) {
    const auto found = metrics.find(key);
    return found != metrics.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  return text("scene") + " · " + text("method") + " · Vantage";
}

std::string scripts(std::initializer_list<std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text.append(embedded_asset(name)).append("\n");
  return text;
}

}  // namespace

void write_report(const fs::path& run_dir, const ReportSections& sections) {
  const json run = run_json(run_dir, sections);
  const Replacement replacements[] = {
      {"title", html_escaped(page_title(run["metrics"]))},
      {"data", script_safe(run)},
      {"script", scripts({"plots.js", "mesh.js", "map.js", "shaders.js", "orbit.js", "viewer.js",
                          "figures.js", "flight.js", "page.js"})}};
  write_file(run_dir / "report.html", filled_page("page.html", replacements));
}

}  // namespace vantage
