// What is said of two datasets.
#include "vantage/dataset/pictures/dataset_differences.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vantage {
namespace {
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

TEST(DatasetDifferences, AreNoProblemAtFirst) { EXPECT_FALSE(DatasetDifference{}.problem); }

class TwoDatasets : public testing::Test {
 protected:
  TwoDatasets() {
    for (CheckedDataset* dataset : {&training_, &test_}) {
      dataset->mask = {0.2, 0.6, 0.9};
      dataset->holes = {0.0, 0.1, 0.3};
      dataset->focal_px = 500.0;
      dataset->objects = {{.object = "cup_1"}};
      dataset->pictures = {{7, "x.png"}};
    }
    training_.root = "mine";
    test_.root = "yours";
    test_.pictures = {{8, "y.png"}, {9, "z.png"}};
  }
  /// "!" before what is a problem.
  std::vector<std::string> said() {
    std::vector<std::string> texts;
    for (const DatasetDifference& found : differences(training_, test_)) {
      texts.push_back((found.problem ? "!" : "") + found.text);
    }
    return texts;
  }
  CheckedDataset training_, test_;
};

TEST_F(TwoDatasets, ThatAreAlikeDoNotDiffer) { EXPECT_THAT(said(), IsEmpty()); }

TEST_F(TwoDatasets, DifferByWhatMasksFill) {
  test_.mask.median = 0.41;
  EXPECT_THAT(said(), IsEmpty());
  test_.mask.median = 0.39;
  EXPECT_THAT(said(), ElementsAre(HasSubstr("60 % of a picture in mine and 39 % in yours")));
  test_.mask.median = 0.89;
  EXPECT_THAT(said(), IsEmpty());
  test_.mask.median = 0.91;
  EXPECT_THAT(said(), ElementsAre(HasSubstr("60 % of a picture in mine and 91 % in yours")));
  training_.cut = test_.cut = ObjectCut::depth;
  EXPECT_THAT(said(), IsEmpty()) << "what is cut by depth is cut alike";
}

TEST_F(TwoDatasets, DifferByHolesAndFocalLength) {
  test_.holes.median = 0.24;
  test_.focal_px = 509.0;
  EXPECT_THAT(said(), IsEmpty());
  test_.holes.median = 0.26;
  EXPECT_THAT(said(), ElementsAre("10 % of the object has no depth in mine, 26 % in yours"));
  test_.holes.median = 0.1;
  test_.focal_px = 511.0;
  EXPECT_THAT(said(), ElementsAre(HasSubstr("500 px in mine and 511 px in yours")));
  test_.focal_px = 489.0;
  EXPECT_THAT(said(), ElementsAre(HasSubstr("500 px in mine and 489 px in yours")));
}

TEST_F(TwoDatasets, DifferByTheirCut) {
  training_.cut = ObjectCut::depth;
  EXPECT_THAT(said(),
              ElementsAre(AllOf(StartsWith("the object is cut by depth in mine and by mask"),
                                HasSubstr("cut by depth again"))));
  training_.cut = ObjectCut::mask;
  test_.cut = ObjectCut::depth;
  EXPECT_THAT(said(), ElementsAre(AllOf(StartsWith("!the object is cut by mask"),
                                        HasSubstr("import the first with --cut depth"))));
}

TEST_F(TwoDatasets, MustShowTheSameObjectsAsLarge) {
  const auto sized = [&](double first_m, double second_m, double strange_m) {
    training_.objects = {{.object = "cup_1", .size_m = 0.1}, {.object = "jug_2", .size_m = 0.2}};
    test_.objects = {{.object = "cup_1", .size_m = first_m},
                     {.object = "jug_2", .size_m = second_m}};
    training_.objects.push_back({.object = "can_3", .size_m = strange_m});
    return said();
  };
  EXPECT_THAT(sized(0.14, 0.28, 9.0), IsEmpty());
  EXPECT_THAT(sized(0.07, 0.14, 9.0), IsEmpty());
  EXPECT_THAT(sized(0.5, 1.0, 0.1),
              ElementsAre(StartsWith("!objects are 5 times as large in yours as in mine")));
  EXPECT_THAT(sized(0.06, 0.12, 0.1),
              ElementsAre(StartsWith("!objects are 0.6 times as large in yours")));
}

/// All numbers are those of doubles, to the bit.
TEST_F(TwoDatasets, MayDifferByAsMuchAsTheLimits) {
  training_.mask.median = 0.5;
  test_.mask.median = 0.75;
  training_.holes.median = 0.15;
  test_.holes.median = 0.0;
  test_.focal_px = 510.0;
  training_.objects = {{.object = "cup_1", .size_m = 0.25}};
  test_.objects = {{.object = "cup_1", .size_m = 0.375}};
  EXPECT_THAT(said(), IsEmpty());
}

/// Of an even number the lower one in the middle.
TEST_F(TwoDatasets, AreAsLargeAsTheMedianOfTheirObjects) {
  const auto sized = [&](const std::vector<double>& sizes_m) {
    training_.objects.clear();
    test_.objects.clear();
    for (const double size_m : sizes_m) {
      const std::string name = "cup_" + std::to_string(test_.objects.size());
      training_.objects.push_back({.object = name, .size_m = 0.5});
      test_.objects.push_back({.object = name, .size_m = size_m});
    }
    return said();
  };
  EXPECT_THAT(sized({4.0, 0.5, 1.5}), ElementsAre(StartsWith("!objects are 3 times as large")));
  EXPECT_THAT(sized({4.0, 1.5}), ElementsAre(StartsWith("!objects are 3 times as large")));
  EXPECT_THAT(sized({4.0, 0.5, 1.5, 2.5, 0.5}),
              ElementsAre(StartsWith("!objects are 3 times as large")));
}

TEST_F(TwoDatasets, AreNotComparedByObjectsOfNoKnownSize) {
  training_.objects = {{.object = "cup_1", .size_m = 0.0}, {.object = "jug_2", .size_m = 0.2}};
  test_.objects = {{.object = "cup_1", .size_m = 0.1}, {.object = "jug_2", .size_m = 0.0}};
  EXPECT_THAT(said(), IsEmpty());
}

TEST_F(TwoDatasets, NameTheFirstOfThePicturesTheyShare) {
  training_.pictures = {{9, "w.png"}};
  EXPECT_THAT(said(), ElementsAre(StartsWith("!1 of 2 pictures to test on are trained on (z.png is "
                                             "w.png)")));
  training_.pictures[8] = "v.png";
  EXPECT_THAT(said(), ElementsAre(StartsWith("!2 of 2 pictures to test on are trained on (y.png is "
                                             "v.png)")));
}

TEST_F(TwoDatasets, MustNotShareTheirPictures) {
  test_.pictures[7] = "copy.png";
  EXPECT_THAT(
      said(),
      ElementsAre(StartsWith("!1 of 3 pictures to test on are trained on (copy.png is x.png)")));
}

TEST_F(TwoDatasets, NameObjectsThatAreNotTrainedOn) {
  test_.objects.push_back({.object = "jug_2"});
  training_.objects.push_back({.object = "can_3"});
  EXPECT_THAT(said(),
              ElementsAre("not trained on: jug_2; of these only the category can be right"));
}

TEST_F(TwoDatasets, WhoseNumbersDifferMayStillBeUsed) {
  test_.mask.median = 0.39;
  test_.holes.median = 0.26;
  test_.focal_px = 511.0;
  test_.objects.push_back({.object = "jug_2"});
  EXPECT_THAT(said(), AllOf(testing::SizeIs(4), testing::Each(Not(StartsWith("!")))));
}

}  // namespace
}  // namespace vantage
