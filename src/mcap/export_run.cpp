#include "vantage/mcap/export_run.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vantage/core/log.hpp"
#include "vantage/mcap/mcap_writer.hpp"
#include "vantage/mcap/run_streams.hpp"
#include "vantage/mcap/timeline.hpp"
#include "vantage/report/json_file.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/json.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// What manifest.json says in single values.
std::map<std::string, std::string> manifest_entries(const fs::path& run_dir) {
  std::map<std::string, std::string> entries;
  const auto manifest = json_object_or_null<Json>(read_file(run_dir / "manifest.json"));
  if (!manifest.is_object()) return entries;
  for (const auto& [key, value] : manifest.items()) {
    if (value.is_string()) entries[key] = value.get<std::string>();
    if (value.is_number()) entries[key] = value.dump();
  }
  return entries;
}

}  // namespace

ExportedRun export_run(const fs::path& run_dir, const fs::path& file,
                       const ExportOptions& options) {
  RunToExport run(run_dir);
  Timeline timeline;
  add_transforms(run, timeline);
  add_poses(run, timeline);
  add_decisions(run, timeline);
  add_map(run, timeline);
  add_cloud(run, timeline);
  add_steps(run, timeline);
  if (options.image_period_s > 0.0) {
    add_images(run, options.image_period_s, options.image_height_px, timeline);
  }
  timeline.sort();
  McapWriter writer(file);
  Progress progress("export", run.end_s());
  for (const Stream& stream : timeline.streams) {
    writer.add_channel(stream.topic, stream.schema_name, stream.schema);
  }
  for (const TimedMessage& message : timeline.messages) {
    throw_if_interrupted();
    writer.add_message(static_cast<std::uint16_t>(message.stream + 1), message.time_ns,
                       json_line(message.make()));
    progress.update(1e-9 * static_cast<double>(message.time_ns));
  }
  writer.add_metadata("vantage", manifest_entries(run_dir));
  writer.commit();
  return {timeline.streams.size(), timeline.messages.size(), run.end_s()};
}

}  // namespace vantage
