#include "vantage/recipe/make_model.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "vantage/core/error.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/core/log.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/dataset/object_renderer.hpp"
#include "vantage/dataset/render_dataset.hpp"
#include "vantage/recognition/training.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

/// To be raised by whoever changes what a recording of the same options shows.
constexpr int kRenderingVersion = 1;

/// Of one processor, for shares of the whole: what is told of time left is measured.
constexpr double kRenderView_s = 0.008;
constexpr double kTrainView_s = 0.0015;

/// "3 min", "40 s".
std::string time_text(double time_s) {
  return time_s < 90.0 ? fmt::format("{:.0f} s", time_s) : fmt::format("{:.0f} min", time_s / 60.0);
}

int views_of_object(const DatasetOptions& options) {
  return options.frames() * static_cast<int>(options.videos.size());
}

double views_to_train_on(const ModelRecipe& recipe) {
  double views = 0.0;
  for (const DatasetOptions& recording : recipe.recordings) {
    views += static_cast<double>(object_names(recording).size()) * recording.frames() *
             static_cast<double>(recipe.train.videos.size());
  }
  return views;
}

/// Objects of a recording that are not there yet.
int open_objects(const fs::path& root, const DatasetOptions& options) {
  const std::vector<ObjectName> names = object_names(options);
  return static_cast<int>(std::ranges::count_if(
      names, [&](const ObjectName& name) { return !fs::exists(object_folder(root, name)); }));
}

/// Of all that this call does, in expected seconds.
class WholeProgress {
 public:
  explicit WholeProgress(double total_s) : bar_("making the model", total_s), total_s_(total_s) {}

  void done(double done_s, const std::string& what) {
    const double taken_s = wall_s() - start_s_;
    const double left_s = done_s > 0.0 ? taken_s * (total_s_ - done_s) / done_s : 0.0;
    const bool tells = taken_s > 1.0 && done_s > 0.0;
    bar_.update(done_s, tells ? fmt::format("{}, {} left", what, time_text(left_s)) : what);
  }

 private:
  Progress bar_;
  double total_s_;
  double start_s_ = wall_s();
};

/// Names and bytes of the scanned objects; nothing of generated ones, which the options name.
std::uint64_t hash_of_scans(const DatasetOptions& options) {
  std::uint64_t hash = kHashSeed;
  if (options.models.empty()) return hash;
  for (const ObjectName& name : object_names(options)) {
    const TurntableObject object = make_turntable_object(options, name);
    for (const std::string* part : {&name.object, &object.obj, &object.png}) {
      hash = hash_bytes(*part, hash_bytes(std::to_string(part->size()), hash));
    }
  }
  return hash;
}

class ModelMaker {
 public:
  ModelMaker(const ModelRecipe& recipe, const ModelMaking& how)
      : recipe_(recipe),
        how_(how),
        folders_(folders_of(recipe, how.cache)),
        progress_(expected_s()) {}

  RecognitionModel make() {
    DatasetIndex index;
    for (std::size_t i = 0; i < recipe_.recordings.size(); ++i) {
      const DatasetIndex recording = index_dataset(record(i));
      index.views.insert(index.views.end(), recording.views.begin(), recording.views.end());
    }
    return train_recognition(index, recipe_.train, training());
  }

 private:
  static std::vector<fs::path> folders_of(const ModelRecipe& recipe, const fs::path& cache) {
    std::vector<fs::path> folders;
    for (const DatasetOptions& options : recipe.recordings) {
      folders.push_back(recording_folder(cache, options));
    }
    return folders;
  }

  [[nodiscard]] double expected_s() const {
    double total_s = kTrainView_s * views_to_train_on(recipe_);
    for (std::size_t i = 0; i < folders_.size(); ++i) {
      const DatasetOptions& options = recipe_.recordings[i];
      total_s += kRenderView_s * views_of_object(options) * open_objects(folders_[i], options);
    }
    return total_s;
  }

  /// Renders what is missing of a recording. @returns its folder
  fs::path record(std::size_t number) {
    const DatasetOptions& options = recipe_.recordings[number];
    const fs::path& root = folders_[number];
    const double object_s = kRenderView_s * views_of_object(options);
    const double before_s = done_s_;
    const int open = open_objects(root, options);
    const auto tell = [&](int objects, int of, const std::string& object) {
      done_s_ = before_s + object_s * std::max(0, objects - (of - open));
      progress_.done(done_s_, fmt::format("recording {} of {}, {}", number + 1,
                                          recipe_.recordings.size(), object));
    };
    const DatasetOutcome outcome = render_dataset(
        options,
        {.root = root, .jobs = how_.jobs, .worker = how_.worker, .stop = how_.stop, .tell = tell});
    if (outcome.stopped) how_.poll();
    expects(!outcome.stopped, "poll throws if stop says so");
    return root;
  }

  LongWork training() {
    const double rendered_s = done_s_;
    const double train_s = kTrainView_s * views_to_train_on(recipe_);
    return {.threads = how_.jobs,
            .poll = how_.poll,
            .feature_cache = how_.cache / "features",
            .tell = [=, this](const std::string& part, std::size_t done, std::size_t of) {
              if (part == kExtractingFeatures) {
                done_s_ =
                    rendered_s + train_s * static_cast<double>(done) / static_cast<double>(of);
              }
              progress_.done(done_s_, part);
            }};
  }

  const ModelRecipe& recipe_;
  const ModelMaking& how_;
  std::vector<fs::path> folders_;  ///< of the recordings
  WholeProgress progress_;
  double done_s_ = 0.0;
};

}  // namespace

fs::path recording_folder(const fs::path& cache, const DatasetOptions& options) {
  // Another OpenGL draws other images.
  static const std::string renderer = renderer_name();
  const std::string made_with =
      fmt::format("version {}, {}\n{}", kRenderingVersion, renderer, to_yaml(write_node(options)));
  const std::uint64_t hash = hash_bytes(made_with, hash_of_scans(options));
  return cache / "recordings" / fmt::format("session_{}-{}", options.session, hash_text(hash));
}

RecognitionModel make_model(const ModelRecipe& recipe, const ModelMaking& how) {
  check_options(recipe);
  return ModelMaker(recipe, how).make();
}

}  // namespace vantage
