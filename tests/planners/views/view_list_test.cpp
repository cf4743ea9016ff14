#include "vantage/planners/views/view_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

using ::testing::HasSubstr;

class ViewList : public ::testing::Test {
 protected:
  std::vector<Candidate> read(const std::string& text) {
    std::ofstream(directory_ / "views.csv", std::ios::binary) << text;
    return read_views(directory_ / "views.csv");
  }
  std::string error_of(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  support::TemporaryDirectory directory_;
};

TEST_F(ViewList, ReadsPoses) {
  const auto views = read("x_m,y_m,z_m,yaw_rad\n1,2,3,0\n-1.5,0,2e-1,1.5707963267948966\n");
  ASSERT_EQ(views.size(), 2U);
  EXPECT_TRUE(views[0].T_world_sensor.translation().isApprox(Eigen::Vector3d(1, 2, 3)));
  EXPECT_TRUE(views[1].T_world_sensor.linear().col(0).isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_EQ(views[1].id, 1);
}

TEST_F(ViewList, ColumnsInAnyOrderAsSpreadsheetsWriteThem) {
  const auto views = read(
      "\xEF\xBB\xBFid, yaw_rad,pitch_rad,z_m,y_m,x_m\r\n\r\n"
      "42, 0, 0.5 ,3,2,+1\r\n7,0,0,0,0,0");
  ASSERT_EQ(views.size(), 2U);
  EXPECT_EQ(views[0].id, 42);
  EXPECT_TRUE(views[0].T_world_sensor.translation().isApprox(Eigen::Vector3d(1, 2, 3)));
  EXPECT_NEAR(views[0].T_world_sensor.linear()(2, 0), -std::sin(0.5), 1e-12);  // looks down
}

TEST_F(ViewList, ReadsBackWhatItWrites) {
  Rng rng(2);
  std::vector<Candidate> views(50);
  for (std::size_t i = 0; i < views.size(); ++i) {
    views[i].id = static_cast<int>(100 - i);
    const double half = std::numbers::pi / 2.0;
    views[i].T_world_sensor =
        make_pose({rng.normal(), rng.normal(), 1e3 * rng.normal()}, rng.uniform(-3.0, 3.0),
                  i == 0 ? half : rng.uniform(-half, half));
  }
  const auto back = read(views_csv(views));
  ASSERT_EQ(back.size(), views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(back[i].id, views[i].id);
    EXPECT_TRUE(back[i].T_world_sensor.isApprox(views[i].T_world_sensor, 1e-7)) << i;
  }
}

TEST_F(ViewList, NamesFileLineAndColumn) {
  const std::string header = "x_m,y_m,z_m,yaw_rad\n";
  EXPECT_THAT(error_of(header + "1,2,3,0\n1,2,abc,0\n"),
              HasSubstr("views.csv:3: column z_m: expected a finite number, got 'abc'"));
  for (const char* number : {"nan", "inf", "-inf", "1e999", "", "1.0.0", "0x10", "1 2", "+-1"}) {
    EXPECT_THAT(error_of(header + "1,2,3," + number + "\n"), HasSubstr("views.csv:2: column yaw_"));
  }
  EXPECT_THAT(error_of(header + "1,2,3\n"), HasSubstr("views.csv:2: 3 fields, the header has 4"));
  EXPECT_THAT(error_of(header + "1,2,3,4,5\n"), HasSubstr("5 fields"));
  EXPECT_THAT(error_of(header + "2e6,0,0,0\n"), HasSubstr("column x_m: 2000000 is not in"));
  EXPECT_THAT(error_of("x_m,y_m,z_m,yaw_rad,pitch_rad\n0,0,0,0,2\n"), HasSubstr("pitch_rad: 2"));
  EXPECT_THAT(error_of("x_m,y_m,z_m,yaw_rad,id\n0,0,0,0,-1\n"),
              HasSubstr("column id: expected a whole number >= 0, got '-1'"));
  EXPECT_THAT(error_of("x_m,y_m,z_m,yaw_rad,id\n0,0,0,0,3\n\n1,0,0,0,3\n"),
              HasSubstr("views.csv:4: column id: 3 is there twice"));
}

/// A thousand kilometres, and a right angle written with ten digits.
TEST_F(ViewList, TakesNumbersUpToTheirLimits) {
  const std::string header = "x_m,y_m,z_m,yaw_rad,pitch_rad\n";
  EXPECT_EQ(read(header + "1e6,-1e6,1e6,-1e6,1.5707963276\n").size(), 1U);
  EXPECT_THAT(error_of(header + "1000001,0,0,0,0\n"),
              HasSubstr("column x_m: 1000001 is not in [-1e+06, 1e+06]"));
  EXPECT_THAT(error_of(header + "0,0,0,0,-1.5707963283\n"),
              HasSubstr("column pitch_rad: -1.5707963283 is not in [-1.5708, 1.5708]"));
}

TEST_F(ViewList, NamesWhatIsWrongWithTheHeader) {
  EXPECT_THAT(error_of(""), HasSubstr("views.csv: is empty"));
  EXPECT_THAT(error_of("\n\n"), HasSubstr("views.csv: is empty"));
  EXPECT_THAT(error_of("x_m,y_m,z_m,yaw_rad\n"), HasSubstr("no view below the header"));
  EXPECT_THAT(error_of("x_m,y_m,yaw_rad\n1,2,3\n"),
              HasSubstr("views.csv:1: column z_m is missing"));
  EXPECT_THAT(error_of("x_m,y_m,z_m\n1,2,3\n"),
              HasSubstr("views.csv:1: column yaw_rad is missing"));
  EXPECT_THAT(error_of("x_m,x_m,z_m,yaw_rad\n"), HasSubstr("column x_m is there twice"));
  EXPECT_THAT(error_of("1,2,3,4\n"), HasSubstr("unknown column '1'"));
  EXPECT_THAT(error_of(std::string("\0\xff\x01", 3)), HasSubstr("views.csv:1: unknown column"));
  std::string many = "x_m,y_m,z_m,yaw_rad\n";
  for (int i = 0; i < 20'001; ++i) many += "0,0,0,0\n";
  EXPECT_THAT(error_of(many), HasSubstr("more than 20000 views"));
  EXPECT_THROW(read_views(directory_ / "none.csv"), InputError);
  EXPECT_THROW(read_views(directory_.path()), InputError);
}

TEST_F(ViewList, ShowsFortyLettersOfWhatItCannotRead) {
  const std::string shown = 'y' + std::string(39, 'x');
  EXPECT_THAT(error_of("x_m,y_m,z_m,yaw_rad\n1,2," + shown + "xx,0\n"),
              HasSubstr("got '" + shown + "'"));
  EXPECT_THAT(error_of("x_m," + shown + "xx,z_m,yaw_rad\n"),
              HasSubstr("unknown column '" + shown + "';"));
}

}  // namespace
}  // namespace vantage
