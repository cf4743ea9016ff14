#include "vantage/dataset/render_dataset.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <optional>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/dataset/object_renderer.hpp"
#include "vantage/dataset/render_pool.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

constexpr auto kOptionsFile = "dataset.yaml";

std::string options_text(const DatasetOptions& options) { return to_yaml(write_node(options)); }

/// What a dataset of ours holds but its options: the folder stays, since it is what is locked.
void remove_objects(const fs::path& root) {
  std::error_code error;
  fs::directory_iterator entry(root, error);
  while (!error && entry != fs::directory_iterator{}) {
    if (entry->path().filename() != kOptionsFile) fs::remove_all(entry->path(), error);
    if (!error) entry.increment(error);
  }
  if (error) {
    throw OutputError(fmt::format("{}: cannot remove: {}", root.string(), error.message()));
  }
}

/// @throws ConfigError if the folder cannot become or remain a dataset of these options.
void prepare_root(const DatasetOptions& options, const DatasetRun& run) {
  const fs::path file = run.root / kOptionsFile;
  if (!fs::exists(file)) {
    if (!fs::is_empty(run.root)) {
      throw ConfigError(fmt::format("{}: is not empty, and no dataset of ours", run.root.string()));
    }
  } else if (run.overwrite) {
    remove_objects(run.root);
  } else {
    DatasetOptions before;
    read_into(read_yaml(file), before, {});
    if (options.objects < before.objects) {
      refuse_to_replace(run.root.string(), fmt::format("holds {} objects, more than {}",
                                                       before.objects, options.objects));
    }
    before.objects = options.objects;
    if (options_text(before) != options_text(options)) {
      refuse_to_replace(run.root.string(),
                        fmt::format("was rendered with other options, see {}", kOptionsFile));
    }
  }
  write_file(file, options_text(options));
}

/// A dataset's folder while one process renders into it.
class RenderLock {
 public:
  /// @throws OutputError if another process has it.
  explicit RenderLock(const fs::path& root)
      : folder_(::open(root.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (folder_ < 0 || ::flock(folder_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
    ::close(folder_);
    throw OutputError(fmt::format("{}: another process renders into it", root.string()));
  }
  RenderLock(const RenderLock&) = delete;
  RenderLock& operator=(const RenderLock&) = delete;
  ~RenderLock() {
    if (folder_ >= 0) ::close(folder_);
  }

 private:
  int folder_;
};

/// What one call does, as it goes on.
class Rendering {
 public:
  Rendering(const DatasetOptions& options, const DatasetRun& run)
      : options_(options), run_(run), names_(object_names(options)) {
    if (!run.tell) bar_.emplace("rendering", static_cast<double>(names_.size()));
  }

  DatasetOutcome work() {
    std::vector<ObjectName> open;
    for (const ObjectName& name : names_) {
      if (fs::exists(object_folder(run_.root, name))) {
        complete(name);
      } else {
        open.push_back(name);
      }
    }
    outcome_.stopped = !(run_.worker.empty() ? render_here(open) : render_by_workers(open));
    return outcome_;
  }

 private:
  /// @returns false if it was stopped.
  bool render_here(const std::vector<ObjectName>& open) {
    if (open.empty()) return true;
    ObjectRenderer renderer(options_, run_.root);
    for (const ObjectName& name : open) {
      const auto views = renderer.render(name, run_.stop);
      if (!views) return false;
      complete(name, *views);
    }
    return true;
  }

  bool render_by_workers(const std::vector<ObjectName>& open) {
    return render_in_processes(
        options_, run_, open, [this](const ObjectName& name, int views) { complete(name, views); });
  }

  /// @param views rendered just now; nothing: it was there
  void complete(const ObjectName& name, std::optional<int> views = {}) {
    ++outcome_.objects;
    outcome_.rendered += views ? 1 : 0;
    outcome_.views += views.value_or(0);
    if (run_.tell) {
      run_.tell(outcome_.objects, static_cast<int>(names_.size()), name.object);
    } else {
      bar_->update(outcome_.objects, name.object);
    }
  }

  const DatasetOptions& options_;
  const DatasetRun& run_;
  std::vector<ObjectName> names_;
  std::optional<Progress> bar_;
  DatasetOutcome outcome_;
};

}  // namespace

DatasetOutcome render_dataset(const DatasetOptions& options, const DatasetRun& run) {
  check_options(options);
  if (run.jobs < 1) throw ConfigError(fmt::format("jobs {}: must be at least 1", run.jobs));
  Rendering rendering(options, run);
  make_writable_directory(run.root);
  const RenderLock lock(run.root);
  prepare_root(options, run);
  return rendering.work();
}

std::string dataset_options_text(const fs::path& root) {
  return fs::exists(root / kOptionsFile) ? read_file(root / kOptionsFile) : std::string{};
}

std::vector<std::string> missing_objects(const fs::path& root) {
  std::vector<std::string> missing;
  if (!fs::exists(root / kOptionsFile)) return missing;
  DatasetOptions options;
  read_into(read_yaml(root / kOptionsFile), options, {});
  if (!options.models.empty() && !fs::is_directory(options.models)) return missing;  // moved since
  for (const ObjectName& name : object_names(options)) {
    if (!fs::exists(object_folder(root, name))) missing.push_back(name.object);
  }
  return missing;
}

}  // namespace vantage
