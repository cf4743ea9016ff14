// What is made of a user's pictures, without commands: cli_pictures_test.cpp has those.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/dataset/pictures/import_pictures.hpp"
#include "vantage/dataset/pictures/replace_folder.hpp"
#include "vantage/perception/dataset_reader.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::ptrdiff_t entries_of(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), {});
}

ImportOptions with_camera(double focal_px, std::optional<std::array<double, 2>> centre_px = {}) {
  ImportOptions options;
  options.focal_px = focal_px;
  options.centre_px = centre_px;
  return options;
}

ImportOptions with_angles(const std::map<std::string, double>& yaw_deg) {
  ImportOptions options;
  options.yaw_deg = yaw_deg;
  return options;
}

class Import : public testing::Test {
 protected:
  /// Of a drill, 40 x 30 px.
  void put(const std::string& view) const {
    fs::create_directories(folder_ / "mine/drill");
    const std::string stem = (folder_ / "mine/drill" / view).string();
    cv::imwrite(stem + "_rgb.png", cv::Mat(30, 40, CV_8UC3, cv::Scalar::all(90)));
    cv::imwrite(stem + "_depth.png", cv::Mat(30, 40, CV_16UC1, cv::Scalar(900)));
  }
  ImportOutcome imported(ImportOptions options, const std::string& out = "out") const {
    options.cut = "whole";
    return import_pictures(options,
                           {.from = {folder_ / "mine"}, .root = folder_ / out, .overwrite = true});
  }
  void expect_without_angle(const ImportOptions& options, const std::string& view) const {
    try {
      imported(options);
      ADD_FAILURE() << "no error";
    } catch (const ConfigError& error) {
      EXPECT_THAT(error.what(), HasSubstr("--view-yaw"));
      EXPECT_THAT(error.what(), HasSubstr("'" + view + "'"));
    }
  }
  [[nodiscard]] std::vector<ViewEntry> views() const {
    return index_dataset(folder_ / "out").views;
  }
  support::TemporaryDirectory folder_;
};

TEST_F(Import, TheGivenPrincipalPointOfAWholePictureCounts) {
  put("front");
  imported(with_camera(35.0, {{18.0, 16.0}}));
  const ObjectView view = load_view(views().front()).view;
  EXPECT_EQ(view.ray(16, 18), Eigen::Vector3d(0.0, 0.0, 1.0));
  EXPECT_EQ(view.left_px, 0);
}

TEST_F(Import, ACropFromSomewhereIsTakenForTheMiddle) {
  put("front");
  const ImportOutcome crop = imported(with_camera(570.0, {{310.0, 240.0}}));
  const ObjectView view = load_view(views().front()).view;
  EXPECT_EQ(view.left_px, 290);
  EXPECT_EQ(view.top_px, 225);
  EXPECT_THAT(crop.notices, Contains(HasSubstr("of 1 pictures the principal point")));
  const ImportOutcome unknown = imported(with_camera(35.0));
  EXPECT_EQ(load_view(views().front()).view.ray(15, 20), Eigen::Vector3d(0.0, 0.0, 1.0));
  EXPECT_THAT(unknown.notices, Not(Contains(HasSubstr("principal point"))));
}

TEST_F(Import, GivenAnglesGoWithThoseOfNames) {
  for (const char* view : {"front", "left", "handle"}) put(view);
  const ImportOutcome beside = imported(with_angles({{"handle", 45.0}}));
  EXPECT_TRUE(beside.notes.degrees);
  EXPECT_THAT(beside.notes.views, ElementsAre("front", "handle", "", "", "", "", "left", ""));
  const ImportOutcome instead = imported(with_angles({{"handle", 180.0}, {"left", 90.0}}));
  EXPECT_THAT(instead.notes.views, ElementsAre("front", "left", "handle", ""));
  put("top");
  expect_without_angle(with_angles({{"handle", 45.0}}), "top");
  EXPECT_THROW(imported(with_angles({{"handle", std::nan("")}})), ConfigError);
}

/// Nothing is given in vain.
TEST_F(Import, AnAngleOfPicturesThatTellTheirsIsRefused) {
  put("front");
  std::ofstream(folder_ / "mine/drill/front_pose.txt") << "1 0 0 0\n0 1 0 0\n0 0 1 1\n0 0 0 1\n";
  EXPECT_THAT(
      [&] {
        imported(with_angles({{"front", 30.0}}));
      },
      testing::ThrowsMessage<ConfigError>(HasSubstr("--view-yaw front=30: all pictures")));
}

TEST_F(Import, FoldersOfOneNameAreTwoRecordings) {
  put("front");
  for (const char* day : {"day1", "day2"}) {
    fs::create_directories(folder_ / day);
    fs::copy(folder_ / "mine", folder_ / day / "pics", fs::copy_options::recursive);
  }
  ImportOptions options;
  options.cut = "whole";
  const ImportOutcome outcome =
      import_pictures(options, {.from = {folder_ / "day1/pics", folder_ / "day2/pics"},
                                .root = folder_ / "out",
                                .overwrite = true});
  EXPECT_THAT(outcome.notes.recordings, ElementsAre("day1 pics", "day2 pics"));
  EXPECT_THAT(outcome.layouts, ElementsAre("{object}/{view}_{kind}", "{object}/{view}_{kind}"));
}

TEST_F(Import, GivenAnglesOfManyNumbersCount) {
  ImportOptions options;
  for (int i = 0; i < 14; ++i) {
    put(std::to_string(i));
    options.yaw_deg[std::to_string(i)] = 10.0 * i;
  }
  imported(options);
  const auto all = views();
  EXPECT_NEAR(std::ranges::max(all, {}, &ViewEntry::yaw_rad).yaw_rad,
              130.0 * std::numbers::pi / 180.0, 1e-6);
  options.yaw_deg.erase("7");
  expect_without_angle(options, "7");
}

TEST_F(Import, NumbersOfAnyLengthMakeATurn) {
  for (int i = 10; i < 22; ++i) put(fmt::format("170000000000000000{}", i));
  put("99");  // the last by name, the first by number
  imported({});
  const auto all = views();
  ASSERT_EQ(all.size(), 13U);
  EXPECT_EQ(all.back().yaw_rad, 0.0);
  for (int i = 0; i < 12; ++i) {
    EXPECT_NEAR(all[static_cast<std::size_t>(i)].yaw_rad, 2.0 * std::numbers::pi * (i + 1) / 13.0,
                1e-5);
  }
}

TEST_F(Import, AFolderIsReplacedByWhateverName) {
  put("front");
  imported({});
  put("left");
  EXPECT_EQ(imported({}, "out/.").pictures, 2);
  EXPECT_EQ(views().size(), 2U);
  EXPECT_EQ(entries_of(folder_.path()), 2) << "mine and out";
}

/// Degrees in the pose of a view.
double elevation_deg(const ViewEntry& view) {
  return view.given_elevation_rad.value_or(-1.0) * 180.0 / std::numbers::pi;
}

TEST_F(Import, PosesGiveAnglesAndElevations) {
  put("a");
  put("b");
  write_file(folder_ / "mine/drill/a_pose.txt", "90 30\n");
  write_file(folder_ / "mine/drill/b_pose.txt", "180\n");
  ImportOptions options;
  options.elevation_deg = 20.0;
  const ImportOutcome outcome = imported(options);
  EXPECT_EQ(outcome.objects, 1);
  EXPECT_EQ(outcome.pictures, 2);
  EXPECT_THAT(outcome.units, ElementsAre(testing::Pair(testing::DoubleEq(0.001), 2)));
  EXPECT_TRUE(outcome.notes.degrees);
  EXPECT_EQ(outcome.notes.bins, 4);
  EXPECT_TRUE(outcome.notes.views.empty());
  const auto all = views();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_NEAR(all[0].yaw_rad, 0.5 * std::numbers::pi, 1e-6);
  EXPECT_NEAR(all[1].yaw_rad, std::numbers::pi, 1e-6);
  EXPECT_NEAR(elevation_deg(all[0]), 30.0, 1e-3);
  EXPECT_NEAR(elevation_deg(all[1]), 20.0, 1e-3) << "where no pose tells";
}

TEST_F(Import, AMaskIsAsLargeAsItsPicture) {
  put("front");
  ImportOptions options;
  options.cut = "mask";
  const auto with_mask = [&](const cv::Size& size_px) {
    cv::imwrite((folder_ / "mine/drill/front_mask.png").string(),
                cv::Mat(size_px, CV_8UC1, cv::Scalar::all(255)));
    return import_pictures(options, {.from = {folder_ / "mine"}, .root = folder_ / "out"}).pictures;
  };
  EXPECT_THAT(
      [&] {
        with_mask({39, 30});
      },
      testing::ThrowsMessage<InputError>(
          HasSubstr("front_mask.png: is 39 x 30 px, its colour 40 x 30")));
  EXPECT_THAT(
      [&] {
        with_mask({40, 31});
      },
      testing::ThrowsMessage<InputError>(
          HasSubstr("front_mask.png: is 40 x 31 px, its colour 40 x 30")));
  EXPECT_EQ(with_mask({40, 30}), 1);
}

TEST_F(Import, ReplacesADatasetIfToldToAndNothingElse) {
  put("front");
  const auto taken_in = [&](const std::string& out, bool overwrite) {
    ImportOptions options;
    options.cut = "whole";
    return import_pictures(
               options, {.from = {folder_ / "mine"}, .root = folder_ / out, .overwrite = overwrite})
        .pictures;
  };
  fs::create_directories(folder_ / "out");
  EXPECT_EQ(taken_in("out", false), 1) << "it is empty";
  EXPECT_THROW(taken_in("out", false), ConfigError);
  EXPECT_EQ(taken_in("out", true), 1);
  fs::create_directories(folder_ / "other");
  write_file(folder_ / "other/precious", "mine");
  EXPECT_THROW(taken_in("other", true), ConfigError);
  EXPECT_EQ(read_file(folder_ / "other/precious"), "mine");
}

TEST_F(Import, TakesNoPicturesThatItMadeItself) {
  put("front");
  put("left");
  imported({}, "mine/out");
  imported({}, "mine/out");
  const DatasetIndex again = index_dataset(folder_ / "mine/out");
  ASSERT_EQ(again.views.size(), 2U);
  EXPECT_EQ(again.views[0].name.object, "drill_1");
}

TEST(ImportDefaults, AreToFindOutAndToReplaceNothing) {
  const ImportOptions options;
  EXPECT_EQ(options.cut, "auto");
  EXPECT_EQ(options.depth_unit_m, 0.0);
  EXPECT_EQ(options.bins, 0);
  const ImportRun run;
  EXPECT_EQ(run.jobs, 1);
  EXPECT_FALSE(run.overwrite || run.skip_bad);
  EXPECT_EQ(ImportOutcome{}.objects, 0);
  EXPECT_EQ(ImportOutcome{}.pictures, 0);
}

TEST_F(Import, WhatNobodyTellsIsAssumedAndSaid) {
  put("front");
  put("top");
  const ImportOutcome outcome = imported({});
  const auto all = views();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_NEAR(elevation_deg(all[0]), 45.0, 1e-3);
  EXPECT_NEAR(elevation_deg(all[1]), 90.0, 1e-3) << "a name tells";
  EXPECT_THAT(outcome.notices, Contains(HasSubstr("is not known of 1 pictures: 45 deg")));
  EXPECT_THAT(outcome.notices, Contains(HasSubstr("focal length not given: 570.3 px")));
  EXPECT_THAT(outcome.notices, Contains(HasSubstr("views front, top are told by name")));
  EXPECT_FALSE(outcome.notes.degrees);
  EXPECT_EQ(outcome.notes.bins, 2);
  EXPECT_THAT(outcome.notes.recordings, ElementsAre("pictures"));
}

TEST_F(Import, BinsAreThoseAskedFor) {
  put("front");
  put("left");
  ImportOptions options;
  EXPECT_THAT(imported(options).notes.views, ElementsAre("front", "", "", "left"));
  options.bins = 12;
  const ImportOutcome outcome = imported(options);
  EXPECT_EQ(outcome.notes.bins, 12);
  EXPECT_TRUE(outcome.notes.views.empty()) << "names are of four";
  put("handle");
  EXPECT_THROW(imported(options), ConfigError);
  options.bins = 3;
  EXPECT_EQ(imported(options).notes.bins, 3);
}

TEST(ReplaceFolder, KeepsWhatWasThereIfItFails) {
  const support::TemporaryDirectory folder;
  fs::create_directories(folder / "data");
  write_file(folder / "data/notes", "old");
  EXPECT_THROW(replace_folder(folder / "data.part", folder / "data"), OutputError);
  EXPECT_EQ(read_file(folder / "data/notes"), "old");
  fs::create_directories(folder / "data.part");
  fs::create_directories(folder / ".data.before/old");  // as a kill leaves it
  write_file(folder / "data.part/notes", "new");
  replace_folder(folder / "data.part", folder / "data");
  EXPECT_EQ(read_file(folder / "data/notes"), "new");
  EXPECT_EQ(entries_of(folder.path()), 1);
}

TEST_F(Import, NoElevationIsAssumedWhereAllAreKnown) {
  put("front");
  ImportOptions options;
  options.elevation_deg = 20.0;
  EXPECT_THAT(imported(options).notices, Not(Contains(HasSubstr("is not known of"))));
}

TEST_F(Import, ManyViewsByNameAreNoTurn) {
  for (char letter = 'a'; letter < 'n'; ++letter) put(std::string(3, letter));
  const ImportOutcome outcome = imported({});
  EXPECT_EQ(outcome.views.size(), 13U);
  EXPECT_EQ(outcome.notes.bins, 13) << "one each";
  EXPECT_THAT(outcome.notices, Not(Contains(HasSubstr("taken for one turn"))));
}

/// A block on a table, 0.6 m below a camera that looks down by that; of 160 x 120 px, in mm.
cv::Mat table_seen_from(double elevation_rad) {
  cv::Mat depth(120, 160, CV_16UC1);
  for (int row = 0; row < depth.rows; ++row) {
    const double y = (row - 60) / 200.0;
    const double z_m = 0.6 / (y * std::cos(elevation_rad) + std::sin(elevation_rad));
    depth.row(row).setTo(std::lround(1000.0 * z_m));
  }
  depth(cv::Rect(65, 45, 30, 30)) -= 100;
  return depth;
}

TEST_F(Import, ElevationsAreTheMedianOfThoseOverTheTablesSeen) {
  for (const auto& [view, elevation] : {std::pair("front", 50.0), {"left", 30.0}, {"back", 35.0}}) {
    put(view);
    const std::string stem = (folder_ / "mine/drill" / view).string();
    cv::imwrite(stem + "_rgb.png", cv::Mat(120, 160, CV_8UC3, cv::Scalar::all(90)));
    cv::imwrite(stem + "_depth.png", table_seen_from(elevation * std::numbers::pi / 180.0));
  }
  ImportOptions options = with_camera(200.0);
  options.cut = "depth";
  const ImportOutcome outcome =
      import_pictures(options, {.from = {folder_ / "mine"}, .root = folder_ / "out"});
  EXPECT_THAT(outcome.notices, Not(Contains(HasSubstr("is not known of"))));
  EXPECT_THAT(outcome.notices, Contains(HasSubstr("pictures: the camera looks down by 35 deg")));
  ASSERT_EQ(views().size(), 3U);
  for (const ViewEntry& view : views()) EXPECT_NEAR(elevation_deg(view), 35.0, 0.2);
}

TEST_F(Import, LeavesBadPicturesOutIfToldTo) {
  put("front");
  put("left");
  ImportOptions options;
  options.cut = "whole";
  const auto taken_in = [&](bool skip_bad) {
    return import_pictures(options, {.from = {folder_ / "mine"},
                                     .root = folder_ / "out",
                                     .overwrite = true,
                                     .skip_bad = skip_bad});
  };
  const auto error_of = [&](bool skip_bad) {
    try {
      taken_in(skip_bad);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const auto resize = [&](const std::string& file, int height_px, int type) {
    cv::imwrite((folder_ / ("mine/drill/" + file)).string(),
                cv::Mat(height_px, 40, type, cv::Scalar::all(900)));
  };
  resize("left_depth.png", 29, CV_16UC1);
  EXPECT_THAT(error_of(false),
              HasSubstr("left_depth.png: is 40 x 29 px, its colour 40 x 30; depth must be "
                        "registered to colour; 1 of 2 pictures cannot be used, --skip-bad"));
  EXPECT_THAT(taken_in(true).left_out, ElementsAre(HasSubstr("left_depth.png: is 40 x 29 px")));
  ASSERT_EQ(views().size(), 1U);
  EXPECT_EQ(views()[0].yaw_rad, 0.0) << "the front";
  const auto resize_front = [&](int height_px) {
    resize("front_rgb.png", height_px, CV_8UC3);
    resize("front_depth.png", height_px, CV_16UC1);
  };
  resize_front(8);
  EXPECT_EQ(taken_in(true).pictures, 1);
  resize_front(7);
  EXPECT_THAT(error_of(true), testing::AllOf(HasSubstr("front_rgb.png: is 40 x 7 px; a picture has "
                                                       "at least 8 x 8; 2 of 2 pictures"),
                                             Not(HasSubstr("--skip-bad"))));
}

TEST_F(Import, SaysWhatDoesNotFitTheUsualCamera) {
  put("front");
  const auto notices_of = [&](int width_px, const ImportOptions& options) {
    const std::string stem = (folder_ / "mine/drill/front").string();
    cv::imwrite(stem + "_rgb.png", cv::Mat(30, width_px, CV_8UC3, cv::Scalar::all(90)));
    cv::imwrite(stem + "_depth.png", cv::Mat(30, width_px, CV_16UC1, cv::Scalar(900)));
    return imported(options).notices;
  };
  EXPECT_THAT(notices_of(640, {}), Not(Contains(HasSubstr("px wide"))));
  EXPECT_THAT(notices_of(641, {}), Contains(HasSubstr("a picture is 641 px wide")));
  EXPECT_THAT(notices_of(641, with_camera(570.0)), Not(Contains(HasSubstr("px wide"))));
  put("left");
  EXPECT_THAT(imported({}).notices, Not(Contains(HasSubstr("metres"))));
  fs::remove(folder_ / "mine/drill/left_depth.png");
  cv::imwrite((folder_ / "mine/drill/left_depth.tiff").string(),
              cv::Mat(30, 40, CV_32FC1, cv::Scalar(0.9)));
  const ImportOutcome both = imported({});
  EXPECT_THAT(both.units, ElementsAre(testing::Pair(0.001, 1), testing::Pair(1.0, 1)));
  EXPECT_THAT(both.notices, Contains(HasSubstr("millimetres in some files and in metres")));
}

TEST_F(Import, AnglesGoWithNamesThatHaveOneToo) {
  put("30deg");
  put("left");
  const ImportOutcome outcome = imported({});
  EXPECT_EQ(outcome.notes.bins, 12) << "30 and 270 deg";
  EXPECT_TRUE(outcome.notes.views.empty());
  put("handle");
  EXPECT_THAT([&] { imported({}); }, testing::ThrowsMessage<InputError>(HasSubstr(
                                         "a view without one, such as 'left'; give all")));
}

}  // namespace
}  // namespace vantage
