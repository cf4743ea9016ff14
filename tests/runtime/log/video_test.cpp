#include "vantage/runtime/log/video.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <cstdlib>
#include <string_view>

#include "tests/sim/test_world.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/runtime/log/video_recorder.hpp"

namespace vantage {
namespace {

using support::TemporaryDirectory;

/// A white bar that moves right, 4 px a frame.
cv::Mat frame(cv::Size size, int index) {
  cv::Mat image(size, CV_8UC3, cv::Scalar(60, 40, 20));
  image.colRange(4 * index, 4 * index + 16).setTo(cv::Scalar::all(255));
  return image;
}

const std::string kBall =
    test::scene_mjcf("<body pos='0 0 1'><freejoint/><geom size='.1'/></body>");

class Video : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string missing = missing_video_codec(); !missing.empty()) {
      GTEST_SKIP() << missing;
    }
  }
  TemporaryDirectory folder;
};

TEST_F(Video, PlaysBackWhatWasWritten) {
  const auto path = folder / "video.mp4";
  VideoWriter writer(path, {320, 180}, 25.0);
  for (int i = 0; i < 20; ++i) writer.write(frame({320, 180}, i));
  EXPECT_FALSE(std::filesystem::exists(path));
  writer.finish();
  EXPECT_FALSE(std::filesystem::exists(folder / "video.part.mp4"));
  cv::VideoCapture reader(path.string(), cv::CAP_FFMPEG);
  EXPECT_EQ(reader.get(cv::CAP_PROP_FRAME_COUNT), 20.0);
  EXPECT_NEAR(reader.get(cv::CAP_PROP_FPS), 25.0, 0.01);
  cv::Mat read;
  for (int i = 0; i <= 10; ++i) ASSERT_TRUE(reader.read(read));
  EXPECT_GT(read.at<cv::Vec3b>(90, 48)[1], 220);
  EXPECT_LT(read.at<cv::Vec3b>(90, 100)[1], 80);
}

TEST_F(Video, IsH264InMp4) {
  VideoWriter writer(folder / "video.mp4", {64, 64}, 25.0);
  writer.write(frame({64, 64}, 0));
  writer.finish();
  const std::string bytes = read_file(folder / "video.mp4");
  EXPECT_EQ(bytes.substr(4, 4), "ftyp");
  EXPECT_NE(bytes.find("avc1"), std::string::npos);
}

TEST_F(Video, OddEdgesBecomeEven) {
  VideoWriter writer(folder / "video.mp4", {101, 77}, 25.0);
  for (int i = 0; i < 3; ++i) writer.write(frame({101, 77}, i));
  writer.finish();
  cv::VideoCapture reader((folder / "video.mp4").string(), cv::CAP_FFMPEG);
  EXPECT_EQ(reader.get(cv::CAP_PROP_FRAME_WIDTH), 102.0);
  EXPECT_EQ(reader.get(cv::CAP_PROP_FRAME_HEIGHT), 78.0);
}

TEST_F(Video, LeavesNothingIfItIsNotFinished) {
  {
    VideoWriter writer(folder / "video.mp4", {64, 64}, 25.0);
    writer.write(frame({64, 64}, 0));
    EXPECT_TRUE(std::filesystem::exists(folder / "video.part.mp4"));
  }
  EXPECT_TRUE(folder.is_empty());
}

TEST_F(Video, WithoutFramesIsAnErrorAndLeavesNothing) {
  VideoWriter writer(folder / "video.mp4", {64, 64}, 25.0);
  EXPECT_THROW(writer.finish(), OutputError);
  EXPECT_TRUE(folder.is_empty());
}

TEST_F(Video, KeepsAnEarlierFileUntilTheNewOneIsWhole) {
  write_file(folder / "video.mp4", "earlier");
  VideoWriter writer(folder / "video.mp4", {64, 64}, 25.0);
  writer.write(frame({64, 64}, 0));
  EXPECT_EQ(read_file(folder / "video.mp4"), "earlier");
  writer.finish();
  EXPECT_GT(std::filesystem::file_size(folder / "video.mp4"), 100U);
}

TEST_F(Video, UnusableFolderIsAnOutputError) {
  EXPECT_THROW(VideoWriter(folder / "missing" / "video.mp4", {64, 64}, 25.0), OutputError);
}

TEST_F(Video, OfAWorldTakesItsTimeWhateverTheRate) {
  const test::SceneFolder scene(kBall);
  World world(scene.alone());
  for (const int rate : {10, 60}) {  // a tick is 25 ms
    VideoRecorder recorder(world, {.video_speed = 1.0, .video_fps = rate, .height_px = 120},
                           folder.path());
    recorder.set_panel([](cv::Size size) { return cv::Mat(size, CV_8UC3, cv::Scalar::all(9)); });
    for (int tick = 0; tick < 40; ++tick) {
      world.advance_tick();
      recorder.tick(world);
    }
    recorder.finish();
    cv::VideoCapture reader((folder / "video.mp4").string(), cv::CAP_FFMPEG);
    EXPECT_NEAR(reader.get(cv::CAP_PROP_FRAME_COUNT), rate, 1.0);
  }
}

TEST_F(Video, OfNoTimeIsNoneWithoutAnError) {
  {
    const test::SceneFolder scene(kBall);
    const World world(scene.alone());
    VideoRecorder recorder(world, {.height_px = 120}, folder.path());
    EXPECT_NO_THROW(recorder.finish());
  }
  EXPECT_TRUE(folder.is_empty());
}

/// Both libraries are told once, so a process of its own has to be the first to do it.
TEST(VideoChatter, IsSwitchedOffUnlessAUserWantsIt) {
  const auto told = [](const char* name, std::string_view value) {
    const char* found = std::getenv(name);
    return found != nullptr && found == value;
  };
  const auto settings = [&] {
    ::setenv("OPENCV_FFMPEG_LOGLEVEL", "16", 1);
    ::unsetenv("OPENCV_LOG_LEVEL");
    ::unsetenv("AV_LOG_FORCE_NOCOLOR");
    static_cast<void>(missing_video_codec());
    const bool as_wanted = told("OPENCV_FFMPEG_LOGLEVEL", "16") &&
                           told("OPENCV_LOG_LEVEL", "SILENT") && told("AV_LOG_FORCE_NOCOLOR", "1");
    std::_Exit(as_wanted ? 0 : 1);
  };
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(settings(), testing::ExitedWithCode(0), "");
  GTEST_FLAG_SET(death_test_style, "fast");
}

TEST_F(Video, NothingReachesStderr) {
  testing::internal::CaptureStderr();
  {
    VideoWriter writer(folder / "video.mp4", {64, 64}, 25.0);
    writer.write(frame({64, 64}, 0));
    writer.finish();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(SideBySide, IsTheRoomAtTheSizeOfItsPanel) {
  const cv::Mat left_rgb(4, 6, CV_8UC3, cv::Scalar(200, 100, 50));
  const cv::Mat right_bgr(2, 3, CV_8UC3, cv::Scalar(1, 2, 3));
  const cv::Mat both = side_by_side(left_rgb, right_bgr);
  ASSERT_EQ(both.size(), cv::Size(6, 2));
  for (int x = 0; x < 6; ++x) {
    const cv::Vec3b expected = x < 3 ? cv::Vec3b(50, 100, 200) : cv::Vec3b(1, 2, 3);
    for (int y = 0; y < 2; ++y) EXPECT_EQ(both.at<cv::Vec3b>(y, x), expected) << x << ", " << y;
  }
}

TEST(SideBySide, MixesThePixelsOfALargerRoom) {
  cv::Mat left_rgb(2, 4, CV_8UC3, cv::Scalar());
  for (const int x : {1, 3}) left_rgb.col(x).setTo(cv::Scalar(200, 100, 40));
  const cv::Mat right_bgr(1, 2, CV_8UC3, cv::Scalar(1, 2, 3));
  const cv::Mat both = side_by_side(left_rgb, right_bgr);
  ASSERT_EQ(both.size(), cv::Size(4, 1));
  for (const int x : {0, 1}) EXPECT_EQ(both.at<cv::Vec3b>(0, x), cv::Vec3b(20, 50, 100)) << x;
}

TEST_F(Video, AStillIsTheRoomBesideItsPanel) {
  const test::SceneFolder scene(kBall);
  const World world(scene.alone());
  VideoRecorder recorder(world, {.height_px = 123}, folder.path());
  cv::Size asked;
  recorder.set_panel([&](cv::Size size) {
    asked = size;
    return cv::Mat(size, CV_8UC3, cv::Scalar(1, 2, 3));
  });
  recorder.save_still(world, 3);
  EXPECT_EQ(asked, cv::Size(108, 122)) << "half of 16:9, with even edges";
  const cv::Mat still = cv::imread((folder / "frames/scan_03.png").string(), cv::IMREAD_COLOR);
  ASSERT_EQ(still.size(), cv::Size(216, 122));
  const cv::Mat panel(122, 108, CV_8UC3, cv::Scalar(1, 2, 3));
  EXPECT_EQ(cv::norm(still.colRange(108, 216), panel, cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(still.colRange(0, 108), panel, cv::NORM_INF), 20.0) << "the room";
}

}  // namespace
}  // namespace vantage
