#include "vantage/dataset/render_dataset.hpp"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <exception>
#include <mutex>
#include <numbers>
#include <thread>
#include <vector>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/dataset/object_source.hpp"
#include "vantage/dataset/sensing.hpp"
#include "vantage/dataset/turntable.hpp"
#include "vantage/dataset/view_files.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

constexpr std::array kVideos{1, 2, 4};
constexpr auto kOptionsFile = "dataset.yaml";

/// Ends the work on an object that shall not be finished.
struct Stopped {};

std::string options_text(DatasetOptions options) { return to_yaml(write_node(options)); }

void remove_folder(const fs::path& folder) {
  std::error_code error;
  fs::remove_all(folder, error);
  if (error) {
    throw OutputError(fmt::format("{}: cannot remove: {}", folder.string(), error.message()));
  }
}

void rename_folder(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error) {
    throw OutputError(fmt::format("{}: cannot write: {}", to.string(), error.message()));
  }
}

/// @throws ConfigError if the folder cannot become or remain a dataset of these options.
void prepare_root(const DatasetOptions& options, const DatasetRun& run) {
  make_writable_directory(run.root);
  const fs::path file = run.root / kOptionsFile;
  if (!fs::exists(file)) {
    if (!fs::is_empty(run.root)) {
      throw ConfigError(fmt::format("{}: is not empty, and no dataset of ours", run.root.string()));
    }
  } else if (run.overwrite) {
    remove_folder(run.root);
    make_writable_directory(run.root);
  } else {
    DatasetOptions before;
    read_into(read_yaml(file), before, {});
    before.objects = options.objects;
    if (options_text(before) != options_text(options)) {
      refuse_to_replace(run.root.string(),
                        fmt::format("was rendered with other options, see {}", kOptionsFile));
    }
  }
  write_file(file, options_text(options));
}

/// @return the number of views.
int render_video(const TurntableObject& object, const ObjectName& name, int video,
                 const fs::path& folder, const DatasetOptions& options, const DatasetRun& run) {
  const std::string stream = fmt::format("{}/{}", name.object, video);
  Rng rng = Rng::stream(options.seed, options.session == 1
                                          ? stream
                                          : fmt::format("{}/session {}", stream, options.session));
  const Session session = draw_session(options, *video_elevation_rad(video), rng);
  Turntable turntable(object, session, options, name.object);
  RenderedImages drawn;
  int views = 0;
  for (int i = 0; i < options.frames(); ++i) {
    if (run.stop()) throw Stopped{};
    const double yaw_rad = session.first_yaw_rad + i * options.step_deg * std::numbers::pi / 180.0;
    turntable.draw(yaw_rad, drawn);
    const ObjectView view = sense(drawn, turntable.object_geom(), session, options, rng);
    if (view.width_px == 0 && options.cut_by_depth) continue;  // too flat for so far away
    if (view.width_px == 0) throw InputError(fmt::format("{}: cannot be seen", name.object));
    write_view(view, {{name.category, name.object, video, i + 1}, folder, yaw_rad});
    ++views;
  }
  return views;
}

/// Renders into a folder beside the final one and renames it when all is there.
int render_object(const ObjectName& name, const fs::path& folder, const DatasetOptions& options,
                  const DatasetRun& run) {
  const fs::path part = folder.parent_path() / fmt::format(".{}.part", name.object);
  remove_folder(part);
  make_writable_directory(part);
  const TurntableObject object = make_turntable_object(options, name);
  int views = 0;
  try {
    for (const int video : kVideos) views += render_video(object, name, video, part, options, run);
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(part, ignored);
    throw;
  }
  rename_folder(part, folder);
  return views;
}

/// Threads that take one object after the other until all are done or one failed.
class Workers {
 public:
  Workers(const DatasetOptions& options, const DatasetRun& run)
      : options_(options),
        run_(run),
        names_(object_names(options)),
        progress_("rendering", static_cast<double>(names_.size())) {}

  DatasetOutcome work() {
    std::vector<std::jthread> threads;
    for (int i = 1; i < run_.jobs; ++i) threads.emplace_back([this] { take_objects(); });
    take_objects();
    threads.clear();
    if (failure_) std::rethrow_exception(failure_);
    return outcome_;
  }

 private:
  void take_objects() {
    try {
      for (std::size_t i = next_++; i < names_.size() && !over_; i = next_++) take(names_[i]);
    } catch (const Stopped&) {
      over_ = true;
      const std::lock_guard lock(mutex_);
      outcome_.stopped = true;
    } catch (...) {
      over_ = true;
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
    }
  }

  void take(const ObjectName& name) {
    const fs::path folder = run_.root / name.category / name.object;
    const bool done = fs::exists(folder);
    const int views = done ? 0 : render_object(name, folder, options_, run_);
    const std::lock_guard lock(mutex_);
    ++outcome_.objects;
    outcome_.rendered += done ? 0 : 1;
    outcome_.views += views;
    progress_.update(outcome_.objects, name.object);
  }

  const DatasetOptions& options_;
  const DatasetRun& run_;
  std::vector<ObjectName> names_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> over_ = false;
  std::mutex mutex_;  ///< of what follows
  Progress progress_;
  DatasetOutcome outcome_;
  std::exception_ptr failure_;
};

}  // namespace

DatasetOutcome render_dataset(const DatasetOptions& options, const DatasetRun& run) {
  check_options(options);
  if (run.jobs < 1) throw ConfigError(fmt::format("jobs {}: must be at least 1", run.jobs));
  Workers workers(options, run);
  prepare_root(options, run);
  return workers.work();
}

std::string dataset_options_text(const fs::path& root) {
  return fs::exists(root / kOptionsFile) ? read_file(root / kOptionsFile) : std::string{};
}

}  // namespace vantage
