// A user's own pictures: `vantage dataset import` and `check`, and what training, recognition and
// evaluation make of them and of what is wrong with them.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <map>
#include <numbers>
#include <sstream>

#include "tests/cli/command_line.hpp"
#include "tests/recognition/painted_dataset.hpp"
#include "tests/support/room_pictures.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {

using nlohmann::json;
using support::DepthFormat;
using support::Room;

constexpr int kObjects = 4;
const std::string kFeatures = "--set 'features=[colour,bounding_box,vfh]' ";
const std::string kFocal = " --focal-px 285 -q ";

/// Runs commands and reads what they print.
class Pictures : public CommandLine {
 protected:
  json parsed(const std::string& arguments, int exit_code = 0) {
    const Result result = vantage(arguments + " --json 2>errors");
    EXPECT_EQ(result.exit_code, exit_code) << arguments << "\n" << read_file(folder_ / "errors");
    json value = json::parse(result.output, nullptr, false);
    EXPECT_TRUE(value.is_object()) << result.output;
    return value;
  }
  std::string errors() const { return read_file(folder_ / "errors"); }
  void put(const std::string& to, const Room& room, DepthFormat format = DepthFormat::png_mm,
           bool masks = false) {
    support::put_room(folder_ / to, kObjects, room, format, masks);
  }
  /// Accuracy in percent of each method asked for.
  std::map<std::string, double> evaluated(const std::string& arguments) {
    const json study =
        parsed("evaluate " + arguments + " --out tables --overwrite -q --set literal=false");
    std::map<std::string, double> accuracy;
    for (const json& method : study["methods"]) {
      accuracy[method["method"]] = method["accuracy_percent"]["mean"];
    }
    return accuracy;
  }
};

/// Two rooms to train on, a third one to test on, as the pages of the manual have them.
class OwnPictures : public Pictures {
 protected:
  void SetUp() override {
    Pictures::SetUp();
    put("mine/kitchen", {.seed = 1, .holes = 0.1, .margin = 0.3});
    put("mine/office", {.seed = 2, .elevation_rad = 0.65, .holes = 0.25});
    put("other/lab", {.seed = 3, .holes = 0.2, .margin = 0.4}, DepthFormat::npy_m);
  }
  void import_all() {
    parsed("dataset import mine --out train" + kFocal);
    parsed("dataset import other --out test" + kFocal);
  }
  void train() { parsed("train train --out model -q " + kFeatures); }
};

TEST_F(OwnPictures, AreImportedCheckedTrainedOnAndRecognised) {
  const json imported = parsed("dataset import mine --out train" + kFocal);
  EXPECT_EQ(imported["objects"], kObjects);
  EXPECT_EQ(imported["pictures"], 2 * 7 * kObjects);
  EXPECT_EQ(imported["recordings"], json::array({"kitchen", "office"}));
  EXPECT_EQ(imported["cut"], "depth");
  EXPECT_EQ(imported["bins"], 8);
  EXPECT_EQ(imported["depth_units_m"], json({{"0.001", 2 * 7 * kObjects}}));
  const json metres = parsed("dataset import other --out test" + kFocal);
  EXPECT_EQ(metres["depth_units_m"], json({{"1", 7 * kObjects}}));
  const json check = parsed("dataset check train --test test -q");
  EXPECT_EQ(check["problems"], json::array());
  EXPECT_EQ(check["objects"][0]["directions"], 7);
  train();
  const auto accuracy = evaluated(
      "test --model model --training train --set starts=60 --set baselines=true "
      "--set 'methods=[\"single view, all features\",\"random, all "
      "features\",\"mutual_information, all features\"]'");
  EXPECT_GE(accuracy.at("single view, all features"), 80.0);
  EXPECT_GE(accuracy.at("mutual_information, all features"),
            accuracy.at("random, all features") - 1.0);
  EXPECT_GE(accuracy.at("mutual_information, all features"), accuracy.at("nearest neighbour"));
  const json known = parsed(
      "recognise --model model -q --focal-px 285 other/lab/thingb/front_rgb.png "
      "other/lab/thingb/front_depth.npy other/lab/thingb/left_rgb.png "
      "other/lab/thingb/left_depth.npy --view-names front,left");
  EXPECT_EQ(known["objects"][0]["object"], "thingb_1");
  EXPECT_EQ(known["categories"][0]["category"], "thingb");
  EXPECT_TRUE(known["next"]["view"].is_string());
  const std::vector<std::string> taken{"front", "front_left", "left", "back_left", "back", "right"};
  std::string files;
  for (const std::string& view : taken) {
    files += fmt::format(" other/lab/thingb/{0}_rgb.png other/lab/thingb/{0}_depth.npy", view);
  }
  const json last = parsed(fmt::format(
      "recognise --model model -q --focal-px 285{} --view-names {}", files, fmt::join(taken, ",")));
  EXPECT_EQ(last["next"]["view"], "front_right") << "the only one that is left";
}

TEST_F(OwnPictures, TheTutorialsCommandsWork) {
  for (const char* view : {"front", "left"}) {
    const auto picture = support::room_picture(support::made_up_object("thinga", 7),
                                               view[0] == 'f' ? 0.0 : 4.71, {.seed = 3});
    support::put_picture(folder_, view, picture, DepthFormat::png_mm);
  }
  std::istringstream page(
      read_file(fs::path(VANTAGE_SOURCE_DIR) / "docs/tutorials/own-pictures.md"));
  int commands = 0;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("vantage ")) continue;
    const Result result = vantage(line.substr(8) + " -q");
    EXPECT_EQ(result.exit_code, 0) << line << "\n" << result.output;
    ++commands;
  }
  EXPECT_EQ(commands, 6);
}

TEST_F(OwnPictures, SeveralViewsNeedNoPoses) {
  import_all();
  train();
  const std::string of = "other/lab/thingc/";
  const json known = parsed("recognise --model model --focal-px 285 " + of + "front_rgb.png " + of +
                            "front_depth.npy " + of + "back_rgb.png " + of + "back_depth.npy");
  EXPECT_EQ(known["objects"][0]["object"], "thingc_1");
  EXPECT_THAT(errors(), HasSubstr("--view-names"));
}

TEST_F(OwnPictures, TopHasAPlaceOfItsOwn) {
  for (int k = 0; k < kObjects; ++k) {
    const auto object =
        support::made_up_object(fmt::format("thing{}", static_cast<char>('a' + k)), 7);
    for (const auto& [room, holes] : {std::pair{"mine/kitchen", 0.1}, {"mine/office", 0.2}}) {
      support::put_picture(
          folder_ / room / object.name, "top",
          support::room_picture(object, 0.3, {.seed = 5, .elevation_rad = 1.4, .holes = holes}),
          DepthFormat::png_mm);
    }
  }
  write_file(folder_ / "camera.txt", "fx: 285\nfy: 285\ncx: 80\ncy: 60\n");
  const Result both = vantage("dataset import mine --out train --intrinsics camera.txt" + kFocal);
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.output, HasSubstr("--focal-px"));
  const json imported = parsed("dataset import mine --out train" + kFocal);
  EXPECT_EQ(imported["bins"], 8);
  EXPECT_EQ(imported["degrees"], false);
  parsed("dataset import other --out test" + kFocal);  // without top: seven names
  train();
  EXPECT_GE(
      evaluated("test --model model --set starts=40 --set 'methods=[\"random, all features\"]'")
          .at("random, all features"),
      80.0);
}

TEST_F(OwnPictures, AnglesAndAnyElevationComeFromPoses) {
  for (const char* view : {"a", "b", "c"}) {
    const double yaw_deg = 30.0 * (view[0] - 'a');
    for (const char* object : {"cup", "pot"}) {
      const auto picture = support::room_picture(support::made_up_object(object, 3), yaw_deg, {});
      support::put_picture(folder_ / "posed" / object, view, picture, DepthFormat::png_mm);
      write_file(folder_ / "posed" / object / (std::string(view) + "_pose.txt"),
                 fmt::format("{} 52.5\n", yaw_deg));
    }
  }
  const json imported = parsed("dataset import posed --out train" + kFocal);
  EXPECT_EQ(imported["degrees"], true);
  EXPECT_EQ(imported["bins"], 12);
  EXPECT_EQ(parsed("dataset info train")["states"], 6) << "30 and 60 deg are two of 12 bins";
  EXPECT_EQ(read_file(folder_ / "train/cup/cup_1/cup_1_1_2_pose.txt"), "30.0000 52.5000\n");
  EXPECT_EQ(parsed("train train --out model -q " + kFeatures)["views"], 6);
  const Result told = vantage("dataset import posed --out again --depth-unit 0.001" + kFocal);
  EXPECT_EQ(told.exit_code, 0);
  EXPECT_THAT(told.output,
              HasSubstr("again: 6 pictures of 2 objects in 1 recording, cut by depth\n"));
  EXPECT_THAT(told.output, HasSubstr("depth: 1 is a millimetre of 6 pictures\n"));
}

TEST_F(OwnPictures, BadOnesAreNamedWithARemedy) {
  const std::string one = (folder_ / "mine/kitchen/thinga/left_depth.png").string();
  cv::imwrite(one, cv::Mat(90, 80, CV_16UC1, cv::Scalar(65535)));
  const Result all = vantage("dataset import mine --out train" + kFocal);
  expect_error(all, 3, {"left_depth.png", "--skip-bad"});
  EXPECT_FALSE(fs::exists(folder_ / "train"));
  const json without = parsed("dataset import mine --out train --skip-bad" + kFocal);
  EXPECT_EQ(without["pictures"], 2 * 7 * kObjects - 1);
  EXPECT_EQ(without["left_out"].size(), 1U);
  EXPECT_THAT(errors(), HasSubstr("left_depth.png"));
  expect_error(vantage("dataset import mine --out train" + kFocal), 2, {"--overwrite"});
  expect_error(vantage("dataset check mine -q"), 3, {"vantage dataset import mine --out"});
  fs::create_directories(folder_ / "empty");
  expect_error(vantage("dataset import empty --out x" + kFocal), 3, {"front_rgb.png"});
  expect_error(vantage("dataset import mine --out x --layout '{thing}'" + kFocal), 2, {"{thing}"});
  expect_error(vantage("dataset import mine --out x --depth-unit inch" + kFocal), 2,
               {"--depth-unit: 'inch' is no number"});
  expect_error(vantage("dataset import mine --out x --depth-unit 2" + kFocal), 2,
               {"--depth-unit: 2 m is not in (0, 1]"});
}

TEST_F(OwnPictures, CopiesAndSharedPicturesAreTold) {
  import_all();
  fs::copy(folder_ / "train/thinga/thinga_1", folder_ / "test/thinga/thinga_1",
           fs::copy_options::overwrite_existing | fs::copy_options::recursive);
  const json check = parsed("dataset check train --test test -q", 3);
  EXPECT_THAT(check["differences"].dump(), HasSubstr("are trained on"));
  const json once = parsed("train train --out once -q " + kFeatures);
  const json twice = parsed("train train train --out twice " + kFeatures);
  EXPECT_THAT(errors(), HasSubstr("copies of others"));
  EXPECT_EQ(once["views"], twice["views"]);
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_EQ(once["features"][f]["psi"], twice["features"][f]["psi"]);
  }
}

TEST_F(OwnPictures, UnseenInstancesCountForTheirCategory) {
  for (const char* from : {"kitchen", "office"}) {
    fs::rename(folder_ / "mine" / from / "thinga", folder_ / "mine" / from / "cup_1");
    fs::rename(folder_ / "mine" / from / "thingb", folder_ / "mine" / from / "pot_1");
  }
  fs::rename(folder_ / "other/lab/thinga", folder_ / "other/lab/cup_2");
  fs::rename(folder_ / "other/lab/thingb", folder_ / "other/lab/pot_2");
  import_all();
  train();
  const json study = parsed(
      "evaluate test --model model --out tables -q --set starts=80 --set literal=false "
      "--set 'methods=[\"single view, all features\"]'");
  EXPECT_GT(study["methods"][0]["category_percent"], 70.0);
  EXPECT_THAT(read_file(folder_ / "tables/recognition.md"),
              HasSubstr("2 of 4 objects are not in the model"));
  EXPECT_THAT(read_file(folder_ / "tables/results.csv"), HasSubstr(",cup_2,cup_1,0,1,"));
}

/// Trained with masks, asked without: the background must not decide.
TEST_F(Pictures, WithoutAMaskTheObjectIsCutOutAsTheModelExpects) {
  put("mine/kitchen", {.seed = 1, .holes = 0.1}, DepthFormat::png_mm, true);
  put("mine/office", {.seed = 2, .holes = 0.1}, DepthFormat::png_mm, true);
  EXPECT_EQ(parsed("dataset import mine --out train" + kFocal)["cut"], "mask");
  parsed("train train --out model -q " + kFeatures);
  put("lab", {.seed = 3, .holes = 0.15, .margin = 0.6});
  int right = 0;
  int asked = 0;
  for (int k = 0; k < kObjects; ++k) {
    const std::string name = fmt::format("thing{}", static_cast<char>('a' + k));
    for (const char* view : {"front", "left", "back", "right"}) {
      const std::string stem = fmt::format("lab/{}/{}", name, view);
      const json known = parsed(
          fmt::format("recognise --model model --focal-px 285 {0}_rgb.png {0}_depth.png", stem));
      right += known["objects"][0]["object"] == fmt::format("{}_1", name) ? 1 : 0;
      ++asked;
    }
  }
  EXPECT_GE(10 * right, 7 * asked);
  const std::string warning = "cut by depth, the model learnt from pictures cut by mask";
  EXPECT_THAT(errors(), HasSubstr(warning));
  put("masked", {.seed = 3, .holes = 0.15, .margin = 0.6}, DepthFormat::png_mm, true);
  const std::string of = "masked/thinga/front";
  parsed(
      fmt::format("recognise --model model --focal-px 285 {0}_rgb.png {0}_depth.png "
                  "--view-names front",
                  of));
  EXPECT_THAT(errors(), Not(HasSubstr(warning)));
  EXPECT_THAT(errors(), HasSubstr("there is one view"));
  const auto by_camera = [&](const char* camera) {
    return parsed(fmt::format("recognise --model model {0} {1}_rgb.png {1}_depth.png", camera, of));
  };
  EXPECT_EQ(by_camera("")["objects"], by_camera("--focal-px 285")["objects"]) << "the model's own";
  EXPECT_NE(by_camera("")["objects"], by_camera("--focal-px 570")["objects"]);
}

TEST_F(Pictures, RenderedOnesAreToldAndShown) {
  const std::string render =
      "dataset render d --objects 1 --step-deg 120 --set supersampling=1 --jobs 1 -q";
  const Result told = vantage(render);
  EXPECT_EQ(told.exit_code, 0);
  EXPECT_THAT(told.output, testing::StartsWith("d: 1 objects complete, 1 of them and 9 views in "));
  const json again = parsed(render);
  EXPECT_EQ(again["objects"], 1);
  EXPECT_EQ(again["rendered"], 0);
  EXPECT_LT(again["time_s"].get<double>(), 600.0) << "of this call alone";
  EXPECT_THAT(vantage("dataset info d").output,
              HasSubstr("d: 1 objects in 1 categories, 9 views, "));
  EXPECT_EQ(parsed("dataset info d")["views_of_video"], json({{"1", 3}, {"2", 3}, {"4", 3}}));
  EXPECT_EQ(vantage("dataset contact-sheet d --out sheet.png -q").output, "sheet.png\n");
  EXPECT_FALSE(cv::imread((folder_ / "sheet.png").string()).empty());
  expect_error(vantage("dataset contact-sheet d --out sheet.png -q"), 2, {"--overwrite"});
}

/// Of painted blocks: what is wrong with the question, not with the model.
class Questions : public Pictures {
 protected:
  void SetUp() override {
    Pictures::SetUp();
    test::put_painted_object(folder_ / "data", {"mug", "mug_1", 0}, 16);
    test::put_painted_object(folder_ / "data", {"mug", "mug_2", 60}, 16);
    test::put_painted_object(folder_ / "data", {"can", "can_1", 120}, 16);
    ASSERT_EQ(vantage("train data --out model -q --set 'features=[colour,bounding_box]'").exit_code,
              0);
  }
  static std::string view(int frame) {
    const std::string stem = fmt::format(" data/mug/mug_1/mug_1_2_{}_", frame);
    return stem + "crop.png" + stem + "depthcrop.png";
  }
};

TEST_F(Questions, APictureWithoutMeasurementsIsRefused) {
  cv::imwrite((folder_ / "depth.png").string(), cv::Mat(24, 30, CV_16UC1, cv::Scalar(65535)));
  expect_error(vantage("recognise --model model -q data/mug/mug_1/mug_1_2_3_crop.png depth.png"), 3,
               {"depth.png", "65535"});
}

TEST_F(Questions, APictureOfOnePixelIsRefused) {
  cv::imwrite((folder_ / "one.png").string(), cv::Mat(1, 1, CV_8UC3, cv::Scalar(9, 9, 200)));
  cv::imwrite((folder_ / "one_depth.png").string(), cv::Mat(1, 1, CV_16UC1, cv::Scalar(900)));
  const Result result = vantage("recognise --model model -q --cut whole one.png one_depth.png");
  expect_error(result, 3, {"one.png", "1 x 1 px"});
}

TEST_F(Questions, APictureHasEightPixelsALine) {
  for (const int width_px : {7, 8}) {
    cv::imwrite((folder_ / "few.png").string(),
                cv::Mat(8, width_px, CV_8UC3, cv::Scalar(9, 9, 200)));
    cv::imwrite((folder_ / "few_depth.png").string(),
                cv::Mat(8, width_px, CV_16UC1, cv::Scalar(900)));
    const Result result = vantage("recognise --model model -q --cut whole few.png few_depth.png");
    EXPECT_EQ(result.output.find("at least 8 x 8 are needed") != std::string::npos, width_px == 7)
        << result.output;
  }
}

TEST_F(Questions, AnElevationThatIsGivenCounts) {
  test::put_painted_object(folder_ / "flat", {"mug", "mug_1", 0}, 4);
  const std::string question =
      "recognise --model model --set recogniser.features=[bounding_box]" + view(3);
  EXPECT_NE(parsed(question)["objects"], parsed(question + " --elevation-deg 5")["objects"]);
  EXPECT_EQ(parsed(question)["objects"], parsed(question + " --elevation-deg 45")["objects"])
      << "that of the second video";
}

TEST_F(Questions, EveryGivenViewIsUsed) {
  const json known = parsed("recognise --model model" + view(1) + view(5) + view(9) + view(13));
  ASSERT_EQ(known["views"].size(), 4U);
  for (const json& seen : known["views"]) EXPECT_EQ(seen["features"].size(), 2U) << seen;
}

TEST_F(Questions, TurnsAreOfSeveralViews) {
  const std::string warning = "there is one view";
  parsed("recognise --model model" + view(1));
  EXPECT_THAT(errors(), testing::Not(HasSubstr(warning)));
  parsed("recognise --model model --motion-deg 45" + view(1));
  EXPECT_THAT(errors(), HasSubstr(warning));
  parsed("recognise --model model --motion-deg 45" + view(1) + view(5));
  EXPECT_THAT(errors(), testing::Not(HasSubstr(warning)));
}

TEST_F(Questions, CategoriesAreTold) {
  const json known = parsed("recognise --model model" + view(1));
  ASSERT_EQ(known["categories"].size(), 2U);
  EXPECT_EQ(known["categories"][0]["category"], "mug");
  EXPECT_GT(known["categories"][0]["probability"], 0.5);
}

TEST_F(Questions, BaselinesOnASmallModelWorkOrSayWhatTheyNeed) {
  const std::string evaluate =
      "evaluate data --model model --out tables -q --overwrite --set literal=false --set starts=9 "
      "--set baselines=true --set 'methods=[random]' ";
  EXPECT_EQ(vantage(evaluate).exit_code, 0);
  for (const char* object : {"mug/mug_1", "mug/mug_2", "can/can_1"}) {
    for (const auto& entry : fs::directory_iterator(folder_ / "data" / object)) {
      const std::string name = entry.path().filename().string();
      if (name.find("_2_") == std::string::npos || name.find("_1_2_") == std::string::npos) {
        fs::create_directories(folder_ / "few" / object);
        if (name.starts_with(fs::path(object).filename().string() + "_2_")) {
          fs::copy(entry.path(), folder_ / "few" / object / name);
        }
      }
    }
  }
  test::put_painted_object(folder_ / "few2", {"mug", "mug_1", 0}, 3);
  const Result none = vantage(
      "evaluate few2 --model model --training few2 --out t2 -q --set literal=false --set starts=4 "
      "--set baselines=true --set 'methods=[random]'");
  expect_error(none, 3, {"baselines", "two objects"});
}

TEST_F(Questions, EvaluateTakesSeveralFoldersAndDrawsOnObjects) {
  test::put_painted_object(folder_ / "more", {"can", "can_2", 120}, 8);
  const json study = parsed(
      "evaluate data more --model model --out tables -q --set literal=false --set starts=3000 "
      "--set 'methods=[\"single view, all features\"]'");
  EXPECT_EQ(study["starts"], 3000);
  const json interval = study["methods"][0]["category_interval"];
  // can_2 is a can: four objects, whatever the number of starts.
  EXPECT_THAT(read_file(folder_ / "tables/recognition.md"), HasSubstr("1 of 4 objects"));
  EXPECT_LE(interval[0].get<double>(), interval[1].get<double>());
}

TEST_F(Questions, AStrategyIsChosenByItsNameAlone) {
  EXPECT_EQ(
      vantage("train data --out a -q --set 'features=[colour]' --set held_out=videos").exit_code,
      0);
  EXPECT_EQ(vantage("train data --out b -q --set 'features=[colour]' --set held_out.name=videos")
                .exit_code,
            0);
  EXPECT_EQ(read_file(folder_ / "a").size(), read_file(folder_ / "b").size());
}

TEST_F(Questions, ShortWorkShowsNoProgress) {
  const Result result =
      vantage("evaluate data --model model --out tables --set starts=50 >/dev/null");
  EXPECT_LE(std::count(result.output.begin(), result.output.end(), '\n'), 4) << result.output;
}

/// The names tell the turn, though no pose lies beside the files.
TEST_F(OwnPictures, ViewsAreAsFarApartAsTheirNamesSay) {
  parsed("dataset import mine --out train" + kFocal);
  train();
  const std::string of = "other/lab/thingb/";
  const std::string question = "recognise --model model --focal-px 285 " + of + "front_rgb.png " +
                               of + "front_depth.npy " + of + "left_rgb.png " + of +
                               "left_depth.npy --view-names front,";
  const json known = parsed(question + "left");
  ASSERT_EQ(known["views"].size(), 2U);
  EXPECT_EQ(known["views"][0]["view_rad"], 0.0);
  EXPECT_NEAR(known["views"][1]["view_rad"].get<double>(), 0.5 * std::numbers::pi, 1e-9);
  EXPECT_THAT(errors(), testing::Not(HasSubstr("--view-names")));
  EXPECT_THAT(vantage(question + "left").output, HasSubstr("; look next at view "));
  const Result unknown = vantage(question + "behind_it");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.output,
              HasSubstr("--view-names: the model has no view 'behind_it'; known: "));
}

TEST_F(OwnPictures, AnImportInWordsIsThatInJson) {
  const json imported = parsed("dataset import mine --out a" + kFocal);
  const auto texts = [&](const char* key) { return imported[key].get<std::vector<std::string>>(); };
  EXPECT_EQ(vantage("dataset import mine --out b" + kFocal + "2>/dev/null").output,
            fmt::format("b: {0} pictures of {1} objects in 2 recordings, cut by depth\n"
                        "paths were read as {2}\n8 viewing directions: {3}\n"
                        "depth: 1 is a millimetre of {0} pictures\n",
                        2 * 7 * kObjects, kObjects, fmt::join(texts("layouts"), " and "),
                        fmt::join(texts("views"), ", ")));
  EXPECT_THAT(vantage("dataset import other --out c" + kFocal + "2>/dev/null").output,
              testing::EndsWith(fmt::format("depth: 1 is a metre of {} pictures\n", 7 * kObjects)));
}

/// The same depth in tenths of a millimetre, of an object 0.9 m away.
TEST_F(Questions, DepthIsInTheUnitThatIsGiven) {
  const std::string stem = "data/mug/mug_1/mug_1_2_3_";
  const cv::Mat mm =
      cv::imread((folder_ / (stem + "depthcrop.png")).string(), cv::IMREAD_UNCHANGED);
  cv::Mat tenths;
  mm.convertTo(tenths, CV_16U, 10.0);
  cv::imwrite((folder_ / "tenths.png").string(), tenths);
  const std::string question =
      "recognise --model model -q --farthest-m 1 " + stem + "crop.png tenths.png ";
  EXPECT_EQ(parsed(question + "--depth-unit-m 0.0001")["objects"][0]["object"], "mug_1");
  expect_error(vantage(question), 3, {"tenths.png"});
}

/// Of names that say nothing by themselves; the camera's middle is a little off the image's.
TEST_F(Pictures, YawsElevationAndCameraAreAsGiven) {
  for (const char* view : {"a", "b"}) {
    for (const char* object : {"cup", "pot"}) {
      support::put_picture(
          folder_ / "mine" / object, view,
          support::room_picture(support::made_up_object(object, 3), view[0] == 'a' ? 0.0 : 1.5, {}),
          DepthFormat::png_mm);
    }
  }
  file("camera.txt", "fx: 285\nfy: 285\ncx: 158\ncy: 121\n");
  const json imported = parsed(
      "dataset import mine --out taken --view-yaw a=10 --view-yaw b=100 --elevation-deg 40 "
      "--intrinsics camera.txt -q");
  EXPECT_EQ(imported["focal_px"], 285.0);
  EXPECT_EQ(imported["degrees"], true);
  EXPECT_EQ(imported["views"], json({"a", "b"}));
  EXPECT_EQ(read_file(folder_ / "taken/cup/cup_1/cup_1_1_1_pose.txt"), "10.0000 40.0000\n");
  EXPECT_EQ(read_file(folder_ / "taken/pot/pot_1/pot_1_1_2_pose.txt"), "100.0000 40.0000\n");
  EXPECT_THAT(read_file(folder_ / "taken/pictures.yaml"), HasSubstr("[158, 121]"));
}

}  // namespace
}  // namespace vantage
