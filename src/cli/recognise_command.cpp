#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "vantage/cli/common_flags.hpp"
#include "vantage/cli/recognise_options.hpp"
#include "vantage/cli/recognition_commands.hpp"
#include "vantage/core/log.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/perception/dataset_reader.hpp"
#include "vantage/recognition/recognition.hpp"
#include "vantage/runtime/json.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kDegree_rad = std::numbers::pi / 180.0;

struct RecogniseArguments {
  fs::path model;
  std::vector<fs::path> files;
  std::vector<double> motion_deg;
  std::vector<std::string> overrides;
  double elevation_deg = 45.0;
  double max_depth_m = 0.0;
  int top = 5;
  bool json = false;
};

RecogniseOptions options_of(const RecogniseArguments& arguments) {
  ConfigNode node = write_node(RecogniseOptions{});
  apply_overrides(node, arguments.overrides);
  RecogniseOptions options;
  read_into(node, options, {});
  return options;
}

/// Turn of the camera before view `index`, from what was given or from the poses beside the files.
double motion_before(const RecogniseArguments& arguments, std::size_t index) {
  const std::vector<double>& given = arguments.motion_deg;
  if (given.size() == 1) return given.front() * kDegree_rad;
  if (!given.empty()) return given[index - 1] * kDegree_rad;
  const auto before = yaw_beside(arguments.files[2 * index - 2]);
  const auto now = yaw_beside(arguments.files[2 * index]);
  if (!before || !now) {
    throw ConfigError(fmt::format("--motion-deg: how far the camera turned before {} is not known",
                                  arguments.files[2 * index].string()));
  }
  return std::remainder(*before - *now, 2.0 * std::numbers::pi);
}

void check(const RecogniseArguments& arguments) {
  if (arguments.files.size() % 2 != 0) {
    throw ConfigError("views are pairs of files, an image and its depth; one is missing");
  }
  const std::size_t turns = arguments.files.size() / 2 - 1;
  const std::size_t given = arguments.motion_deg.size();
  if (given > 1 && given != turns) {
    throw ConfigError(fmt::format("--motion-deg: {} turns given, there are {}", given, turns));
  }
}

Json views_json(const Recognition& known) {
  Json views = Json::array();
  for (const ViewReport& view : known.views) {
    Json skipped = Json::array();
    for (const SkippedFeature& s : view.skipped) {
      skipped.push_back({{"feature", s.feature}, {"reason", s.reason}});
    }
    views.push_back({{"view_rad", view.view_rad},
                     {"features", view.features},
                     {"skipped", skipped},
                     {"entropy_bits", view.entropy_bits},
                     {"feature_time_s", view.feature_time_s},
                     {"selection_time_s", view.selection_time_s},
                     {"view_time_s", view.view_time_s}});
  }
  return views;
}

Json objects_json(const ObjectStates& states, const ObjectBelief& belief, int top) {
  const Eigen::VectorXd p = p_object(states, belief);
  std::vector<int> order(static_cast<std::size_t>(p.size()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater{}, [&](int k) { return p[k]; });
  order.resize(std::min(order.size(), static_cast<std::size_t>(top)));
  Json objects = Json::array();
  for (const int k : order) {
    const auto index = static_cast<std::size_t>(k);
    const auto category = static_cast<std::size_t>(states.category_of[index]);
    objects.push_back({{"object", states.objects[index]},
                       {"category", states.categories[category]},
                       {"probability", p[k]},
                       {"yaw_deg", mean_yaw_rad(states, belief, k) / kDegree_rad}});
  }
  return objects;
}

/// Where to look next, of the turns by whole bins.
Json next_json(const Recogniser& recogniser, const RecognitionOptions& options,
               const Recognition& known, Rng& rng) {
  std::vector<ObjectViewAction> actions;
  for (int turn = 1; turn < recogniser.states.bins; ++turn) {
    actions.push_back({.yaw_rad = turn * recogniser.states.bin_rad()});
  }
  const NextView next = next_view(recogniser, options, known, actions, rng);
  const std::size_t best = next.decision.action;
  return {{"turn_deg", actions[best].yaw_rad / kDegree_rad},
          {"gain_bits", next.decision.scores[best].gain.bits},
          {"view_time_s", next.time_s}};
}

void print_result(const Json& result) {
  for (const Json& object : result["objects"]) {
    fmt::print("{:6.2f} %  {} ({}), yaw {:.0f} deg\n", 100.0 * object["probability"].get<double>(),
               object["object"].get<std::string>(), object["category"].get<std::string>(),
               object["yaw_deg"].get<double>());
  }
  for (const Json& view : result["views"]) {
    fmt::print("view at {:.0f} deg: {}; entropy {:.3f} bits\n",
               view["view_rad"].get<double>() / kDegree_rad,
               fmt::join(view["features"].get<std::vector<std::string>>(), ", "),
               view["entropy_bits"].get<double>());
  }
  fmt::print("{}; look next after a turn by {:.0f} deg\n",
             result["sure"].get<bool>() ? "sure" : "not sure",
             result["next"]["turn_deg"].get<double>());
}

ExitCode recognise_command(const RecogniseArguments& arguments) {
  check(arguments);
  const RecogniseOptions options = options_of(arguments);
  PairSetting setting;
  setting.max_depth_m = arguments.max_depth_m;
  std::vector<ObjectView> views;
  for (std::size_t i = 0; i < arguments.files.size(); i += 2) {
    views.push_back(load_image_pair(arguments.files[i], arguments.files[i + 1], setting).view);
  }
  const Recogniser recogniser = load_recogniser(arguments.model, options.recogniser, 1);
  Recognition known = begin_recognition(recogniser);
  Rng rng = Rng::stream(options.seed, "recognise");
  double bearing_rad = 0.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const double motion_rad = i == 0 ? 0.0 : motion_before(arguments, i);
    predict_motion(recogniser, options.recognition, motion_rad, known);
    bearing_rad += motion_rad;
    update_with_view(recogniser, options.recognition, extract_from(recogniser, views[i]),
                     bearing_rad, known, rng);
    for (const SkippedFeature& s : known.views.back().skipped) {
      log_warning(fmt::format("{}: {}: {}", arguments.files[2 * i].string(), s.feature, s.reason));
    }
  }
  const Json result{
      {"objects", objects_json(recogniser.states, known.belief, arguments.top)},
      {"entropy_bits", known.views.back().entropy_bits},
      {"sure", seen_enough(options.recognition.enough, recogniser.states, p_state(known.belief))
                   .has_value()},
      {"views", views_json(known)},
      {"next", next_json(recogniser, options.recognition, known, rng)}};
  if (arguments.json) {
    fmt::print("{}", json_text(result));
  } else {
    print_result(result);
  }
  return ExitCode::done;
}

}  // namespace

std::function<ExitCode()> declare_recognise(CLI::App& app) {
  auto arguments = std::make_shared<RecogniseArguments>();
  app.add_option("files", arguments->files,
                 "RGB DEPTH of each view, in order; of <stem>_crop.png the mask, place and pose "
                 "beside it are used")
      ->required();
  app.add_option("--model", arguments->model, "trained model")->required();
  app.add_option("--motion-deg", arguments->motion_deg,
                 "turn of the camera about the object before each further view, counter-clockwise "
                 "from above: one for all or one each; default: from the poses beside the files")
      ->delimiter(',')
      ->type_size(1)
      ->allow_extra_args(false);
  app.add_option("--elevation-deg", arguments->elevation_deg,
                 "of the camera, where the file's name does not tell")
      ->check(CLI::Range(0.0, 90.0))
      ->capture_default_str();
  app.add_option("--farthest-m", arguments->max_depth_m,
                 "without a mask, the object is what is nearer; 0: everything")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--top", arguments->top, "objects to print")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_option("--set", arguments->overrides, "key=value of the keys below")
      ->type_size(1)
      ->allow_extra_args(false);
  add_json(app, arguments->json);
  app.footer([] {
    return "Keys of --set with their defaults:\n\n" + to_yaml(write_node(RecogniseOptions{}));
  });
  return [arguments] { return recognise_command(*arguments); };
}

}  // namespace vantage
