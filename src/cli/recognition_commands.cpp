#include "vantage/cli/recognition_commands.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "vantage/cli/common_flags.hpp"
#include "vantage/cli/dataset_commands.hpp"
#include "vantage/cli/hints/text_check.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/dataset/render_dataset.hpp"
#include "vantage/recipe/make_model.hpp"
#include "vantage/recognition/training.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/study/recognition/recognition_study.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

int all_cores() { return static_cast<int>(std::max(1U, std::thread::hardware_concurrency())); }

/// What both commands take.
struct RecognitionArguments {
  std::vector<fs::path> datasets;
  std::vector<fs::path> training;
  fs::path model;
  fs::path out;
  fs::path config;
  fs::path recipe;
  std::vector<std::string> overrides;
  fs::path cache;
  int jobs = all_cores();
  bool skip_bad = false;
  bool overwrite = false;
  bool json = false;

  [[nodiscard]] LongWork how() const {
    return {.threads = jobs, .poll = throw_if_interrupted, .feature_cache = cache};
  }
};

template <class Options>
Options options_from(const RecognitionArguments& arguments) {
  Options from_file;
  if (!arguments.config.empty()) read_into(read_yaml(arguments.config), from_file, {});
  ConfigNode node = write_node(from_file);
  apply_overrides(node, arguments.overrides);
  Options options;
  read_into(node, options, {});
  return options;
}

template <class Options>
void declare_common(CLI::App& app, RecognitionArguments& arguments) {
  app.add_option("--jobs", arguments.jobs, "threads; where a recipe renders, processes too")
      ->check(CLI::Range(1, 1024))
      ->default_str("all cores");
  app.add_option(
      "--cache", arguments.cache,
      "folder where the views' features are kept for the next command, with the recordings "
      "of a recipe");
  app.add_option("--config", arguments.config, "YAML file of the keys below; --set comes after it");
  app.add_option("--set", arguments.overrides, "key=value of the keys below")
      ->type_size(1)
      ->allow_extra_args(false);
  app.add_flag("--skip-bad", arguments.skip_bad, "leave out views whose files are not complete");
  add_overwrite(app, arguments.overwrite);
  add_json(app, arguments.json);
  app.footer(
      [] { return "Keys of --set with their defaults:\n\n" + to_yaml(write_node(Options{})); });
}

/// A recording that was broken off is no recording to learn from.
/// @throws InputError naming what is missing, unless bad views are left out.
void require_whole(const fs::path& dataset, bool skip_bad) {
  constexpr std::size_t kMostNamed = 5;
  const std::vector<std::string> missing = missing_objects(dataset);
  if (missing.empty()) return;
  const std::vector<std::string> named(
      missing.begin(),
      missing.begin() + static_cast<std::ptrdiff_t>(std::min(missing.size(), kMostNamed)));
  const std::string what = fmt::format(
      "{}: rendering was broken off, {} missing: {}{}", dataset.string(),
      missing.size() == 1 ? "an object is" : fmt::format("{} objects are", missing.size()),
      fmt::join(named, ", "), missing.size() > kMostNamed ? ", ..." : "");
  if (!skip_bad) {
    throw InputError(what +
                     "; `vantage dataset render` with the same options renders the rest, "
                     "--skip-bad does without");
  }
  log_warning(what);
}

/// Of all datasets together: recordings of the same objects, or others.
DatasetIndex index_of(const std::vector<fs::path>& datasets,
                      const RecognitionArguments& arguments) {
  DatasetIndex all;
  for (const fs::path& dataset : datasets) {
    require_whole(dataset, arguments.skip_bad);
    const DatasetIndex index =
        index_dataset(dataset, arguments.skip_bad ? OnBadView::skip : OnBadView::fail);
    for (const SkippedView& skipped : index.skipped) log_warning(skipped.reason);
    all.views.insert(all.views.end(), index.views.begin(), index.views.end());
  }
  return all;
}

Json model_json(const fs::path& path, const RecognitionModel& model) {
  Json features = Json::array();
  for (const FeatureModel& feature : model.features) {
    features.push_back({{"name", feature.name},
                        {"dimensions", feature.statistics.dimensions()},
                        {"psi", feature.psi},
                        {"cost_s", feature.cost_s},
                        {"unknown", feature.unknown.has_value()}});
  }
  std::size_t views = 0;
  for (const int count : model.features.front().statistics.count) {
    views += static_cast<std::size_t>(count);
  }
  return {{"model", path.string()},
          {"objects", model.states.objects.size()},
          {"categories", model.states.categories.size()},
          {"states", model.states.size()},
          {"views", views},
          {"view_correlation", model.view_correlation},
          {"features", features}};
}

void print_model(const Json& model) {
  fmt::print("{}: {} objects in {} categories, {} states, {} views\n",
             model["model"].get<std::string>(), model["objects"].get<int>(),
             model["categories"].get<int>(), model["states"].get<int>(), model["views"].get<int>());
  for (const Json& feature : model["features"]) {
    fmt::print("{}: {} dimensions, psi {:.4g}, {:.2f} ms\n", feature["name"].get<std::string>(),
               feature["dimensions"].get<int>(), feature["psi"].get<double>(),
               1e3 * feature["cost_s"].get<double>());
  }
  const bool unknown = std::ranges::all_of(
      model["features"], [](const Json& feature) { return feature["unknown"].get<bool>(); });
  fmt::print("{}; views of one object repeat each other: correlation {:.2f}\n",
             unknown ? "knows what is unknown" : "takes every object for one of these",
             model["view_correlation"].get<double>());
}

/// Of the user: $XDG_CACHE_HOME/vantage or ~/.cache/vantage; beside the model for who has none.
fs::path default_cache(const fs::path& out) {
  const auto set = [](const char* name) {
    const char* value = std::getenv(name);
    return fs::path(value != nullptr ? value : "");
  };
  if (const fs::path cache = set("XDG_CACHE_HOME"); cache.is_absolute()) return cache / "vantage";
  if (const fs::path home = set("HOME"); home.is_absolute()) return home / ".cache" / "vantage";
  return out.string() + ".cache";
}

RecognitionModel model_of_recipe(const RecognitionArguments& arguments) {
  const ModelRecipe recipe = read_model_recipe(arguments.recipe, arguments.overrides);
  const fs::path cache = arguments.cache.empty() ? default_cache(arguments.out) : arguments.cache;
  log_info(fmt::format("recordings are kept in {}", (cache / "recordings").string()));
  return make_model(recipe, {.cache = cache,
                             .jobs = arguments.jobs,
                             .worker = own_render_worker(),
                             .stop = [] { return interrupt_signal() != 0; },
                             .poll = throw_if_interrupted});
}

RecognitionModel model_of_datasets(const RecognitionArguments& arguments) {
  const auto options = options_from<TrainingOptions>(arguments);
  if (arguments.model.empty()) {
    return train_recognition(index_of(arguments.datasets, arguments), options, arguments.how());
  }
  RecognitionModel model = read_recognition_model(arguments.model);
  extend_recognition(model, index_of(arguments.datasets, arguments), options, arguments.how());
  return model;
}

/// @throws ConfigError if the command line asks for neither or both ways of training.
void require_one_way(const RecognitionArguments& arguments) {
  if (arguments.recipe.empty()) {
    if (arguments.datasets.empty()) throw ConfigError("train: a dataset or --recipe is required");
    return;
  }
  for (const auto& [given, name] : {std::pair(!arguments.datasets.empty(), "datasets"),
                                    {!arguments.model.empty(), "--add-to"},
                                    {!arguments.config.empty(), "--config"},
                                    {arguments.skip_bad, "--skip-bad"}}) {
    if (given)
      throw ConfigError(fmt::format("--recipe says what is trained on; no {} with it", name));
  }
}

ExitCode train_command(const RecognitionArguments& arguments) {
  require_one_way(arguments);
  require_absent(arguments.out, arguments.overwrite);
  make_writable_directory(fs::absolute(arguments.out).parent_path());
  catch_interrupts();
  const RecognitionModel model =
      arguments.recipe.empty() ? model_of_datasets(arguments) : model_of_recipe(arguments);
  write_recognition_model(model, arguments.out);
  const Json summary = model_json(arguments.out, model);
  if (arguments.json) {
    fmt::print("{}", json_text(summary));
  } else {
    print_model(summary);
  }
  return ExitCode::done;
}

ExitCode evaluate_command(const RecognitionArguments& arguments) {
  const auto options = options_from<RecognitionStudyOptions>(arguments);
  prepare_recognition_study(arguments.out, arguments.overwrite);
  catch_interrupts();
  const RecognitionStudy study = run_recognition_study(
      read_recognition_model(arguments.model), index_of(arguments.datasets, arguments), options,
      arguments.how(), index_of(arguments.training, arguments));
  write_recognition_study(study, arguments.out);
  fmt::print("{}", arguments.json ? read_file(arguments.out / "summary.json")
                                  : read_file(arguments.out / "recognition.md"));
  return ExitCode::done;
}

}  // namespace

std::function<ExitCode()> declare_train(CLI::App& app) {
  auto arguments = std::make_shared<RecognitionArguments>();
  app.add_option("dataset", arguments->datasets,
                 "folders of views; of the same objects: more recordings of them");
  declare_common<TrainingOptions>(app, *arguments);
  app.add_option("--recipe", arguments->recipe,
                 "instead of folders: a YAML file that says what to render and how to train; what "
                 "is there of it is not rendered again. Keys of --set are then those of the file, "
                 "--cache by default the user's");
  app.add_option("--out", arguments->out, "model file to write")->required()->check(not_empty);
  app.add_option("--add-to", arguments->model,
                 "model to add the dataset's objects to; those it knows are not trained again");
  return [arguments] { return train_command(*arguments); };
}

std::function<ExitCode()> declare_evaluate(CLI::App& app) {
  auto arguments = std::make_shared<RecognitionArguments>();
  app.add_option("dataset", arguments->datasets,
                 "folders of views; objects that the model does not know count for their category, "
                 "and with `unknown_starts` as unknown ones")
      ->required();
  app.add_option("--training", arguments->training,
                 "folders of views that `baselines` are trained on; default: what the dataset has "
                 "beside the views that are tested");
  declare_common<RecognitionStudyOptions>(app, *arguments);
  app.add_option("--model", arguments->model, "trained model")->required();
  app.add_option("--out", arguments->out, "folder for results and tables")
      ->required()
      ->check(not_empty);
  return [arguments] { return evaluate_command(*arguments); };
}

}  // namespace vantage
