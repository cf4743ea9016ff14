#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vantage/cli/common_flags.hpp"
#include "vantage/cli/recognise_options.hpp"
#include "vantage/cli/recognition/recognise_result.hpp"
#include "vantage/cli/recognition_commands.hpp"
#include "vantage/core/log.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/perception/dataset_reader.hpp"
#include "vantage/recognition/dataset/picture_views.hpp"
#include "vantage/recognition/recognition.hpp"
#include "vantage/runtime/json.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

struct RecogniseArguments {
  fs::path model;
  std::vector<fs::path> files;
  std::vector<double> motion_deg;
  std::vector<std::string> view_names;
  std::vector<std::string> overrides;
  std::optional<double> elevation_deg;
  std::optional<double> focal_px;
  double depth_unit_m = 0.0;
  std::string cut = "auto";
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

/// Where the view is in the circle of those that the model knows by name; nothing if it has no name
/// that the model knows.
std::optional<double> named_yaw_rad(const RecogniseArguments& arguments,
                                    const std::optional<PictureNotes>& notes, std::size_t index) {
  const bool given = !arguments.view_names.empty();
  if (!notes && given) throw ConfigError("--view-names: the model knows no views by name");
  if (!notes) return std::nullopt;
  const std::string name =
      given ? arguments.view_names[index] : view_name_beside(arguments.files[2 * index]);
  const auto bin = bin_of_view(*notes, name);
  if (given && !bin) {
    throw ConfigError(fmt::format("--view-names: the model has no view '{}'; known: {}", name,
                                  named_views(*notes)));
  }
  return bin ? std::optional(*bin * 2.0 * std::numbers::pi / notes->bins) : std::nullopt;
}

/// Turn of the camera before view `index`, from what was given, the names of the views or the
/// poses beside the files; nothing if it is not known.
std::optional<double> motion_before(const RecogniseArguments& arguments,
                                    const std::optional<PictureNotes>& notes, std::size_t index) {
  const std::vector<double>& given = arguments.motion_deg;
  if (given.size() == 1) return given.front() * kDegree_rad;
  if (!given.empty()) return given[index - 1] * kDegree_rad;
  auto before = named_yaw_rad(arguments, notes, index - 1);
  auto now = named_yaw_rad(arguments, notes, index);
  if ((!before || !now) && (!notes || notes->degrees)) {
    before = yaw_beside(arguments.files[2 * index - 2]);
    now = yaw_beside(arguments.files[2 * index]);
  }
  if (!before || !now) return std::nullopt;
  return std::remainder(*before - *now, 2.0 * std::numbers::pi);
}

void check(const RecogniseArguments& arguments) {
  if (arguments.files.size() % 2 != 0) {
    throw ConfigError("views are pairs of files, an image and its depth; one is missing");
  }
  const std::size_t turns = arguments.files.size() / 2 - 1;
  const std::size_t given = arguments.motion_deg.size();
  if (!arguments.view_names.empty() && arguments.view_names.size() != turns + 1) {
    throw ConfigError(fmt::format("--view-names: {} names given, there are {} views",
                                  arguments.view_names.size(), turns + 1));
  }
  if (given > 1 && given != turns) {
    throw ConfigError(fmt::format("--motion-deg: {} turns given, there are {}", given, turns));
  }
  if (turns == 0 && (given > 0 || !arguments.view_names.empty())) {
    log_warning("--motion-deg and --view-names tell turns between views; there is one view");
  }
}

/// That of rendered objects is not in their model: along their outline, or by depth.
void warn_of_cut(const std::string& file, ObjectCut by, const std::optional<PictureNotes>& notes) {
  log_warning(fmt::format("{}: cut by {}, {}: it will be wrong more often", file, to_string(by),
                          notes ? "the model learnt from pictures cut by " + notes->cut
                                : "the model does not tell how its own were; if by masks"));
}

/// The views, cut as the model's were, of a camera as the model's.
std::vector<ObjectView> read_views(const RecogniseArguments& arguments, ObjectCut cut,
                                   const std::optional<PictureNotes>& notes) {
  PairSetting setting;
  if (arguments.elevation_deg) setting.elevation_rad = *arguments.elevation_deg * kDegree_rad;
  setting.max_depth_m = arguments.max_depth_m;
  setting.focal_px = arguments.focal_px;
  setting.usual = notes;
  setting.depth_unit_m = arguments.depth_unit_m;
  // Told how far the object reaches, all that is nearer is the object.
  const bool by_distance = arguments.max_depth_m > 0.0 && cut == ObjectCut::mask;
  setting.cut = arguments.cut != "auto" ? std::optional(object_cut_of(arguments.cut, "--cut"))
                : by_distance           ? std::nullopt
                                        : std::optional(cut);
  std::vector<ObjectView> views;
  for (std::size_t i = 0; i < arguments.files.size(); i += 2) {
    ImagePair pair = load_image_pair(arguments.files[i], arguments.files[i + 1], setting);
    const std::string file = arguments.files[i].string();
    constexpr int kLeast_px = 8;
    if (std::min(pair.view.width_px, pair.view.height_px) < kLeast_px) {
      throw InputError(fmt::format("{}: the object is {} x {} px; at least {} x {} are needed",
                                   file, pair.view.width_px, pair.view.height_px, kLeast_px,
                                   kLeast_px));
    }
    if (pair.cut != cut && !by_distance) warn_of_cut(file, pair.cut, notes);
    views.push_back(std::move(pair.view));
  }
  return views;
}

void take_views(const RecogniseArguments& arguments, const RecogniseOptions& options,
                const Recogniser& recogniser, const std::optional<PictureNotes>& notes,
                const std::vector<ObjectView>& views, Recognition& known, Rng& rng) {
  double bearing_rad = 0.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto motion = i == 0 ? std::optional(0.0) : motion_before(arguments, notes, i);
    if (motion) {
      predict_motion(recogniser, options.recognition, *motion, known);
      bearing_rad += *motion;
    } else {
      forget_yaw(recogniser.states, recogniser.unseen, known.belief);
      log_info(
          fmt::format("{}: how far the camera turned before is not known; --motion-deg or "
                      "--view-names tells",
                      arguments.files[2 * i].string()));
    }
    update_with_view(recogniser, options.recognition, extract_from(recogniser, views[i]),
                     bearing_rad, known, rng);
    const ViewReport& report = known.views.back();
    for (const SkippedFeature& s : report.skipped) {
      log_warning(fmt::format("{}: {}: {}", arguments.files[2 * i].string(), s.feature, s.reason));
    }
    if (report.features.empty() && !report.skipped.empty()) {
      throw InputError(fmt::format("{}: no feature can be extracted: {}",
                                   arguments.files[2 * i].string(), report.skipped.front().reason));
    }
  }
}

ExitCode recognise_command(const RecogniseArguments& arguments) {
  check(arguments);
  const RecogniseOptions options = options_of(arguments);
  const RecognitionModel model = read_recognition_model(arguments.model);
  const std::optional<PictureNotes> notes = notes_of(model);
  const std::vector<ObjectView> views = read_views(arguments, cut_of(model), notes);
  const Recogniser recogniser = load_recogniser(arguments.model, options.recogniser, 1);
  Recognition known = begin_recognition(recogniser);
  Rng rng = Rng::stream(options.seed, "recognise");
  take_views(arguments, options, recogniser, notes, views, known, rng);
  const auto result =
      recognition_json(recogniser, options.recognition, notes, known, arguments.top, rng);
  if (arguments.json) {
    fmt::print("{}", json_text(result));
  } else {
    print_recognition(result);
  }
  return ExitCode::done;
}

}  // namespace

std::function<ExitCode()> declare_recognise(CLI::App& app) {
  auto arguments = std::make_shared<RecogniseArguments>();
  app.add_option("files", arguments->files,
                 "RGB DEPTH of each view, in order; of <stem>_crop.png the mask, place and pose "
                 "beside it are used, of front_depth.png the mask front_mask.png")
      ->required();
  app.add_option("--model", arguments->model, "trained model")->required();
  app.add_option("--motion-deg", arguments->motion_deg,
                 "turn of the camera about the object before each further view, counter-clockwise "
                 "from above: one for all or one each; default: from the poses beside the files")
      ->delimiter(',')
      ->type_size(1)
      ->allow_extra_args(false);
  app.add_option("--view-names", arguments->view_names,
                 "names of the views, of a model that knows them by name: front,left,...")
      ->delimiter(',')
      ->type_size(1)
      ->allow_extra_args(false);
  app.add_option("--elevation-deg", arguments->elevation_deg,
                 "how far the camera looks down; default: from the files beside, else from the "
                 "table that the picture shows, else 45")
      ->check(CLI::Range(-90.0, 90.0));
  app.add_option(
         "--focal-px", arguments->focal_px,
         "focal length of the camera; default: of the dataset beside, else of the model's own "
         "pictures, else 570.3")
      ->check(CLI::Range(10.0, 1e5));
  app.add_option("--depth-unit-m", arguments->depth_unit_m,
                 "what 1 in a depth file stands for; 0: integers are mm, floats by their size")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option(
         "--cut", arguments->cut,
         "how the object is told from its surroundings: mask, depth, whole; auto: as in the "
         "model's own pictures, by depth where a mask is missing")
      ->check(CLI::IsMember({"auto", "mask", "depth", "whole"}))
      ->capture_default_str();
  app.add_option("--farthest-m", arguments->max_depth_m,
                 "what is farther is not the object; 0: nothing is")
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
