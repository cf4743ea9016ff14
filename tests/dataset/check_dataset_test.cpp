// What is said of a dataset before it is trained on.
#include "vantage/dataset/pictures/check_dataset.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/dataset/view_files.hpp"

namespace vantage {
namespace {
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A view of one colour at one distance, all of it object.
struct PlainView {
  int width_px = 20;
  int height_px = 10;
  double depth_m = 1.0;
  int grey = 10;
};

class CheckedFolder : public testing::Test {
 protected:
  /// @param change of the view before it is written
  template <class Change>
  void put(const std::string& object, int video, int frame, double yaw_deg, const PlainView& plain,
           Change&& change) {
    ObjectView view;
    view.width_px = plain.width_px;
    view.height_px = plain.height_px;
    const auto pixels =
        static_cast<std::size_t>(plain.width_px) * static_cast<std::size_t>(plain.height_px);
    view.rgb.assign(3 * pixels, static_cast<std::uint8_t>(plain.grey));
    view.depth_m.assign(pixels, static_cast<float>(plain.depth_m));
    view.mask.assign(pixels, 1);
    change(view);
    const ViewEntry entry{{"cup", object, video, frame},
                          folder_ / "cup" / object,
                          yaw_deg * std::numbers::pi / 180.0};
    std::filesystem::create_directories(entry.folder);
    write_view(view, entry);
  }
  void put(const std::string& object, int video, int frame, double yaw_deg,
           const PlainView& plain) {
    put(object, video, frame, yaw_deg, plain, [](ObjectView&) {});
  }
  /// A view more, of another picture, so that none is alone.
  void put_another(const std::string& object) {
    put(object, 1, 99, 10.0, {.depth_m = 0.9, .grey = 99});
  }
  CheckedDataset check(int bins = 0) {
    return check_dataset(folder_.path(), bins, [] {});
  }
  support::TemporaryDirectory folder_;
};

TEST_F(CheckedFolder, MeasuresEveryView) {
  put("cup_1", 1, 1, 0.0, {.depth_m = 1.0, .grey = 1}, [](ObjectView& view) {
    for (std::size_t i = 0; i < 50; ++i) view.mask[i] = 0;
    for (std::size_t i = 170; i < 200; ++i) view.depth_m[i] = 0.0F;
  });
  put("cup_1", 2, 1, 0.0, {.depth_m = 2.0, .grey = 2});
  put("cup_1", 2, 2, 90.0, {.depth_m = 3.0, .grey = 3});
  put("cup_2", 1, 1, 0.0, {.depth_m = 1.5, .grey = 4});
  put("cup_2", 1, 2, 44.0, {.depth_m = 1.5, .grey = 5});
  int polled = 0;
  const CheckedDataset checked = check_dataset(folder_.path(), 0, [&] { ++polled; });
  EXPECT_EQ(polled, 5);
  EXPECT_EQ(checked.views, 5);
  EXPECT_EQ(checked.bins, 8);
  EXPECT_DOUBLE_EQ(checked.holes.least, 0.0);
  EXPECT_NEAR(checked.holes.most, 0.2, 1e-12);
  EXPECT_DOUBLE_EQ(checked.mask.least, 0.75);
  EXPECT_DOUBLE_EQ(checked.mask.median, 1.0);
  EXPECT_NEAR(checked.distance_m.least, 1.0, 1e-6);
  EXPECT_NEAR(checked.distance_m.median, 1.5, 1e-6);
  EXPECT_NEAR(checked.distance_m.most, 3.0, 1e-6);
  EXPECT_EQ(checked.pictures.size(), 5U);
  ASSERT_EQ(checked.objects.size(), 2U);
  const CheckedObject& first = checked.objects[0];
  EXPECT_EQ(first.object, "cup_1");
  EXPECT_EQ(first.views, 3);
  EXPECT_EQ(first.recordings, 2);
  EXPECT_EQ(first.bins, 2);
  EXPECT_EQ(first.thin_bins, 1);
  EXPECT_DOUBLE_EQ(first.holes, 0.0);
  EXPECT_EQ(checked.objects[1].bins, 2);
  EXPECT_EQ(checked.objects[1].thin_bins, 2);
  EXPECT_THAT(checked.problems, IsEmpty());
  EXPECT_NEAR(first.size_m, 19.0 * 2.0 / 570.3, 1e-6) << "20 px 2 m away are the median";
  EXPECT_THAT(checked.advice, ElementsAre(HasSubstr("2 of 2 objects have directions with one")));
  EXPECT_EQ(check(4).objects[1].bins, 1) << "0 and 44 deg in bins of 90";
}

/// 150 pixels are enough.
TEST_F(CheckedFolder, AdvisesOnSmallObjectsAndOnHoles) {
  const auto masked = [](std::size_t pixels, std::size_t holes) {
    return [=](ObjectView& view) {
      for (std::size_t i = pixels; i < view.mask.size(); ++i) view.mask[i] = 0;
      for (std::size_t i = 0; i < holes; ++i) view.depth_m[i] = 0.0F;
    };
  };
  put_another("cup_1");
  put("cup_1", 1, 1, 0.0, {.grey = 1}, masked(150, 0));
  put("cup_1", 1, 2, 0.0, {.grey = 2}, masked(200, 100));
  EXPECT_THAT(check().advice, Not(Contains(HasSubstr("pixels; fewer"))));
  EXPECT_THAT(check().advice, Not(Contains(HasSubstr("has no depth"))));
  put("cup_1", 1, 1, 0.0, {.grey = 1}, masked(149, 0));
  put("cup_1", 1, 2, 0.0, {.grey = 2}, masked(200, 110));
  EXPECT_THAT(check().advice,
              Contains(HasSubstr("cup_1_1_1_depthcrop.png: the object has 149 pixels; fewer than "
                                 "150 tell little")));
  EXPECT_THAT(check().advice,
              Contains(HasSubstr("cup_1_1_2_depthcrop.png: 55 % of the object has no depth")));
}

TEST_F(CheckedFolder, DistancesAndSizesThatCannotBeAreProblems) {
  const auto problems_of = [&](const PlainView& plain) {
    put("cup_1", 1, 1, 0.0, plain);
    return check().problems;
  };
  put_another("cup_1");
  EXPECT_THAT(problems_of({.depth_m = 0.16}), IsEmpty());
  EXPECT_THAT(problems_of({.depth_m = 0.14}), ElementsAre(HasSubstr("is 0.14 m away")));
  EXPECT_THAT(problems_of({.depth_m = 5.9}), IsEmpty());
  EXPECT_THAT(problems_of({.depth_m = 6.1}), ElementsAre(HasSubstr("is 6.1 m away")));
  // 95 % of 200 px at 570.3 px: a third of the distance.
  EXPECT_THAT(problems_of({.width_px = 200, .height_px = 10, .depth_m = 4.4}), IsEmpty());
  EXPECT_THAT(problems_of({.width_px = 200, .height_px = 10, .depth_m = 4.46}), IsEmpty())
      << "190 px are 1.49 m";
  EXPECT_THAT(problems_of({.width_px = 200, .height_px = 10, .depth_m = 4.6}),
              ElementsAre(HasSubstr("m large")));
  EXPECT_THAT(problems_of({.width_px = 10, .height_px = 200, .depth_m = 4.6}),
              ElementsAre(HasSubstr("m large")));
  EXPECT_THAT(problems_of({.width_px = 13, .height_px = 13, .depth_m = 0.3}), IsEmpty());
  EXPECT_THAT(problems_of({.width_px = 13, .height_px = 13, .depth_m = 0.2}),
              ElementsAre(HasSubstr("m large")));
}

TEST_F(CheckedFolder, CopiesAreTold) {
  put("cup_1", 1, 1, 0.0, {.grey = 1});
  put("cup_1", 1, 2, 40.0, {.grey = 1});
  put("cup_2", 1, 1, 0.0, {.grey = 2});
  put("cup_2", 1, 2, 0.0, {.depth_m = 1.1, .grey = 2});
  const CheckedDataset within = check();
  EXPECT_THAT(within.problems, IsEmpty());
  EXPECT_THAT(within.advice,
              Contains(AllOf(HasSubstr("cup_1_1_2_crop.png: is the same picture as "),
                             HasSubstr("cup_1_1_1_crop.png; copies count once in training"))));
  EXPECT_EQ(within.pictures.size(), 3U);
  put("cup_2", 1, 2, 0.0, {.grey = 1});
  EXPECT_THAT(check().problems, ElementsAre(HasSubstr(", of another object")));
}

TEST_F(CheckedFolder, ObjectsOfFewPicturesAreTold) {
  put("cup_1", 1, 1, 0.0, {.grey = 1});
  put("cup_2", 1, 1, 0.0, {.grey = 2});
  put("cup_2", 1, 2, 90.0, {.grey = 3});
  put("cup_2", 1, 3, 180.0, {.grey = 4});
  put("cup_3", 1, 1, 0.0, {.grey = 5});
  put("cup_3", 1, 2, 90.0, {.grey = 6});
  const CheckedDataset checked = check();
  EXPECT_THAT(checked.problems,
              ElementsAre("cup_1: a single picture; take it from another side too"));
  EXPECT_THAT(checked.advice, Contains("cup_3: pictures from 2 of 3 directions"));
  EXPECT_THAT(checked.advice, Not(Contains(HasSubstr("cup_2: pictures"))));
  EXPECT_THAT(checked.advice, Contains(HasSubstr("one recording of every object")));
}

TEST_F(CheckedFolder, IsWhatItsNotesSay) {
  put("cup_1", 1, 1, 0.0, {.grey = 1});
  put("cup_1", 1, 2, 44.0, {.grey = 2});
  PictureNotes notes;
  notes.cut = "depth";
  notes.focal_px = 400.0;
  notes.bins = 4;
  write_file(folder_ / kPictureNotes, to_text(notes));
  const CheckedDataset checked = check();
  EXPECT_EQ(checked.cut, ObjectCut::depth);
  EXPECT_EQ(checked.focal_px, 400.0);
  EXPECT_EQ(checked.bins, 4);
  EXPECT_EQ(checked.objects.at(0).bins, 1);
  EXPECT_EQ(check(12).bins, 12) << "where it is asked for others";
  EXPECT_EQ(check(1).bins, 1);
}

TEST_F(CheckedFolder, ViewsThatCannotBeReadAreProblems) {
  put_another("cup_1");
  put("cup_1", 1, 2, 90.0, {.grey = 2});
  put("cup_1", 1, 3, 90.0, {.grey = 3});
  write_file(folder_ / "cup/cup_1/cup_1_1_2_depthcrop.png", "no picture");
  std::filesystem::remove(folder_ / "cup/cup_1/cup_1_1_3_maskcrop.png");
  const CheckedDataset checked = check();
  EXPECT_THAT(checked.problems, Contains(HasSubstr("cup_1_1_3_maskcrop.png: is missing")));
  EXPECT_THAT(checked.problems, Contains(HasSubstr("cup_1_1_2_depthcrop.png")));
  EXPECT_EQ(checked.objects.at(0).views, 1);
}

TEST(CheckedDatasets, AreOfNothingAtFirst) {
  const CheckedObject object;
  for (const int count : {object.views, object.recordings, object.bins, object.thin_bins}) {
    EXPECT_EQ(count, 0);
  }
  EXPECT_EQ(object.holes, 0.0);
  EXPECT_EQ(object.size_m, 0.0);
  const CheckedDataset dataset;
  EXPECT_EQ(dataset.cut, ObjectCut::mask);
  EXPECT_EQ(dataset.bins, 8);
  EXPECT_EQ(dataset.focal_px, 570.3);
  EXPECT_EQ(dataset.views, 0);
  for (const double value : {dataset.holes.least, dataset.holes.median, dataset.holes.most}) {
    EXPECT_EQ(value, 0.0);
  }
}

TEST_F(CheckedFolder, WithoutAnyDepthIsNeitherNearNorSmall) {
  put_another("cup_1");
  put("cup_1", 1, 1, 0.0, {.grey = 1}, [](ObjectView& view) {
    for (float& depth_m : view.depth_m) depth_m = 0.0F;
  });
  EXPECT_THAT(check().problems, IsEmpty());
  EXPECT_THAT(check().advice,
              Contains(HasSubstr("cup_1_1_1_depthcrop.png: 100 % of the object has no depth")));
}

}  // namespace
}  // namespace vantage
