// Where captions cover an image.
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <utility>

#include "vantage/view/overlays.hpp"

namespace vantage {
namespace {

using Pixel = cv::Vec3b;
const Pixel kGrey(200, 200, 200);

/// An image in one colour, with captions on it.
cv::Mat captioned(const ViewCaptions& captions, cv::Size size = {1000, 720}) {
  cv::Mat image(size, CV_8UC3, cv::Scalar::all(200));
  lay_captions(image, captions);
  return image;
}

/// The rows that differ from the plain image in a column: the first and one after the last; the
/// same twice: none do.
std::pair<int, int> changed_rows(const cv::Mat& image, int column) {
  std::pair<int, int> rows(0, 0);
  for (int y = 0; y < image.rows; ++y) {
    if (image.at<Pixel>(y, column) == kGrey) continue;
    if (rows.second == 0) rows.first = y;
    rows.second = y + 1;
  }
  return rows;
}

/// The columns of a row that differ likewise.
std::pair<int, int> changed_columns(const cv::Mat& image, int row) {
  std::pair<int, int> columns(0, 0);
  for (int x = 0; x < image.cols; ++x) {
    if (image.at<Pixel>(row, x) == kGrey) continue;
    if (columns.second == 0) columns.first = x;
    columns.second = x + 1;
  }
  return columns;
}

TEST(TimelineHeight, GrowsWithTheImage) {
  EXPECT_EQ(timeline_height_px(90), 8.0);
  EXPECT_EQ(timeline_height_px(360), 8.0);
  EXPECT_EQ(timeline_height_px(720), 16.0);
}

TEST(ViewCaptionsOnAnImage, WithoutAnyItStaysAsItIs) {
  const cv::Mat image = captioned({});
  for (const int x : {0, 500, 999}) EXPECT_EQ(changed_rows(image, x), std::pair(0, 0)) << x;
}

TEST(ViewCaptionsOnAnImage, TheTimelineIsFilledAsFarAsItIs) {
  ViewCaptions captions;
  captions.progress = 0.5;
  const cv::Mat image = captioned(captions);
  EXPECT_EQ(changed_rows(image, 999), std::pair(704, 720));
  const auto at = [&](int row, int column) { return image.at<Pixel>(row, column); };
  const Pixel ground = at(704, 999);
  const Pixel filled = at(712, 0);
  EXPECT_NE(filled, ground);
  EXPECT_EQ(at(707, 0), ground);
  EXPECT_EQ(at(708, 0), filled);
  EXPECT_EQ(at(715, 499), filled);
  EXPECT_EQ(at(716, 0), ground);
  EXPECT_EQ(at(712, 500), ground);
  captions.progress = 2.0;
  EXPECT_EQ(captioned(captions).at<Pixel>(712, 999), filled);
  captions.progress = -1.0;
  EXPECT_EQ(captioned(captions).at<Pixel>(712, 0), ground);
}

TEST(ViewCaptionsOnAnImage, HeadlinesStandInTheUpperCorners) {
  ViewCaptions captions;
  captions.scene = "scene";
  const cv::Mat left = captioned(captions);
  EXPECT_EQ(changed_rows(left, 0), std::pair(0, 34));
  EXPECT_EQ(changed_rows(left, 999), std::pair(0, 0));
  EXPECT_EQ(changed_columns(left, 0).first, 0);
  captions.scene.clear();
  captions.plan = "scene";
  EXPECT_EQ(changed_rows(captioned(captions), 0), std::pair(34, 68));
  captions.plan.clear();
  captions.playback = "scene";
  const cv::Mat right = captioned(captions);
  EXPECT_EQ(changed_rows(right, 999), std::pair(0, 34));
  const auto [first, last] = changed_columns(right, 0);
  EXPECT_EQ(last, 1000);
  EXPECT_EQ(last - first, changed_columns(left, 0).second) << "as wide on either side";
}

TEST(ViewCaptionsOnAnImage, TheLegendStandsAboveTheTimeline) {
  ViewCaptions captions;
  captions.decision.emplace();
  captions.decision->candidates.resize(3);
  for (std::size_t i = 0; i < 3; ++i) {
    captions.decision->candidates[i].reachable = true;
    captions.decision->candidates[i].gain_bits = 10.0 * static_cast<double>(i + 1);
  }
  captions.gain_unit = "cells";
  const cv::Mat alone = captioned(captions);
  EXPECT_EQ(changed_rows(alone, 999), std::pair(720 - 58, 720));
  EXPECT_EQ(changed_columns(alone, 719), std::pair(1000 - 330, 1000));
  // The bar: 12 px below the card's upper end, 14 px off its sides, from the least to the most.
  const Pixel& ground = alone.at<Pixel>(664, 672);
  EXPECT_EQ(alone.at<Pixel>(680, 683), ground);
  EXPECT_NE(alone.at<Pixel>(680, 684), ground);
  EXPECT_NE(alone.at<Pixel>(680, 985), ground);
  EXPECT_EQ(alone.at<Pixel>(680, 986), ground);
  EXPECT_NE(alone.at<Pixel>(680, 684), alone.at<Pixel>(680, 985));
  captions.progress = 0.0;
  EXPECT_EQ(changed_rows(captioned(captions), 672), std::pair(704 - 58, 720));
  captions.decision->candidates.clear();
  captions.progress.reset();
  EXPECT_EQ(changed_rows(captioned(captions), 999), std::pair(0, 0)) << "of no gains there is none";
}

TEST(ViewCaptionsOnAnImage, TheHelpIsACardOfAllKeys) {
  ViewCaptions captions;
  captions.help = true;
  const cv::Mat image = captioned(captions);
  EXPECT_EQ(changed_rows(image, 21), std::pair(54, 54 + 14 * 25 + 24));
  EXPECT_EQ(changed_columns(image, 56), std::pair(20, 770));
}

}  // namespace
}  // namespace vantage
