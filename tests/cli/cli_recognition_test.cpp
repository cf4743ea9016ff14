// `vantage train`, `recognise` and `evaluate` on a dataset of painted blocks.
#include <nlohmann/json.hpp>

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

}  // namespace
}  // namespace vantage
