#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "vantage/cli/pictures/picture_commands.hpp"
#include "vantage/dataset/pictures/check_dataset.hpp"
#include "vantage/dataset/pictures/dataset_differences.hpp"
#include "vantage/dataset/pictures/picture_layout.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/json.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct CheckArguments {
  fs::path root;
  fs::path test;
  int bins = 0;
};

/// A folder that was not imported is told apart from one with nothing in it.
CheckedDataset checked(const fs::path& root, int bins) {
  try {
    return check_dataset(root, bins, throw_if_interrupted);
  } catch (const InputError& error) {
    std::size_t pictures = 0;
    try {
      pictures = find_pictures(root, "").pictures.size();
    } catch (const InputError&) {
      throw error;
    }
    throw InputError(
        fmt::format("{}: {} pictures, but no dataset yet: vantage dataset import {} --out DIR",
                    root.string(), pictures, root.string()));
  }
}

Json spread_json(const Spread& spread) {
  return {{"least", spread.least}, {"median", spread.median}, {"most", spread.most}};
}

Json check_json(const CheckedDataset& dataset) {
  Json objects = Json::array();
  for (const CheckedObject& object : dataset.objects) {
    objects.push_back({{"object", object.object},
                       {"views", object.views},
                       {"recordings", object.recordings},
                       {"directions", object.bins},
                       {"directions_of_one_view", object.thin_bins},
                       {"holes", object.holes},
                       {"size_m", object.size_m}});
  }
  return {{"root", dataset.root.string()},
          {"cut", to_string(dataset.cut)},
          {"bins", dataset.bins},
          {"focal_px", dataset.focal_px},
          {"views", dataset.views},
          {"objects", objects},
          {"holes", spread_json(dataset.holes)},
          {"mask", spread_json(dataset.mask)},
          {"distance_m", spread_json(dataset.distance_m)},
          {"problems", dataset.problems},
          {"advice", dataset.advice}};
}

void print_check(const CheckedDataset& dataset) {
  fmt::print("{}: {} views of {} objects, cut by {}, focal length {} px\n", dataset.root.string(),
             dataset.views, dataset.objects.size(), to_string(dataset.cut), dataset.focal_px);
  fmt::print("{:<24} {:>6} {:>11} {:>11} {:>8} {:>8}\n", "object", "views", "recordings",
             "directions", "holes", "size m");
  for (const CheckedObject& object : dataset.objects) {
    fmt::print("{:<24} {:>6} {:>11} {:>6} of {:>1} {:>6.0f} % {:>8.3f}\n", object.object,
               object.views, object.recordings, object.bins, dataset.bins, 100.0 * object.holes,
               object.size_m);
  }
  fmt::print(
      "without depth on the object: {:.0f} % ({:.0f} to {:.0f} %); object at {:.2f} m ({:.2f} to "
      "{:.2f} m)\n",
      100.0 * dataset.holes.median, 100.0 * dataset.holes.least, 100.0 * dataset.holes.most,
      dataset.distance_m.median, dataset.distance_m.least, dataset.distance_m.most);
  for (const std::string& problem : dataset.problems) fmt::print("problem: {}\n", problem);
  for (const std::string& advice : dataset.advice) fmt::print("note: {}\n", advice);
}

ExitCode check_command(const CheckArguments& arguments, const PictureFlags& flags) {
  catch_interrupts();
  const CheckedDataset training = checked(arguments.root, arguments.bins);
  bool problems = !training.problems.empty();
  Json result = check_json(training);
  if (!flags.json) print_check(training);
  if (!arguments.test.empty()) {
    const CheckedDataset test = checked(arguments.test, arguments.bins);
    problems = problems || !test.problems.empty();
    result["test"] = check_json(test);
    result["differences"] = Json::array();
    if (!flags.json) print_check(test);
    for (const DatasetDifference& difference : differences(training, test)) {
      problems = problems || difference.problem;
      result["differences"].push_back({{"text", difference.text}, {"problem", difference.problem}});
      if (!flags.json) {
        fmt::print("{}: {}\n", difference.problem ? "problem" : "note", difference.text);
      }
    }
  }
  if (flags.json) {
    fmt::print("{}", json_text(result));
  } else {
    fmt::print("{}\n", problems ? "there are problems" : "no problem found");
  }
  return problems ? ExitCode::bad_input : ExitCode::done;
}

}  // namespace

std::function<ExitCode()> declare_check(CLI::App& app,
                                        const std::shared_ptr<const PictureFlags>& flags) {
  auto arguments = std::make_shared<CheckArguments>();
  app.add_option("root", arguments->root, "folder of the dataset, to train on")->required();
  app.add_option("--test", arguments->test,
                 "another one, to test on: also what differs between the two");
  app.add_option("--bins", arguments->bins,
                 "viewing directions of the model; default: those of the dataset")
      ->check(CLI::Range(2, 3600));
  return [arguments, flags] { return check_command(*arguments, *flags); };
}

}  // namespace vantage
