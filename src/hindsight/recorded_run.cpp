#include "vantage/hindsight/recorded_run.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/report/json_file.hpp"
#include "vantage/runtime/manifest.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json read_object(const fs::path& path) {
  Json json = json_object_or_null<Json>(read_file(path));
  if (!json.is_object()) throw InputError(path.string() + ": not a JSON object");
  return json;
}

std::string recorded_version(const fs::path& directory) {
  const Json manifest = read_object(directory / "manifest.json");
  const Json versions = manifest.value("versions", Json::object());
  const bool told = versions.is_object() && versions.contains("vantage");
  return told && versions["vantage"].is_string() ? versions["vantage"].get<std::string>()
                                                 : "unknown";
}

/// Values of an object of metrics.json.
struct MetricsReader {
  const Json& object;
  std::string place;
  const std::string& version;

  template <class T>
  T get(const char* key) const {
    try {
      return object.at(key).get<T>();
    } catch (const nlohmann::json::exception&) {
      throw InputError(
          fmt::format("{}: {}: missing or of another kind, as in runs of another "
                      "version: recorded by {}, this is {}",
                      place, key, version, version_text()));
    }
  }
};

RecordedScan read_scan(const MetricsReader& scan) {
  return {.time_s = scan.get<double>("time_s"),
          .path_length_m = scan.get<double>("path_length_m"),
          .scan_time_s = scan.get<double>("scan_time_s"),
          .cells_left = scan.get<std::size_t>("observable_unobserved_cells"),
          .chosen_view = scan.get<int>("chosen_view"),
          .candidates = scan.get<int>("candidates")};
}

}  // namespace

RecordedRun read_recorded_run(const fs::path& directory) {
  RecordedRun run;
  run.directory = directory;
  run.episode = load_recorded(directory);
  run.episode.setup.name = fs::absolute(directory / "").lexically_normal().parent_path().filename();
  run.version = recorded_version(directory);
  const fs::path file = directory / "metrics.json";
  const Json metrics = read_object(file);
  const MetricsReader whole{metrics, file.string(), run.version};
  if (!metrics.contains("scans") || !metrics["scans"].is_array()) {
    throw InputError(fmt::format("{}: scans: missing; task {} takes none to choose among",
                                 file.string(), strategy_name_of(run.episode.task)));
  }
  run.method = whole.get<std::string>("method");
  run.state_hash = whole.get<std::string>("state_hash");
  run.status = whole.get<std::string>("status");
  run.observable_cells = whole.get<std::size_t>("observable_cells");
  for (std::size_t k = 0; k < metrics["scans"].size(); ++k) {
    const std::string place = fmt::format("{}: scans[{}]", file.string(), k);
    run.scans.push_back(read_scan({metrics["scans"][k], place, run.version}));
  }
  if (run.scans.empty()) throw InputError(file.string() + ": scans: empty, the run took none");
  return run;
}

}  // namespace vantage
