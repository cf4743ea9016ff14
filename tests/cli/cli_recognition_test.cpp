// `vantage train`, `recognise` and `evaluate` on a dataset of painted blocks.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

#include "tests/cli/command_line.hpp"
#include "tests/perception/features/onnx_bytes.hpp"
#include "tests/recognition/painted_dataset.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {

using nlohmann::json;

constexpr auto kTrain = "train data --out model -q --set 'features=[colour,bounding_box]' ";
constexpr auto kRecognise = "recognise --model model --json ";
/// A view of the test video, its image and its depth.
constexpr auto kRed = "data/mug/mug_1/mug_1_2_3_crop.png data/mug/mug_1/mug_1_2_3_depthcrop.png";

class RecognitionCommands : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    put({"mug", "mug_1", 0});
    put({"mug", "mug_2", 60});
    put({"can", "can_1", 120});
  }
  void put(const test::PaintedObject& object, const char* dataset = "data", int frames = 16) {
    test::put_painted_object(folder_ / dataset, object, frames);
  }
  fs::path view(const std::string& suffix) const {
    return folder_ / "data/mug/mug_1" / ("mug_1_2_3_" + suffix);
  }
  json parsed(const std::string& arguments) {
    const Result result = vantage(arguments + " 2>/dev/null");
    EXPECT_EQ(result.exit_code, 0) << vantage(arguments).output;
    json value = json::parse(result.output, nullptr, false);
    EXPECT_TRUE(value.is_object()) << result.output;
    return value;
  }
  void train() { ASSERT_EQ(vantage(kTrain).exit_code, 0); }
  std::size_t cached_files() const {
    std::size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "cache")) {
      count += entry.is_regular_file() ? 1 : 0;
    }
    return count;
  }
};

/// Every probability of a result is one.
void expect_finite(const json& result) {
  ASSERT_TRUE(result["unknown_probability"].is_number()) << result;
  double sum = result["unknown_probability"].get<double>();
  for (const json& object : result["objects"]) {
    ASSERT_TRUE(object["probability"].is_number()) << result;  // NaN is null in JSON
    sum += object["probability"].get<double>();
  }
  EXPECT_NEAR(sum, 1.0, 1e-6);
}

TEST_F(RecognitionCommands, TrainEvaluateRecognise) {
  const json model = parsed(std::string(kTrain) + "--json");
  EXPECT_EQ(model["objects"], 3);
  EXPECT_EQ(model["states"], 24);
  EXPECT_EQ(model["views"], 2 * 3 * 16);
  EXPECT_EQ(model["features"][0]["name"], "colour");

  const json known = parsed(std::string(kRecognise) + kRed);
  EXPECT_EQ(known["objects"][0]["object"], "mug_1");
  EXPECT_EQ(known["objects"][0]["category"], "mug");
  expect_finite(known);

  const json study = parsed(
      "evaluate data --model model --out tables -q --json --set starts=40 --set change_starts=4 "
      "--set 'methods=[\"single view, all features\",mutual_information]'");
  EXPECT_EQ(study["starts"], 40);
  EXPECT_EQ(study["methods"][1]["method"], "mutual_information");
  EXPECT_GT(study["methods"][1]["accuracy_percent"]["mean"], 90.0);
  EXPECT_EQ(study["changes"].size(), 15U);
  for (const char* name : {"config.yaml", "results.csv", "changes.csv", "recognition.md"}) {
    EXPECT_TRUE(fs::exists(folder_ / "tables" / name)) << name;
  }
}

TEST_F(RecognitionCommands, AddsObjectsAndLeavesTheOthersAsTheyAre) {
  train();
  put({"can", "can_2", 150}, "more");
  const std::string add = "train more --add-to model --out larger -q ";
  const json larger = parsed(add + "--json");
  EXPECT_EQ(larger["objects"], 4);
  EXPECT_EQ(larger["categories"], 2);
  const std::string green =
      " more/can/can_2/can_2_2_5_crop.png more/can/can_2/can_2_2_5_depthcrop.png";
  EXPECT_EQ(parsed("recognise --model larger --json" + green)["objects"][0]["object"], "can_2");
  EXPECT_EQ(parsed("recognise --model larger --json " + std::string(kRed))["objects"][0]["object"],
            "mug_1");
  expect_error(vantage("train data --add-to model --out other -q"), 3, {"can_1", "already"});
}

TEST_F(RecognitionCommands, AModelOrATableIsNotReplacedUnasked) {
  train();
  const std::string model = read_file(folder_ / "model");
  expect_error(vantage(kTrain), 2, {"--out model", "--overwrite"});
  expect_error(vantage("train data --add-to model --out model -q"), 2, {"--overwrite"});
  EXPECT_EQ(read_file(folder_ / "model"), model);
  EXPECT_EQ(vantage(std::string(kTrain) + "--overwrite").exit_code, 0);
  fs::create_directories(folder_ / "tables");
  write_file(folder_ / "tables/summary.json", "{}");
  const std::string evaluate = "evaluate data --model model --out tables -q --set starts=4 ";
  expect_error(vantage(evaluate), 2, {"--out tables", "summary.json", "--overwrite"});
  EXPECT_EQ(read_file(folder_ / "tables/summary.json"), "{}");
  EXPECT_EQ(vantage(evaluate + "--overwrite").exit_code, 0);
  EXPECT_NE(read_file(folder_ / "tables/summary.json"), "{}");
}

TEST_F(RecognitionCommands, WeightsOfWhatMotionsCostAreRefused) {
  train();
  for (const std::string key : {"weight_per_s", "weight_per_m", "weight_per_j"}) {
    const std::string set = " -q --set recognition.views." + key + "=0.5";
    const std::vector<std::string> parts{"recognition.views." + key + ": 0.5", "must be 0"};
    expect_error(vantage(std::string("recognise --model model ") + kRed + set), 2, parts);
    expect_error(vantage("evaluate data --model model --out tables" + set), 2, parts);
  }
  EXPECT_FALSE(fs::exists(folder_ / "tables"));
}

TEST_F(RecognitionCommands, TrainsOnSeveralRecordingsOfTheSameObjects) {
  put({"mug", "mug_1", 3}, "again");  // in other light: copies would count once
  put({"can", "can_3", 90}, "again");
  const json model = parsed("train data again --out model -q --json --set 'features=[colour]'");
  EXPECT_EQ(model["objects"], 4);
  EXPECT_EQ(model["views"], 2 * (3 + 2) * 16);
  expect_error(vantage("train data nowhere --out other -q"), 3, {"nowhere"});
}

TEST_F(RecognitionCommands, FeaturesAreExtractedOnce) {
  const json first = parsed(std::string(kTrain) + "--cache cache --json");
  const std::size_t files = cached_files();
  EXPECT_GT(files, 0U);
  const std::string model = read_file(folder_ / "model");
  const json second = parsed(std::string(kTrain) + "--cache cache --json --overwrite");
  EXPECT_EQ(cached_files(), files);
  EXPECT_EQ(first["features"][0]["psi"], second["features"][0]["psi"]);
  EXPECT_EQ(first["features"][1]["psi"], second["features"][1]["psi"]);
}

TEST_F(RecognitionCommands, InterruptedTrainingKeepsWhatItExtracted) {
  put({"can", "can_1", 120}, "data", 200);
  const Result result =
      shell("cd '" + folder_.string() +
            "' && ( " VANTAGE_BINARY
            " train data --out model --jobs 1 --cache cache > log 2>&1 & pid=$!; "
            "until [ -n \"$(ls cache 2>/dev/null)\" ]; do kill -0 $pid || break; sleep 0.02; done; "
            "kill -INT $pid; wait $pid )");
  EXPECT_EQ(result.exit_code, 130) << read_file(folder_ / "log");
  EXPECT_FALSE(fs::exists(folder_ / "model"));
  EXPECT_GT(cached_files(), 0U);
  EXPECT_EQ(vantage("train data --out model --cache cache -q").exit_code, 0);
}

TEST_F(RecognitionCommands, ATruncatedPictureIsNamedOrSkipped) {
  const auto broken = folder_ / "data/mug/mug_1/mug_1_1_3_crop.png";
  fs::resize_file(broken, fs::file_size(broken) / 2);
  expect_error(vantage(kTrain), 3, {"mug_1_1_3_crop.png"});
  EXPECT_FALSE(fs::exists(folder_ / "model"));
}

TEST_F(RecognitionCommands, AMissingDepthIsNamedOrLeftOut) {
  fs::remove(folder_ / "data/mug/mug_1/mug_1_1_3_depthcrop.png");
  expect_error(vantage(kTrain), 3, {"mug_1_1_3_depthcrop.png"});
  const json model = parsed(std::string(kTrain) + "--skip-bad --json");
  EXPECT_EQ(model["views"], 2 * 3 * 16 - 1);
}

TEST_F(RecognitionCommands, ACategoryWithOneViewIsNoCategory) {
  Rng rng(1);
  test::put_painted_view(folder_ / "data", {"pen", "pen_1", 30}, 1, 1, 0.0, rng);
  expect_error(vantage(kTrain), 3, {"pen_1_1_1"});
}

TEST_F(RecognitionCommands, WithoutDepthItRecognisesByColour) {
  train();
  cv::imwrite(view("depthcrop.png").string(), cv::Mat::zeros(24, 30, CV_16UC1));
  const json known =
      parsed(std::string(kRecognise) + kRed + " --set recognition.all_features=true");
  EXPECT_EQ(known["objects"][0]["object"], "mug_1");
  EXPECT_EQ(known["views"][0]["features"], json::array({"colour"}));
  EXPECT_EQ(known["views"][0]["skipped"][0]["feature"], "bounding_box");
  expect_finite(known);
}

TEST_F(RecognitionCommands, AnEmptyMaskIsNamed) {
  train();
  cv::imwrite(view("maskcrop.png").string(), cv::Mat::zeros(24, 30, CV_8UC1));
  expect_error(vantage(std::string(kRecognise) + kRed), 3, {"mug_1_2_3_maskcrop.png"});
}

TEST_F(RecognitionCommands, AnObjectCutByTheFrameHasABeliefAllTheSame) {
  train();
  write_file(view("loc.txt"), "0,0\n");
  cv::Mat mask = cv::Mat::zeros(24, 30, CV_8UC1);
  mask.colRange(0, 4).setTo(255);  // a strip of it is in the image
  cv::imwrite(view("maskcrop.png").string(), mask);
  expect_finite(parsed(std::string(kRecognise) + kRed + " --set recognition.all_features=true"));
}

TEST_F(RecognitionCommands, AModelOfAnotherVersionOrCutShortIsRefused) {
  train();
  const std::string model = read_file(folder_ / "model");
  write_file(folder_ / "model", model.substr(0, model.size() / 2));
  expect_error(vantage(std::string(kRecognise) + kRed), 3, {"model"});
  std::string other = model;
  other[other.find('\n') + 1] = 9;  // after the first line stands the version
  write_file(folder_ / "model", other);
  expect_error(vantage(std::string(kRecognise) + kRed), 3, {"model", "version"});
  expect_error(vantage("evaluate data --model model --out tables -q"), 3, {"version"});
}

TEST_F(RecognitionCommands, ANetworkOfTheWrongShapeIsRefused) {
  write_file(folder_ / "net.onnx", convolution_network(5));
  const std::string set = "--set 'features=[{name: onnx, file: net.onnx}]' ";
  const Result result = vantage("train data --out model -q " + set);
  EXPECT_EQ(result.exit_code, 3) << result.output;
  EXPECT_THAT(result.output, HasSubstr("net.onnx"));
  EXPECT_FALSE(fs::exists(folder_ / "model"));
}

TEST_F(RecognitionCommands, UnknownMethodsAndFeaturesAreNamed) {
  expect_error(vantage("train data --out model -q --set 'features=[colr]'"), 2, {"colr", "colour"});
  train();
  expect_error(vantage("evaluate data --model model --out tables -q --set 'methods=[best]'"), 2,
               {"best", "mutual_information"});
}

TEST_F(RecognitionCommands, TheAnswerInWordsIsThatInJson) {
  train();
  const std::string question =
      std::string(kRed) +
      " data/mug/mug_1/mug_1_2_7_crop.png data/mug/mug_1/mug_1_2_7_depthcrop.png --motion-deg 90";
  const json known = parsed(kRecognise + question);
  const auto percent = [](const json& of) { return 100.0 * of["probability"].get<double>(); };
  const auto name = [](const json& of, const char* key) { return of[key].get<std::string>(); };
  const json& estimate = known["estimate"];
  std::string text = fmt::format("{} ({}), {:.2f} %; unknown {:.2f} %\n", name(estimate, "object"),
                                 name(estimate, "category"), percent(estimate),
                                 100.0 * known["unknown_probability"].get<double>());
  ASSERT_EQ(known["objects"].size(), 3U);
  for (const json& object : known["objects"]) {
    text +=
        fmt::format("{:6.2f} %  {} ({}), yaw {:.0f} deg\n", percent(object), name(object, "object"),
                    name(object, "category"), object["yaw_deg"].get<double>());
  }
  ASSERT_EQ(known["categories"].size(), 2U);
  const json& category = known["categories"][0];
  text += fmt::format("{:6.2f} %  category {}\n", percent(category), name(category, "category"));
  ASSERT_EQ(known["views"].size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const json& view = known["views"][i];
    text += fmt::format("view at {} deg: {}; entropy {:.3f} bits\n", 90 * i,
                        fmt::join(view["features"].get<std::vector<std::string>>(), ", "),
                        view["entropy_bits"].get<double>());
  }
  EXPECT_EQ(known["entropy_bits"], known["views"][1]["entropy_bits"]);
  EXPECT_TRUE(known["next"]["view"].is_null()) << "views of this model have no names";
  text += fmt::format("{}; look next after a turn by {:.0f} deg\n",
                      known["sure"].get<bool>() ? "sure" : "not sure",
                      known["next"]["turn_deg"].get<double>());
  EXPECT_EQ(vantage("recognise --model model " + question + " 2>/dev/null").output, text);
}

TEST_F(RecognitionCommands, TheLikeliestComeFirstAndNoMoreThanAskedFor) {
  train();
  const json all = parsed(std::string(kRecognise) + kRed);
  for (const char* list : {"objects", "categories"}) {
    for (std::size_t i = 1; i < all[list].size(); ++i) {
      EXPECT_GE(all[list][i - 1]["probability"], all[list][i]["probability"]) << list;
    }
    for (const std::size_t top : {1U, 2U}) {
      const json few = parsed(kRecognise + std::string(kRed) + " --top " + std::to_string(top));
      ASSERT_EQ(few[list].size(), top);
      EXPECT_EQ(few[list][0], all[list][0]);
    }
  }
  EXPECT_EQ(all["estimate"]["object"], all["objects"][0]["object"]);
  EXPECT_EQ(all["estimate"]["category"], all["objects"][0]["category"]);
  const double turn_deg = all["next"]["turn_deg"];
  EXPECT_NEAR(std::remainder(turn_deg, 45.0), 0.0, 1e-9) << "by whole bins";
  EXPECT_GT(turn_deg, 44.0);
  EXPECT_LT(turn_deg, 316.0);
}

/// The poses beside the files turn the object by 90 deg from view to view, so the camera back.
TEST_F(RecognitionCommands, MotionsAreOneForAllOrOneEach) {
  train();
  std::string views;
  for (const int frame : {3, 7, 11}) {
    views += fmt::format(
        " data/mug/mug_1/mug_1_2_{0}_crop.png data/mug/mug_1/mug_1_2_{0}_"
        "depthcrop.png",
        frame);
  }
  const auto expect_bearings = [&](const std::string& motion, double second, double third) {
    const json known = parsed(kRecognise + motion + views);
    ASSERT_EQ(known["views"].size(), 3U);
    EXPECT_EQ(known["views"][0]["view_rad"], 0.0);
    const auto bearing_deg = [&](std::size_t view) {
      return known["views"][view]["view_rad"].get<double>() * 180.0 / std::numbers::pi;
    };
    EXPECT_NEAR(bearing_deg(1), second, 1e-6) << motion;
    EXPECT_NEAR(bearing_deg(2), third, 1e-6) << motion;
  };
  expect_bearings("--motion-deg 45", 45.0, 90.0);
  expect_bearings("--motion-deg 45,-15", 45.0, 30.0);
  expect_bearings("", -90.0, -180.0);
  const std::string recognise = "recognise --model model -q" + views;
  expect_error(vantage(recognise + " --motion-deg 1,2,3"), 2, {"3 turns given, there are 2"});
  expect_error(vantage(recognise + " --view-names a,b"), 2, {"2 names given, there are 3 views"});
  expect_error(vantage(recognise + " --view-names a,b,c"), 2,
               {"--view-names: the model knows no views by name"});
  expect_error(vantage(recognise + " one.png"), 2, {"one is missing"});
  views.clear();
  for (const int frame : {13, 1, 7}) {  // the object is at 270, 0 and 135 deg
    views += fmt::format(
        " data/mug/mug_1/mug_1_2_{0}_crop.png data/mug/mug_1/mug_1_2_{0}_"
        "depthcrop.png",
        frame);
  }
  expect_bearings("", -90.0, -225.0);
  fs::remove(folder_ / "data/mug/mug_1/mug_1_2_1_pose.txt");
  expect_bearings("", 0.0, 0.0);
}

/// Seven of eight directions were seen, each 45 deg on from the one before, against the sense of a
/// turn: the eighth is one further.
TEST_F(RecognitionCommands, TheNextViewIsOneThatWasNotTaken) {
  train();
  std::string views;
  std::string backward;
  for (int frame = 1; frame <= 13; frame += 2) {
    const std::string view = fmt::format(
        " data/mug/mug_1/mug_1_2_{0}_crop.png data/mug/mug_1/mug_1_2_{0}_depthcrop.png", frame);
    views += view;
    backward.insert(0, view);
  }
  const json known = parsed(kRecognise + views);
  ASSERT_EQ(known["views"].size(), 7U);
  EXPECT_NEAR(known["views"][6]["view_rad"].get<double>(), -1.5 * std::numbers::pi, 1e-6);
  EXPECT_NEAR(known["next"]["turn_deg"].get<double>(), 315.0, 1e-9);
  const json back = parsed(kRecognise + backward);
  EXPECT_NEAR(back["next"]["turn_deg"].get<double>(), 45.0, 1e-9) << "with the sense of a turn";
}

TEST_F(RecognitionCommands, AModelInWordsIsThatInJson) {
  const std::string costs = " --set 'costs_s=[0.001,0.0025]' ";
  const json model = parsed(kTrain + costs + "--json");
  EXPECT_EQ(model["model"], "model");
  EXPECT_EQ(model["categories"], 2);
  ASSERT_EQ(model["features"].size(), 2U);
  const auto psi = [&](std::size_t f) { return model["features"][f]["psi"].get<double>(); };
  const bool unknown =
      model["features"][0]["unknown"].get<bool>() && model["features"][1]["unknown"].get<bool>();
  EXPECT_EQ(vantage(kTrain + costs + "--overwrite 2>/dev/null").output,
            fmt::format("model: 3 objects in 2 categories, 24 states, 96 views\n"
                        "colour: 144 dimensions, psi {:.4g}, 1.00 ms\n"
                        "bounding_box: 3 dimensions, psi {:.4g}, 2.50 ms\n"
                        "{}; views of one object repeat each other: correlation {:.2f}\n",
                        psi(0), psi(1),
                        unknown ? "knows what is unknown" : "takes every object for one of these",
                        model["view_correlation"].get<double>()));
}

/// Of eight directions three views each, but for one that lacks one.
TEST_F(RecognitionCommands, ADatasetIsCounted) {
  put({"mug", "mug_1", 0}, "few", 8);
  put({"mug", "mug_2", 60}, "few", 8);
  put({"can", "can_1", 120}, "few", 8);
  for (const char* end : {"crop.png", "depthcrop.png", "maskcrop.png", "loc.txt", "pose.txt"}) {
    ASSERT_TRUE(fs::remove(folder_ / "few/mug/mug_1" / (std::string("mug_1_4_3_") + end))) << end;
  }
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "few")) {
    if (entry.is_regular_file()) bytes += entry.file_size();
  }
  EXPECT_EQ(parsed("dataset info few --json"),
            json({{"root", "few"},
                  {"categories", 2},
                  {"objects", 3},
                  {"views", 71},
                  {"views_of_video", {{"1", 24}, {"2", 24}, {"4", 23}}},
                  {"states", 24},
                  {"views_of_state", {{"least", 2}, {"mean", 71.0 / 24.0}}},
                  {"bytes", bytes},
                  {"problems", json::array()}}));
  EXPECT_EQ(vantage("dataset info few 2>/dev/null").output,
            fmt::format("few: 3 objects in 2 categories, 71 views, {:.1f} MB\n"
                        "video 1: 24 views\nvideo 2: 24 views\nvideo 4: 23 views\n"
                        "views of an object in a yaw bin: 2 at least, 3.0 on average, 24 states\n",
                        1e-6 * static_cast<double>(bytes)));
  const fs::path broken = folder_ / "few/can/can_1/can_1_1_2_crop.png";
  fs::resize_file(broken, fs::file_size(broken) / 2);
  EXPECT_EQ(vantage("dataset info few").exit_code, 0) << "not opened";
  const Result checked = vantage("dataset info few --check --json 2>/dev/null");
  EXPECT_EQ(checked.exit_code, 3);
  const json problems = json::parse(checked.output)["problems"];
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_THAT(problems[0].get<std::string>(), HasSubstr("can_1_1_2_crop.png"));
}

/// The stripe of a painted block is as wide as its yaw is large: 2 px, and 24 px a turn.
TEST_F(RecognitionCommands, AContactSheetShowsTheViewThatIsAskedFor) {
  put({"can", "can_1", 120}, "few", 8);
  put({"mug", "mug_1", 0}, "few", 8);
  put({"pen", "pen_1", 60}, "few", 8);
  const auto sheet = [&](const std::string& options) {
    const Result made = vantage("dataset contact-sheet few --out s.png --overwrite -q " + options);
    EXPECT_EQ(made.exit_code, 0) << made.output;
    return cv::imread((folder_ / "s.png").string());
  };
  const auto stripe_px = [&](const std::string& options) {
    const cv::Mat image = sheet("--cell 30 " + options);
    int px = 0;
    while (px < 30 && image.at<cv::Vec3b>(5, px) == image.at<cv::Vec3b>(5, 0)) ++px;
    return px;
  };
  EXPECT_EQ(stripe_px("--yaw-deg 90"), 2 + 6);
  EXPECT_EQ(stripe_px("--yaw-deg -90"), 2 + 18);
  EXPECT_EQ(stripe_px(""), 2 + 21) << "315 deg, which is nearest to 300";
  EXPECT_EQ(sheet("--cell 20 --columns 2").size(), cv::Size(2 * 20, 2 * (20 + 12)));
  EXPECT_EQ(sheet("--columns 3").size(), cv::Size(3 * 96, 96 + 12));
}

TEST_F(RecognitionCommands, ACheckInWordsIsThatInJson) {
  put({"can", "can_1", 120}, "few", 8);
  put({"mug", "mug_1", 0}, "few", 8);
  const Result as_json = vantage("dataset check few --bins 4 --json -q 2>/dev/null");
  const json check = json::parse(as_json.output);
  EXPECT_EQ(check["views"], 48);
  EXPECT_EQ(check["bins"], 4);
  EXPECT_EQ(check["cut"], "mask");
  EXPECT_EQ(check["objects"][0]["directions"], 4);
  EXPECT_EQ(check["objects"][1]["views"], 24);
  EXPECT_EQ(check["holes"]["most"], 0.0);
  EXPECT_NEAR(check["distance_m"]["median"].get<double>(), 0.9025, 0.003);
  std::string text = fmt::format("few: 48 views of 2 objects, cut by mask, focal length {} px\n",
                                 check["focal_px"].get<double>());
  text += fmt::format("{:<24} {:>6} {:>11} {:>11} {:>8} {:>8}\n", "object", "views", "recordings",
                      "directions", "holes", "size m");
  for (const json& object : check["objects"]) {
    text += fmt::format("{:<24} {:>6} {:>11}      4 of 4 {:>6.0f} % {:>8.3f}\n",
                        object["object"].get<std::string>(), 24, object["recordings"].get<int>(),
                        0.0, object["size_m"].get<double>());
  }
  const json& far = check["distance_m"];
  text += fmt::format(
      "without depth on the object: 0 % (0 to 0 %); object at {:.2f} m ({:.2f} to {:.2f} m)\n",
      far["median"].get<double>(), far["least"].get<double>(), far["most"].get<double>());
  for (const json& problem : check["problems"]) {
    text += fmt::format("problem: {}\n", problem.get<std::string>());
  }
  for (const json& advice : check["advice"]) {
    text += fmt::format("note: {}\n", advice.get<std::string>());
  }
  const bool good = check["problems"].empty();
  text += good ? "no problem found\n" : "there are problems\n";
  const Result in_words = vantage("dataset check few --bins 4 -q 2>/dev/null");
  EXPECT_EQ(in_words.output, text);
  EXPECT_EQ(in_words.exit_code, good ? 0 : 3);
  EXPECT_EQ(as_json.exit_code, in_words.exit_code);
  const Result twice = vantage("dataset check few --bins 4 --test few -q 2>/dev/null");
  json both =
      json::parse(vantage("dataset check few --bins 4 --test few --json -q 2>/dev/null").output);
  const std::string once = text.substr(0, text.rfind('\n', text.size() - 2) + 1);
  text = once + once;
  EXPECT_FALSE(both["differences"].empty());
  for (const json& difference : both["differences"]) {
    text += fmt::format("{}: {}\n", difference["problem"].get<bool>() ? "problem" : "note",
                        difference["text"].get<std::string>());
  }
  EXPECT_EQ(twice.output, text + "there are problems\n") << "it is tested on what it learnt";
  EXPECT_EQ(twice.exit_code, 3);
  EXPECT_EQ(both["test"], check);
}

TEST_F(RecognitionCommands, KeysOfAFileHoldWhereSetSaysNothing) {
  file("keys.yaml", "features: [colour]\n");
  const std::string train = "train data --config keys.yaml -q --json --out ";
  EXPECT_EQ(parsed(train + "new/folder/model")["features"][0]["name"], "colour");
  EXPECT_TRUE(fs::exists(folder_ / "new/folder/model"));
  const json other = parsed(train + "other --set 'features=[bounding_box]'");
  EXPECT_EQ(other["features"][0]["name"], "bounding_box");
}

}  // namespace
}  // namespace vantage
