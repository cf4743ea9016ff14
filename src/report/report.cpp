#include "vantage/report/report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>

#include "generated/report_assets.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/data_root.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/report/former_run.hpp"
#include "vantage/report/json_file.hpp"
#include "vantage/report/page.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/report/report_embed.hpp"
#include "vantage/report/run_plans.hpp"

namespace vantage {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

json read_json_object(const fs::path& path) {
  json value = parsed_json<json>(read_file(path), path.string());
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
    {"unreachable", is_object, "an object"},
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
    {"leg_length_m", is_number, "a number"},
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
  bring_up_to_date(metrics);
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
  bring_up_to_date(steps);
  return steps;
}

/// What was found out of the run afterwards; null: nobody has asked.
json hindsight_json(const fs::path& run_dir) {
  const auto found = [&](const char* name) {
    const fs::path path = run_dir / name;
    return fs::exists(path) ? read_json_object(path) : json(nullptr);
  };
  return {{"bound", found("bound.json")}, {"branches", found("branches.json")}};
}

json media_json(const fs::path& run_dir) {
  const bool video = fs::exists(run_dir / "video.mp4");
  json media = {{"frame", frame_of(run_dir / "frames", video)}};
  if (video) media["video"] = "video.mp4";  // the frame is what stands there until it plays
  return media;
}

/// What the page knows of the task, by name.
json sections_json(const ReportSections& sections) {
  return {{"figures", sections.figures},
          {"steps", sections.steps},
          {"step_word", sections.step_word},
          {"view_heading", sections.view_heading}};
}

std::string text_of(const json& metrics, const char* key) {
  const auto found = metrics.find(key);
  return found != metrics.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::string run_title(const json& metrics) {
  const std::string scene = scene_title(text_of(metrics, "scene"));
  return scene.empty() ? "Run" : scene;
}

json run_json(const fs::path& run_dir, const ReportSections& sections) {
  json run;
  run["metrics"] = read_metrics(run_dir / "metrics.json", sections);
  run["sections"] = sections_json(sections);
  run["title"] = run_title(run["metrics"]);
  run["manifest"] = read_json_object(run_dir / "manifest.json");
  run["config"] = read_config(run_dir / "config.yaml");
  const CsvTable steps = read_steps(run_dir / "steps.csv");
  run["steps"] = {{"columns", steps.columns}, {"rows", steps.rows}};
  run["trajectory"] = {{"truth", trajectory_json(run_dir / "trajectory.tum")},
                       {"estimated", trajectory_json(run_dir / "trajectory_estimated.tum")}};
  const fs::path voxels = run_dir / "voxels.bin";
  if (sections.map && !fs::exists(voxels)) {
    throw InputError(fmt::format(
        "{}: missing, as of lean runs, whose page cannot be made; `vantage run {} --out {} "
        "--overwrite` makes the run in full (all of a study: vantage sweep run --keep-states)",
        voxels.string(), (run_dir / "config.yaml").string(), run_dir.string()));
  }
  const bool has_voxels = sections.map || (sections.scene && fs::exists(voxels));
  run["voxels"] = has_voxels ? voxels_json(voxels) : json(nullptr);
  const fs::path scene = run_dir / "scene.bin";
  run["scene"] = sections.scene && fs::exists(scene) ? scene_json(scene) : json(nullptr);
  const fs::path cloud = run_dir / "cloud.ply";
  run["cloud"] = fs::exists(cloud) ? cloud_json(cloud) : json(nullptr);
  run["media"] = media_json(run_dir);
  const fs::path plans = run_dir / "plans.csv";
  run["plans"] = sections.map && fs::exists(plans) ? plans_json(plans) : json(nullptr);
  run["hindsight"] = sections.map ? hindsight_json(run_dir) : json(nullptr);
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
  return run_title(metrics) + " · " + text_of(metrics, "method") + " · Vantage";
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
      {"script",
       scripts({"plots.js", "mesh.js", "map.js", "shaders.js", "orbit.js", "surfaces.js",
                "viewer.js", "figures.js", "flight.js", "plans.js", "hindsight.js", "page.js"})}};
  write_file(run_dir / "report.html", filled_page("page.html", replacements));
}

}  // namespace vantage
