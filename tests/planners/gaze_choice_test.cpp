#include "vantage/planners/gaze_choice.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

using Images = std::vector<std::size_t>;

double rate_of(const StopOffer& offer, const Images& taken) {
  double sum = 0.0;
  for (const std::size_t image : taken) sum += offer.gains[image];
  return sum / (offer.way_s + offer.image_s * static_cast<double>(taken.size()));
}

/// Of every choice of at least one image.
double best_rate(const StopOffer& offer) {
  double best = 0.0;
  for (std::size_t bits = 1; bits < std::size_t{1} << offer.gains.size(); ++bits) {
    Images taken;
    for (std::size_t i = 0; i < offer.gains.size(); ++i) {
      if ((bits >> i & 1U) != 0) taken.push_back(i);
    }
    best = std::max(best, rate_of(offer, taken));
  }
  return best;
}

RC_GTEST_PROP(WorthwhileImages, MakeMostOfTheStopsTime, (std::uint64_t seed)) {
  Rng rng(seed);
  StopOffer offer{.gains = std::vector<double>(10),
                  .image_s = rng.uniform(0.1, 3.0),
                  .way_s = rng.uniform(0.0, 40.0)};
  for (double& gain : offer.gains) gain = rng.uniform(0.0, 1.0) * rng.uniform(0.0, 100.0);
  const Images taken = worthwhile_images(offer, {.worth = 1.0});
  RC_ASSERT(rate_of(offer, taken) >= best_rate(offer) * (1.0 - 1e-12));
  RC_ASSERT(std::ranges::is_sorted(taken));
}

/// After a way of 8 s: 60 in 10 s and then, image by image of 2 s, 20, 10, 5 and nothing.
StopOffer five_images() { return {{5.0, 60.0, 0.0, 20.0, 10.0}, 2.0, 8.0, 1000.0}; }

TEST(WorthwhileImages, AreFewerTheMoreIsAskedOfThem) {
  const auto taken = [&](double worth) { return worthwhile_images(five_images(), {worth}); };
  EXPECT_EQ(taken(1.0), (Images{1, 3})) << "10 in 2 s are less than 80 in 12 s";
  EXPECT_EQ(taken(0.75), (Images{1, 3, 4})) << "5 in 2 s are less than 0.75 of 90 in 14 s";
  EXPECT_EQ(taken(0.35), (Images{0, 1, 3, 4}));
  EXPECT_EQ(taken(0.01), (Images{0, 1, 3, 4}));
  EXPECT_EQ(taken(0.0), (Images{0, 1, 2, 3, 4}));
  EXPECT_EQ(taken(10.0), (Images{1}));
}

TEST(WorthwhileImages, AfterALongWayMoreOfThemAre) {
  const auto taken = [](double way_s) {
    return worthwhile_images({{10.0, 3.0, 1.0}, 1.0, way_s, 0.0}, {.worth = 1.0});
  };
  EXPECT_EQ(taken(0.0), (Images{0}));
  EXPECT_EQ(taken(3.0), (Images{0, 1}));
  EXPECT_EQ(taken(11.0), (Images{0, 1, 2}));
  EXPECT_EQ(worthwhile_images({{2.0, 2.0}, 1.0, 0.0, 0.0}, {.worth = 1.0}), (Images{0, 1}))
      << "as good as the first";
}

/// Of 1000 known cells.
TEST(WorthwhileImages, ShowAShareOfWhatIsKnown) {
  const auto taken = [&](const GazeOptions& gaze) {
    return worthwhile_images(five_images(), gaze);
  };
  EXPECT_EQ(taken({.share = 0.01}), (Images{1, 3, 4}));
  EXPECT_EQ(taken({.share = 0.0101}), (Images{1, 3}));
  EXPECT_EQ(taken({.share = 0.000001}), (Images{0, 1, 3, 4}));
  EXPECT_EQ(taken({.share = 0.1}), (Images{1})) << "the best one all the same";
  EXPECT_EQ(taken({.worth = 0.35, .share = 0.01}), (Images{1, 3, 4}));
  EXPECT_EQ(taken({.worth = 1.0, .share = 0.001}), (Images{1, 3}));
}

TEST(WorthwhileImages, AreAllWhereNoneShowsAnythingButForTheShare) {
  const StopOffer nothing{{0.0, 0.0}, 1.0, 5.0, 10.0};
  EXPECT_EQ(worthwhile_images(nothing, {.worth = 0.5}).size(), 2U) << "none is worse";
  EXPECT_EQ(worthwhile_images(nothing, {.worth = 0.5, .share = 0.01}), (Images{0}));
}

TEST(GazeOptions, TakeAllImagesUnlessAsked) {
  EXPECT_EQ(GazeOptions{}.worth, 0.0);
  EXPECT_EQ(GazeOptions{}.share, 0.0);
  EXPECT_EQ(GazeOptions{}.on_the_way_m, 0.0);
  EXPECT_FALSE(GazeOptions{}.chooses());
  EXPECT_TRUE(GazeOptions{.worth = 0.1}.chooses());
  EXPECT_TRUE(GazeOptions{.share = 0.001}.chooses());
  EXPECT_FALSE(GazeOptions{.on_the_way_m = 1.0}.chooses()) << "of a scan";
  EXPECT_NO_THROW(check_options(GazeOptions{10.0, 0.1}, "gaze"));
  EXPECT_THROW(check_options(GazeOptions{10.1, 0.0}, "gaze"), ConfigError);
  EXPECT_THROW(check_options(GazeOptions{-0.1, 0.0}, "gaze"), ConfigError);
  EXPECT_THROW(check_options(GazeOptions{0.0, 0.11}, "gaze"), ConfigError);
  EXPECT_THROW(check_options(GazeOptions{0.0, -0.001}, "gaze"), ConfigError);
  EXPECT_NO_THROW(check_options(GazeOptions{.on_the_way_m = 100.0}, "gaze"));
  EXPECT_THROW(check_options(GazeOptions{.on_the_way_m = 100.1}, "gaze"), ConfigError);
  EXPECT_THROW(check_options(GazeOptions{.on_the_way_m = -0.1}, "gaze"), ConfigError);
}

/// Blocks of 2 cells in a grid of 8 x 8 x 2 m round the place that is seen from, which is turned by
/// a quarter to the left. Four images of 90 degrees: ahead is the world's y axis.
struct Seen {
  GridFrame frame = make_grid_frame({0.0, 0.0, 0.0}, {8.0, 8.0, 2.0}, {8, 8, 2});
  CellBlocks blocks{frame.cells, {2, 2, 2}};
  SweepImages images = quarters();
  std::vector<float> cells = std::vector<float>(16, 8.0F);
  ShownShares shown;

  static SweepImages quarters() {
    std::vector<Gaze> gazes;
    for (int i = 0; i < 4; ++i) gazes.push_back({i * std::numbers::pi / 2.0, 0.0});
    return {std::move(gazes), 1.0, 1.0};
  }
  [[nodiscard]] std::uint32_t block_at(double x_m, double y_m) const {
    return static_cast<std::uint32_t>(blocks.index_of_cell(frame.cell_at({x_m, y_m, 0.0})));
  }
  void show(double x_m, double y_m, float share) {
    shown.block.push_back(block_at(x_m, y_m));
    shown.share.push_back(share);
  }
  [[nodiscard]] SeenBlocks seen() const {
    return {frame, blocks, cells, shown, make_pose({0.2, 0.1, 0.0}, std::numbers::pi / 2.0)};
  }
};

TEST(GainsOfImages, EachBlockIsOfTheImageThatLooksAtIt) {
  Seen scene;
  scene.show(0.5, -3.5, 0.5F);    // its centre at (1, -3): behind
  scene.show(3.5, 0.5, 0.25F);    // (3, 1): to the right
  scene.show(0.5, 3.5, 1.0F);     // (1, 3): ahead
  scene.show(-0.5, 3.5, 0.125F);  // (-1, 3): ahead
  EXPECT_EQ(gains_of_images(scene.images, scene.seen()), (std::vector{9.0, 0.0, 4.0, 2.0}));
}

TEST(ShownByImages, IsWhatAnyOfThemShows) {
  Seen scene;
  scene.show(0.5, -3.5, 0.5F);
  scene.show(3.5, 0.5, 0.25F);
  scene.show(0.5, 3.5, 1.0F);
  const auto shown_by = [&](const Images& taken) {
    return shown_by_images(scene.images, taken, scene.seen());
  };
  EXPECT_EQ(shown_by({0, 1, 2, 3}).block, scene.shown.block);
  EXPECT_EQ(shown_by({0, 1, 2, 3}).share, scene.shown.share);
  EXPECT_EQ(shown_by({0, 3}).block,
            (std::vector{scene.block_at(3.5, 0.5), scene.block_at(0.5, 3.5)}));
  EXPECT_EQ(shown_by({0, 3}).share, (std::vector{0.25F, 1.0F}));
  EXPECT_TRUE(shown_by({1}).block.empty());
}

}  // namespace
}  // namespace vantage
