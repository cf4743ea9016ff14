#include "vantage/dataset/contact_sheet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/error.hpp"
#include "vantage/dataset/view_files.hpp"
#include "vantage/models/catalogue/shapes/texture.hpp"

namespace vantage {
namespace {

/// A view of 10 x 20 px in one colour.
ObjectView plain(std::uint8_t grey) {
  ObjectView view;
  view.width_px = 10;
  view.height_px = 20;
  view.rgb.assign(600, grey);
  view.depth_m.assign(200, 1.0F);
  view.mask.assign(200, 1);
  return view;
}

TEST(ContactSheet, ShowsTheViewNearestToTheYawOfTheVideo) {
  const support::TemporaryDirectory folder;
  DatasetIndex index;
  const auto put = [&](const char* object, int video, int frame, double yaw_rad, int grey) {
    const ViewEntry entry{{"cup", object, video, frame}, folder.path(), yaw_rad};
    write_view(plain(static_cast<std::uint8_t>(grey)), entry);
    index.views.push_back(entry);
  };
  put("cup_1", 1, 1, 1.0, 10);
  put("cup_1", 2, 1, 3.0, 20);
  put("cup_1", 2, 2, 6.2, 30);
  put("cup_2", 1, 1, 1.0, 40);
  put("cup_3", 2, 1, 0.0, 50);
  write_contact_sheet(index, {.cell_px = 40, .columns = 2, .video = 2, .yaw_rad = 0.1},
                      folder / "sheet.png");
  const Image sheet = read_png(folder / "sheet.png");
  EXPECT_EQ(sheet.width_px, 80);
  EXPECT_EQ(sheet.height_px, 2 * 52);
  EXPECT_NEAR(sheet.at(5, 20).x() * 255.0, 30.0, 1.0);
  EXPECT_NEAR(sheet.at(45, 20).x() * 255.0, 40.0, 1.0);
  EXPECT_NEAR(sheet.at(5, 72).x() * 255.0, 50.0, 1.0);
  EXPECT_EQ(sheet.at(30, 20), RgbColour::Ones());  // beside a narrow image
}

TEST(ContactSheet, HasTwentyCellsInARowUnlessToldOtherwise) {
  const support::TemporaryDirectory folder;
  DatasetIndex index;
  for (int i = 1; i <= 21; ++i) {
    const ViewEntry entry{{"cup", "cup_" + std::to_string(i), 2, 1}, folder.path(), 0.0};
    write_view(plain(90), entry);
    index.views.push_back(entry);
  }
  ContactSheetOptions options;
  options.cell_px = 10;
  write_contact_sheet(index, options, folder / "sheet.png");
  const Image sheet = read_png(folder / "sheet.png");
  EXPECT_EQ(sheet.width_px, 20 * 10);
  EXPECT_EQ(sheet.height_px, 2 * (10 + 12));
}

TEST(ContactSheet, NamesEachObjectBelowItsPicture) {
  const support::TemporaryDirectory folder;
  ObjectView wide = plain(90);
  std::swap(wide.width_px, wide.height_px);
  const ViewEntry entry{{"cup", "cup_1", 2, 1}, folder.path(), 0.0};
  write_view(wide, entry);
  DatasetIndex index;
  index.views.push_back(entry);
  ContactSheetOptions options;
  options.cell_px = 40;
  write_contact_sheet(index, options, folder / "sheet.png");
  const Image sheet = read_png(folder / "sheet.png");
  EXPECT_EQ(sheet.width_px, 40) << "of one object there is one column";
  EXPECT_EQ(sheet.height_px, 52);
  EXPECT_NEAR(sheet.at(39, 19).x() * 255.0, 90.0, 1.0) << "as wide as the cell";
  EXPECT_EQ(sheet.at(20, 25), RgbColour::Ones()) << "below a low image";
  double darkest = 1.0;
  for (int y = 40; y < 52; ++y) {
    for (int x = 0; x < 40; ++x) darkest = std::min(darkest, double{sheet.at(x, y).x()});
  }
  EXPECT_LT(darkest, 0.8) << "its name";
  EXPECT_THROW(write_contact_sheet(index, options, folder / "sheet.jpg"), ConfigError);
}

TEST(ContactSheet, ShowsTheSecondVideoFromTheRightInFrontUnlessToldOtherwise) {
  const support::TemporaryDirectory folder;
  DatasetIndex index;
  for (const auto& [video, frame, yaw_rad, grey] : {std::tuple(1, 1, 5.2, 10),
                                                    {2, 1, 4.1, 20},
                                                    {2, 2, 5.3, 30},
                                                    {2, 3, 0.1, 40},
                                                    {2, 4, 5.3, 60}}) {  // of two alike the first
    const ViewEntry entry{{"cup", "cup_1", video, frame}, folder.path(), yaw_rad};
    write_view(plain(static_cast<std::uint8_t>(grey)), entry);
    index.views.push_back(entry);
  }
  write_contact_sheet(index, {}, folder / "sheet.png");
  const Image sheet = read_png(folder / "sheet.png");
  EXPECT_EQ(sheet.width_px, 96);
  EXPECT_EQ(sheet.height_px, 96 + 12);
  EXPECT_NEAR(sheet.at(20, 40).x() * 255.0, 30.0, 1.0);
}

}  // namespace
}  // namespace vantage
