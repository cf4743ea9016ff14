// Training on few pictures, as users have them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <tuple>
#include <variant>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/error.hpp"
#include "vantage/perception/dataset_reader.hpp"
#include "vantage/recognition/dataset/picture_views.hpp"
#include "vantage/recognition/training.hpp"

namespace vantage {
namespace {

/// A flat plate 1 m before the camera, a pixel of it 1 cm wide.
void put_plate(const std::filesystem::path& root, const std::string& object, int video, int frame,
               int width_px, int height_px) {
  const auto folder = root / "plate" / object;
  std::filesystem::create_directories(folder);
  const std::string stem = (folder / fmt::format("{}_{}_{}", object, video, frame)).string();
  const cv::Size size(width_px, height_px);
  cv::imwrite(stem + "_crop.png", cv::Mat(size, CV_8UC3, cv::Scalar::all(90.0)));
  cv::imwrite(stem + "_depthcrop.png", cv::Mat(size, CV_16UC1, cv::Scalar(1000.0)));
  cv::imwrite(stem + "_maskcrop.png", cv::Mat(size, CV_8UC1, cv::Scalar(255.0)));
  std::ofstream(stem + "_loc.txt") << "300,200\n";
  std::ofstream(stem + "_pose.txt") << "0 0\n";
}

/// Pictures of two sides.
DatasetIndex index_of_plates(const std::filesystem::path& folder) {
  DatasetIndex dataset = index_dataset(folder);
  const auto notes = std::make_shared<PictureNotes>();
  notes->bins = 2;
  notes->focal_px = 100.0;
  for (ViewEntry& view : dataset.views) view.notes = notes;
  return dataset;
}

/// By width and height.
TrainingOptions plate_options(double floor = 0.5) {
  TrainingOptions options;
  options.features = {BoundingBox{}};
  options.variance = ShrunkVariance{.floor = floor};
  options.transition_prior_moves = 0.0;
  options.unknown = false;
  return options;
}

RecognitionModel model_of_plates(const std::filesystem::path& folder, double floor = 0.5) {
  return train_recognition(index_of_plates(folder), plate_options(floor), {});
}

double floor_of(const RecognitionModel& model) {
  return std::get<ShrunkVariance>(floored(model, ShrunkVariance{.floor = 0.0})).floor;
}

/// Two pictures of either plate in each of two recordings.
void put_plates(const std::filesystem::path& folder, int other_width_px) {
  for (const int video : {1, 2}) {
    for (const int frame : {1, 2}) {
      const int off_px = 2 * frame - 3;
      put_plate(folder, "plate_1", video, frame, 20, (video == 1 ? 30 : 50) + off_px);
      put_plate(folder, "plate_2", video, frame, other_width_px, (video == 1 ? 50 : 30) + off_px);
    }
  }
}

/// Heights are exchanged from one recording to the other, only widths tell the plates. The variance
/// of heights is 2 px^2, the mean of the three numbers 2/3 px^2. With widths of f times that mean
/// the lead is (3 * 10^2 / f - 20^2 -+ 40) / 4 nats: all are right with the floor of 0.5 that the
/// options have, and all are wrong with 1.
TEST(FewPictures, HaveTheHighestFloorThatIsAsGood) {
  const support::TemporaryDirectory folder;
  put_plates(folder.path(), 30);
  const RecognitionModel model = model_of_plates(folder.path());
  EXPECT_EQ(std::get<ShrunkVariance>(floored(model, ShrunkVariance{})).floor, 0.3)
      << "of 0, 0.1, 0.3, 1 and 3";
  // Leads of 40 and 60 nats, the higher once more as a mistake.
  EXPECT_NEAR(model.features[0].psi, 0.0365, 0.01);
}

/// With plates f px apart in width the lead is (3 f^2 / floor - 20^2 -+ 40) / 4 nats.
TEST(FewPictures, HaveAFloorOfFive) {
  for (const auto& [apart_px, least, floor] : {std::tuple(3, 0.05, 0.0),
                                               {5, 0.09, 0.1},
                                               {10, 0.29, 0.3},
                                               {15, 0.9, 1.0},
                                               {30, 2.9, 3.0}}) {
    const support::TemporaryDirectory folder;
    put_plates(folder.path(), 20 + apart_px);
    EXPECT_EQ(floor_of(model_of_plates(folder.path(), least)), floor) << apart_px;
  }
}

/// As above, with six pictures of either plate in each of the two recordings; where there are as
/// many as six for each of four states, the floor is left to the options.
TEST(FewPictures, AreLessThanSixOfEachState) {
  for (const bool one_less : {false, true}) {
    const support::TemporaryDirectory folder;
    for (const int video : {1, 2}) {
      for (int frame = 1; frame <= 6; ++frame) {
        const int off_px = frame <= 3 ? frame - 4 : frame - 3;
        put_plate(folder.path(), "plate_1", video, frame, 20, (video == 1 ? 30 : 50) + off_px);
        if (one_less && video == 2 && frame == 6) continue;
        put_plate(folder.path(), "plate_2", video, frame, 30, (video == 1 ? 50 : 30) + off_px);
      }
    }
    const double floor = floor_of(model_of_plates(folder.path()));
    EXPECT_EQ(floor > 0.0, one_less) << floor;
  }
}

TEST(FewPictures, NeedNoFeatureThatAllOfThemHave) {
  const support::TemporaryDirectory folder;
  put_plates(folder.path(), 30);
  TrainingOptions options = plate_options();
  options.features = {BoundingBox{}, Colour{.min_pixels = 600}};  // 20 x 29 px are fewer
  const RecognitionModel model = train_recognition(index_of_plates(folder.path()), options, {});
  EXPECT_EQ(model.features[0].statistics.count[0], 4);
  EXPECT_EQ(model.features[1].statistics.count[0], 3);
  options.features = {Colour{.min_pixels = 100000}, BoundingBox{}};
  EXPECT_THAT([&] { (void)train_recognition(index_of_plates(folder.path()), options, {}); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("feature 'colour'")));
}

TEST(FewPictures, OfATransitionLearntFromHalfAMove) {
  const support::TemporaryDirectory folder;
  put_plates(folder.path(), 30);
  TrainingOptions options = plate_options();
  options.transition_prior_moves = 0.5;
  const RecognitionModel model = train_recognition(index_of_plates(folder.path()), options, {});
  EXPECT_EQ(model.transitions.slip.rows(), 2);
}

TEST(FewPictures, AddedLaterAreCheckedLikeTheFirst) {
  const support::TemporaryDirectory folder;
  put_plates(folder.path(), 30);
  RecognitionModel model = model_of_plates(folder.path());
  const support::TemporaryDirectory more;
  for (const int frame : {1, 2}) put_plate(more.path(), "plate_3", 1, frame, 40, 10 + 20 * frame);
  TrainingOptions options = plate_options();
  options.videos = {1, 1};
  EXPECT_THROW(extend_recognition(model, index_of_plates(more.path()), options, {}), ConfigError);
  options.videos = {1};
  extend_recognition(model, index_of_plates(more.path()), options, {});
  EXPECT_EQ(model.states.object_count(), 3);
}

/// The second recording calls its first direction as the first one calls its second.
TEST(FewPictures, AreOfTheDirectionThatTheyAreNamedAfter) {
  const support::TemporaryDirectory folder;
  put_plates(folder.path(), 30);
  PictureNotes named;
  named.bins = 2;
  named.degrees = false;
  DatasetIndex dataset = index_of_plates(folder.path());
  for (ViewEntry& view : dataset.views) {
    named.views = {"front", "back"};
    if (view.name.video == 2) named.views = {"back", "front"};
    view.notes = std::make_shared<const PictureNotes>(named);
  }
  TrainingOptions options = plate_options();
  options.psi = PerDimensionPsi{};
  const RecognitionModel model = train_recognition(dataset, options, {});
  EXPECT_THAT(model.features[0].statistics.count, testing::ElementsAre(2, 2, 2, 2));
}

}  // namespace
}  // namespace vantage
