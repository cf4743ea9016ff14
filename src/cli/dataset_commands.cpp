#include "vantage/cli/dataset_commands.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "vantage/cli/common_flags.hpp"
#include "vantage/cli/hints/text_check.hpp"
#include "vantage/cli/pictures/picture_commands.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/dataset/contact_sheet.hpp"
#include "vantage/dataset/render_dataset.hpp"
#include "vantage/perception/dataset_reader.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/json.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

struct RenderArguments {
  std::vector<std::string> overrides;
  std::string objects, step_deg, seed, models;
  DatasetRun run{.root = {},
                 .jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency())),
                 .worker = own_render_worker()};
  bool json = false;
};

DatasetOptions render_options(const RenderArguments& arguments) {
  ConfigNode node = write_node(DatasetOptions{});
  std::vector<std::string> overrides = arguments.overrides;
  const std::array<std::pair<std::string, std::string>, 4> flags{{{"objects", arguments.objects},
                                                                  {"step_deg", arguments.step_deg},
                                                                  {"seed", arguments.seed},
                                                                  {"models", arguments.models}}};
  for (const auto& [key, value] : flags) {
    if (!value.empty()) overrides.push_back(fmt::format("{}={}", key, value));
  }
  apply_overrides(node, overrides);
  DatasetOptions options;
  read_into(node, options, {});
  return options;
}

ExitCode render_command(const RenderArguments& arguments) {
  const DatasetOptions options = render_options(arguments);
  DatasetRun run = arguments.run;
  run.stop = [] { return interrupt_signal() != 0; };
  catch_interrupts();
  const double start_s = wall_s();
  const DatasetOutcome outcome = render_dataset(options, run);
  const double time_s = wall_s() - start_s;
  if (arguments.json) {
    fmt::print("{}", json_text({{"root", run.root.string()},
                                {"objects", outcome.objects},
                                {"rendered", outcome.rendered},
                                {"views", outcome.views},
                                {"time_s", time_s}}));
  } else {
    fmt::print("{}: {} objects complete, {} of them and {} views in {:.1f} s\n", run.root.string(),
               outcome.objects, outcome.rendered, outcome.views, time_s);
  }
  if (outcome.stopped) return static_cast<ExitCode>(128 + interrupt_signal());
  return ExitCode::done;
}

std::function<ExitCode()> declare_render(CLI::App& app) {
  auto arguments = std::make_shared<RenderArguments>();
  app.add_option("out", arguments->run.root, "folder of the dataset")->required()->check(not_empty);
  app.add_option("--objects", arguments->objects, "the first so many; default 326")
      ->check(not_empty);
  app.add_option("--step-deg", arguments->step_deg, "of the turntable between views; default 20")
      ->check(not_empty);
  app.add_option("--seed", arguments->seed, "of every random stream")->check(whole_number);
  app.add_option("--models", arguments->models,
                 "folder of scanned objects, <name>/{model.obj, texture.png}, instead of our own")
      ->check(not_empty);
  app.add_option("--jobs", arguments->run.jobs, "objects rendered at a time, each in a process")
      ->check(CLI::Range(1, 1024))
      ->default_str("all cores");
  app.add_option("--set", arguments->overrides, "key=value of the keys below")
      ->type_size(1)
      ->allow_extra_args(false);
  add_overwrite(app, arguments->run.overwrite);
  add_json(app, arguments->json);
  app.footer([] {
    return "Goes on where another call with the same options ended.\n"
           "Keys of --set with their defaults:\n\n" +
           to_yaml(write_node(DatasetOptions{}));
  });
  return [arguments] { return render_command(*arguments); };
}

struct InfoArguments {
  fs::path root;
  bool check = false;
  bool json = false;
};

std::uintmax_t bytes_below(const fs::path& root) {
  std::uintmax_t bytes = 0;
  std::error_code error;
  constexpr auto kReadable = fs::directory_options::skip_permission_denied;
  for (const auto& entry : fs::recursive_directory_iterator(root, kReadable)) {
    if (entry.is_regular_file(error)) bytes += entry.file_size(error);
  }
  return bytes;
}

nlohmann::ordered_json info_json(const fs::path& root, const DatasetIndex& index) {
  std::set<std::string> categories;
  std::set<std::string> objects;
  std::map<std::string, std::size_t> videos;
  std::map<std::pair<std::string, int>, std::size_t> states;
  for (const ViewEntry& view : index.views) {
    categories.insert(view.name.category);
    objects.insert(view.name.object);
    ++videos[std::to_string(view.name.video)];
    const int bin = view.notes ? yaw_bin(view.yaw_rad, view.notes->bins) : yaw_bin(view.yaw_rad);
    ++states[{view.name.object, bin}];
  }
  const auto smallest =
      std::ranges::min_element(states, {}, [](const auto& state) { return state.second; });
  nlohmann::ordered_json problems = nlohmann::ordered_json::array();
  for (const SkippedView& skipped : index.skipped) problems.push_back(skipped.reason);
  return {
      {"root", root.string()},
      {"categories", categories.size()},
      {"objects", objects.size()},
      {"views", index.views.size()},
      {"views_of_video", videos},
      {"states", states.size()},
      {"views_of_state",
       {{"least", smallest->second},
        {"mean", static_cast<double>(index.views.size()) / static_cast<double>(states.size())}}},
      {"bytes", bytes_below(root)},
      {"problems", problems}};
}

void print_info(const nlohmann::ordered_json& info) {
  fmt::print("{}: {} objects in {} categories, {} views, {:.1f} MB\n",
             info["root"].get<std::string>(), info["objects"].get<int>(),
             info["categories"].get<int>(), info["views"].get<int>(),
             1e-6 * info["bytes"].get<double>());
  for (const auto& [video, count] : info["views_of_video"].items()) {
    fmt::print("video {}: {} views\n", video, count.get<int>());
  }
  fmt::print("views of an object in a yaw bin: {} at least, {:.1f} on average, {} states\n",
             info["views_of_state"]["least"].get<int>(),
             info["views_of_state"]["mean"].get<double>(), info["states"].get<int>());
}

ExitCode info_command(const InfoArguments& arguments) {
  DatasetIndex index = index_dataset(arguments.root, OnBadView::skip);
  if (arguments.check) {
    for (const ViewEntry& view : index.views) load_view(view, index.skipped);
  }
  const auto info = info_json(arguments.root, index);
  for (const SkippedView& skipped : index.skipped) log_warning(skipped.reason);
  if (arguments.json) {
    fmt::print("{}", json_text(info));
  } else {
    print_info(info);
    const std::string options = dataset_options_text(arguments.root);
    if (!options.empty()) fmt::print("\n{}", options);
  }
  return index.skipped.empty() ? ExitCode::done : ExitCode::bad_input;
}

std::function<ExitCode()> declare_info(CLI::App& app) {
  auto arguments = std::make_shared<InfoArguments>();
  app.add_option("root", arguments->root, "folder of the dataset")->required();
  app.add_flag("--check", arguments->check, "open every view, not only its name");
  add_json(app, arguments->json);
  return [arguments] { return info_command(*arguments); };
}

struct SheetArguments {
  fs::path root;
  fs::path out;
  double yaw_deg = 300.0;
  ContactSheetOptions options;
  bool overwrite = false;
  bool json = false;
};

std::function<ExitCode()> declare_contact_sheet(CLI::App& app) {
  auto arguments = std::make_shared<SheetArguments>();
  ContactSheetOptions& options = arguments->options;
  app.add_option("root", arguments->root, "folder of the dataset")->required();
  app.add_option("--out", arguments->out, "PNG to write")->required()->check(not_empty);
  app.add_option("--video", options.video, "1, 2 or 4: 30, 45 or 60 deg")
      ->check(CLI::IsMember({1, 2, 4}))
      ->capture_default_str();
  app.add_option("--yaw-deg", arguments->yaw_deg, "the view nearest to it is shown")
      ->capture_default_str();
  app.add_option("--cell", options.cell_px, "side of an image, px")
      ->check(CLI::Range(16, 640))
      ->capture_default_str();
  app.add_option("--columns", options.columns, "images in a row")
      ->check(CLI::Range(1, 200))
      ->capture_default_str();
  add_overwrite(app, arguments->overwrite);
  add_json(app, arguments->json);
  return [arguments] {
    require_absent(arguments->out, arguments->overwrite);
    arguments->options.yaw_rad = arguments->yaw_deg * std::numbers::pi / 180.0;
    write_contact_sheet(index_dataset(arguments->root), arguments->options, arguments->out);
    const std::string image = arguments->out.string();
    fmt::print("{}", arguments->json ? json_text({{"image", image}}) : image + "\n");
    return ExitCode::done;
  };
}

std::function<ExitCode()> declare_own_import(CLI::App& app) {
  auto flags = std::make_shared<PictureFlags>();
  add_overwrite(app, flags->overwrite);
  add_json(app, flags->json);
  return declare_import(app, flags);
}

std::function<ExitCode()> declare_own_check(CLI::App& app) {
  auto flags = std::make_shared<PictureFlags>();
  add_json(app, flags->json);
  return declare_check(app, flags);
}

struct Part {
  const char* name;
  const char* help;
  std::function<ExitCode()> (*declare)(CLI::App& app);
};

constexpr std::array kParts{
    Part{"render", "render objects on a turntable as the RGB-D Object Dataset has them",
         declare_render},
    Part{"import", "take in RGB-D pictures of your own", declare_own_import},
    Part{"check", "what is wrong with a dataset, or may be, before it is trained on",
         declare_own_check},
    Part{"info", "how many objects and views a dataset has, and what is wrong with it",
         declare_info},
    Part{"contact-sheet", "an image of every object", declare_contact_sheet},
};

}  // namespace

std::vector<std::string> own_render_worker() {
  return {"/proc/self/exe", std::string(kRenderWorker)};
}

std::function<ExitCode()> declare_dataset(CLI::App& app) {
  app.require_subcommand(1);
  std::vector<std::pair<const CLI::App*, std::function<ExitCode()>>> actions;
  for (const Part& part : kParts) {
    CLI::App* sub = app.add_subcommand(part.name, part.help);
    actions.emplace_back(sub, part.declare(*sub));
  }
  return [actions] {
    const auto chosen =
        std::ranges::find_if(actions, [](const auto& action) { return action.first->parsed(); });
    expects(chosen != actions.end(), "a subcommand is required");
    return chosen->second();
  };
}

}  // namespace vantage
