// Where captions cover an image.
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <utility>
#include <vector>

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

/// A quarter of what was there, 200, and three quarters of the panel's darkest colour.
TEST(ViewCaptionsOnAnImage, TextStandsOnADarkenedGround) {
  const Pixel ground(68, 62, 58);
  ViewCaptions captions;
  captions.progress = 0.0;
  EXPECT_EQ(captioned(captions).at<Pixel>(704, 999), ground);
  captions.progress.reset();
  captions.scene = "HHH";
  const cv::Mat image = captioned(captions);
  const int width = changed_columns(image, 0).second;
  EXPECT_EQ(image.at<Pixel>(0, 0), ground);
  std::vector<int> rows;
  std::vector<int> columns;
  for (int y = 0; y < 34; ++y) {
    for (int x = 0; x < width; ++x) {
      if (image.at<Pixel>(y, x) == ground) continue;
      rows.push_back(y);
      columns.push_back(x);
    }
  }
  ASSERT_FALSE(rows.empty());
  EXPECT_NEAR(rows.front(), 9, 3);
  EXPECT_NEAR(rows.back(), 23, 2) << "its foot";
  const auto [left, right] = std::minmax_element(columns.begin(), columns.end());
  EXPECT_NEAR(*left, 14, 3);
  EXPECT_NEAR(*right, width - 15, 4);
}

/// What two legends tell is the same to the last digit that they show.
TEST(ViewCaptionsOnAnImage, GainsHaveAsManyDigitsAsTellThemApart) {
  const auto legend_of = [](double low, double high) {
    ViewCaptions captions;
    captions.decision.emplace();
    captions.decision->candidates.resize(2);
    for (Candidate& view : captions.decision->candidates) view.reachable = true;
    captions.decision->candidates[0].gain_bits = low;
    captions.decision->candidates[1].gain_bits = high;
    return captioned(captions);
  };
  const auto same_legend = [&](double low, double high, double other_low, double other_high) {
    const cv::Mat one = legend_of(low, high);
    return cv::norm(one, legend_of(other_low, other_high), cv::NORM_INF) == 0.0;
  };
  EXPECT_TRUE(same_legend(1.0, 2.0, 1.0, 2.0004));
  EXPECT_FALSE(same_legend(1.0, 2.0, 1.0, 2.0006));
  EXPECT_FALSE(same_legend(1.0, 2.0, 1.0006, 2.0));
  EXPECT_TRUE(same_legend(1.0, 10.0, 1.0, 10.04));
  EXPECT_TRUE(same_legend(1.0, 20.0, 1.0, 20.04));
  EXPECT_FALSE(same_legend(1.0, 20.0, 1.0, 20.06));
  EXPECT_TRUE(same_legend(1.0, 100.0, 1.0, 100.4));
  EXPECT_FALSE(same_legend(1.0, 100.0, 1.0, 100.6));
}

TEST(ViewCaptionsOnAnImage, TheHelpHasALineForEachKey) {
  ViewCaptions captions;
  captions.help = true;
  const cv::Mat image = captioned(captions);
  const auto is_written = [&](const cv::Rect& part) {
    cv::Mat ground;
    cv::inRange(image(part), cv::Scalar(68, 62, 58), cv::Scalar(68, 62, 58), ground);
    return cv::countNonZero(ground) < part.area();
  };
  for (int y = 83; y < 83 + 14 * 25; y += 25) {
    EXPECT_TRUE(is_written({36, y - 13, 200, 17})) << y;
    EXPECT_TRUE(is_written({276, y - 13, 400, 17})) << y;
    EXPECT_FALSE(is_written({21, y - 13, 14, 17})) << y;
    EXPECT_FALSE(is_written({21, y + 7, 740, 3})) << y;
  }
}

const Pixel kDarkened(68, 62, 58);  // of grey

/// Of a decision between two views.
ViewCaptions legend_of_two() {
  ViewCaptions captions;
  captions.decision.emplace();
  captions.decision->candidates.resize(2);
  for (Candidate& view : captions.decision->candidates) view.reachable = true;
  captions.decision->candidates[0].gain_bits = 10.0;
  captions.decision->candidates[1].gain_bits = 20.0;
  captions.gain_unit = "cells";
  return captions;
}

TEST(ViewCaptionsOnAnImage, TheLegendIsThereForASingleViewToo) {
  ViewCaptions captions = legend_of_two();
  captions.decision->candidates.pop_back();
  EXPECT_EQ(changed_rows(captioned(captions), 999), std::pair(720 - 58, 720));
}

TEST(ViewCaptionsOnAnImage, TheLegendsBarIsTwelvePixelsHighAndColouredByShare) {
  const cv::Mat image = captioned(legend_of_two());
  const int quarter = 684 + 75;  // of 302 columns
  EXPECT_EQ(image.at<Pixel>(673, quarter), kDarkened);
  EXPECT_NE(image.at<Pixel>(674, quarter), kDarkened);
  EXPECT_NE(image.at<Pixel>(686, quarter), kDarkened);
  EXPECT_EQ(image.at<Pixel>(687, quarter), kDarkened);
  // From the second of its six colours, (202, 165, 42), a quarter on to (150, 200, 70).
  const Pixel colour = image.at<Pixel>(680, quarter);
  EXPECT_NEAR(colour[0], 189, 3);
  EXPECT_NEAR(colour[1], 174, 3);
  EXPECT_NEAR(colour[2], 49, 3);
}

/// What is written between two columns, below the bar.
cv::Rect written_below_bar(const cv::Mat& image, int from, int to) {
  const cv::Rect area(from, 688, to - from, 720 - 688);
  cv::Mat ground;
  cv::inRange(image(area), cv::Scalar(68, 62, 58), cv::Scalar(68, 62, 58), ground);
  const cv::Rect found = cv::boundingRect(255 - ground);
  return {found.x + area.x, found.y + area.y, found.width, found.height};
}

/// The least at its left end, the most at its right one and what they are of in its middle; the
/// feet of the letters 20 px below it, capitals 13 px high.
TEST(ViewCaptionsOnAnImage, TheLegendsWordsStandBelowItsBar) {
  const cv::Mat image = captioned(legend_of_two());
  const cv::Rect least = written_below_bar(image, 671, 745);
  const cv::Rect unit = written_below_bar(image, 755, 915);
  const cv::Rect most = written_below_bar(image, 925, 999);
  EXPECT_NEAR(least.x, 686, 3);
  EXPECT_NEAR(unit.x + 0.5 * unit.width, 835.0, 3.0);
  EXPECT_NEAR(most.x + most.width, 985, 3);
  for (const cv::Rect& words : {least, most}) {
    EXPECT_NEAR(words.y, 693, 2);
    EXPECT_NEAR(words.y + words.height, 707, 2);
  }
  EXPECT_NEAR(unit.y, 693, 2);
}

TEST(ViewCaptionsOnAnImage, HeadlinesAreAsWideAsTheirWords) {
  ViewCaptions captions;
  captions.scene = "HHH";
  const int words = cv::getTextSize("HHH", cv::FONT_HERSHEY_SIMPLEX, 30.0 / 22.0, 2, nullptr).width;
  const cv::Mat image = captioned(captions, {2000, 1440});
  EXPECT_EQ(changed_columns(image, 0).second, words + 2 * 24);
}

/// Keys from column 36 on and what they do from 276 on, in letters of 14 px.
TEST(ViewCaptionsOnAnImage, TheHelpHasTwoColumns) {
  ViewCaptions captions;
  captions.help = true;
  const cv::Mat image = captioned(captions);
  const auto is_written = [&](const cv::Rect& part) {
    cv::Mat ground;
    cv::inRange(image(part), cv::Scalar(68, 62, 58), cv::Scalar(68, 62, 58), ground);
    return cv::countNonZero(ground) < part.area();
  };
  for (const int column : {36, 276}) {
    EXPECT_TRUE(is_written({column, 70, 10, 350})) << column;
    EXPECT_TRUE(is_written({column, 94, 150, 5})) << column << ": letters of full height";
    EXPECT_FALSE(is_written({column, 57, 150, 9})) << column;
  }
}

}  // namespace
}  // namespace vantage
