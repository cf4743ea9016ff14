#include "vantage/runtime/log/candidate_table.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <numbers>
#include <sstream>

#include "tests/support/temporary_directory.hpp"

namespace vantage {
namespace {

std::vector<double> numbers_in(const std::string& columns) {
  std::vector<double> numbers;
  std::istringstream stream(columns);
  for (std::string field; std::getline(stream, field, ',');) numbers.push_back(std::stod(field));
  return numbers;
}

TEST(PoseColumns, ArePositionHeadingAndPitch) {
  for (const double yaw_rad : {-2.5, -0.4, 0.7, 3.0}) {
    for (const double pitch_rad : {-1.2, 0.0, 0.3, 1.5}) {
      const auto numbers =
          numbers_in(pose_columns(make_pose({1.5, -2.5, 0.75}, yaw_rad, pitch_rad)));
      ASSERT_EQ(numbers.size(), 5U);
      EXPECT_EQ(numbers[0], 1.5);
      EXPECT_EQ(numbers[1], -2.5);
      EXPECT_EQ(numbers[2], 0.75);
      EXPECT_NEAR(numbers[3], yaw_rad, 1e-12);
      EXPECT_NEAR(numbers[4], pitch_rad, 1e-12) << "down is positive";
    }
  }
}

TEST(PoseColumns, HaveNoNegativeZero) {
  EXPECT_EQ(pose_columns(make_pose({1.0, 2.0, 3.0}, 0.0)), "1,2,3,0,0");
}

TEST(ViewColumns, LeaveOutWhatThereIsNot) {
  ViewOption view{.T_world_sensor = make_pose({1.0, 2.0, 3.0}, 0.0),
                  .gain = 2.5,
                  .gain_unit = "bits",
                  .predicted_cells = 7.5,
                  .way_m = 1.25};
  EXPECT_EQ(view_columns(view), "1,2,3,0,0,2.5,bits,7.5,1.25");
  view.predicted_cells.reset();
  EXPECT_EQ(view_columns(view), "1,2,3,0,0,2.5,bits,,1.25");
  view.way_m = std::numeric_limits<double>::infinity();
  EXPECT_EQ(view_columns(view), "1,2,3,0,0,2.5,bits,,");
  EXPECT_EQ(ViewOption{}.way_m, 0.0);
  EXPECT_EQ(ViewOption{}.gain, 0.0);
}

TEST(CandidateTable, HasARowForEachCandidateOfEachDecision) {
  const support::TemporaryDirectory folder;
  CandidateTable table(folder.path(), "x_m,y_m");
  table.add_decision(std::array{CandidateRow{5, "1,2"}, CandidateRow{7, "3,4"}}, 1);
  table.add_decision(std::array{CandidateRow{9, "5,6"}}, 1);
  table.add_decision(std::array{CandidateRow{2, "7,8"}, CandidateRow{3, "9,0"}}, 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "candidates.csv"));
  table.commit();
  EXPECT_EQ(read_file(folder / "candidates.csv"),
            "decision,candidate,x_m,y_m,chosen\n"
            "1,5,1,2,0\n"
            "1,7,3,4,1\n"
            "2,9,5,6,0\n"
            "3,2,7,8,1\n"
            "3,3,9,0,0\n");
}

TEST(PoseColumns, LookStraightUpOrDownWhateverIsLostToRounding) {
  for (const double down : {-1.0, 1.0}) {
    Pose T_world_sensor = make_pose({0.0, 0.0, 0.0}, 0.0, 0.5 * std::numbers::pi * down);
    T_world_sensor.matrix()(2, 0) = -down * (1.0 + 1e-9);
    EXPECT_NEAR(numbers_in(pose_columns(T_world_sensor))[4], 0.5 * std::numbers::pi * down, 1e-12);
  }
  EXPECT_EQ(CandidateRow{}.id, 0);
}

}  // namespace
}  // namespace vantage
