// Which objects and states the views of a dataset show.
#include "vantage/recognition/dataset/shown_states.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "vantage/core/error.hpp"
#include "vantage/recognition/dataset/turntable_views.hpp"

namespace vantage {
namespace {

using ::testing::ElementsAre;

ViewFeatures seen_of(const std::string& object, double yaw_rad) {
  ViewFeatures view;
  view.name.object = object;
  view.yaw_rad = yaw_rad;
  return view;
}

TEST(StatesOf, ComeInTheOrderInWhichTheyAppear) {
  std::vector<ViewEntry> views;
  for (const auto& [category, object] : {std::pair{"hat", "hat_1"},
                                         {"cup", "cup_2"},
                                         {"hat", "hat_1"},
                                         {"cup", "cup_1"},
                                         {"hat", "hat_3"}}) {
    views.emplace_back().name = {.category = category, .object = object};
  }
  const ObjectStates states = states_of(views, 5);
  EXPECT_EQ(states.bins, 5);
  EXPECT_THAT(states.objects, ElementsAre("hat_1", "cup_2", "cup_1", "hat_3"));
  EXPECT_THAT(states.categories, ElementsAre("hat", "cup"));
  EXPECT_THAT(states.category_of, ElementsAre(0, 1, 1, 0));
}

TEST(AddedObjects, ComeBehindWithTheCategoriesThatAreNew) {
  ObjectStates states{.objects = {"hat_1", "cup_1"},
                      .categories = {"hat", "cup"},
                      .category_of = {0, 1},
                      .bins = 4};
  const ObjectStates added{.objects = {"pen_1", "cup_2", "pen_2"},
                           .categories = {"cup", "pen"},
                           .category_of = {1, 0, 1},
                           .bins = 4};
  add_objects(states, added);
  EXPECT_THAT(states.objects, ElementsAre("hat_1", "cup_1", "pen_1", "cup_2", "pen_2"));
  EXPECT_THAT(states.categories, ElementsAre("hat", "cup", "pen"));
  EXPECT_THAT(states.category_of, ElementsAre(0, 1, 2, 1, 2));
  EXPECT_THROW(add_objects(states, added), InputError);
}

TEST(StatesShown, AreTheObjectInTheBinOfItsYaw) {
  const ObjectStates states{.objects = {"hat_1", "cup_1"},
                            .categories = {"hat", "cup"},
                            .category_of = {0, 1},
                            .bins = 4};
  std::vector<ViewFeatures> views{seen_of("cup_1", 0.1), seen_of("hat_1", 3.2),
                                  seen_of("cup_1", 4.6), seen_of("cup_1", 6.2)};
  EXPECT_THAT(states_shown(views, states), ElementsAre(4, 2, 7, 4));
  views.insert(views.begin() + 1, seen_of("pen_1", 0.1));
  EXPECT_THAT(states_shown_if_known(views, states), ElementsAre(4, -1, 2, 7, 4));
  EXPECT_THROW(states_shown(views, states), InputError);
}

TEST(AddViews, LeavesOutThoseThatLackTheFeature) {
  std::vector<ViewFeatures> views(4);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto x = static_cast<float>(i);
    views[i].features = {FeatureResult::skip("not that one"),
                         {Eigen::Vector2f(10.0F + x, 2.0F * x), {}}};
  }
  views[2].features[1] = FeatureResult::skip("hidden");
  GaussianStatistics statistics = empty_statistics(2, 3);
  add_views(statistics, views, std::vector{1, 2, 1, 1}, 1);
  EXPECT_THAT(statistics.count, ElementsAre(0, 2, 1));
  EXPECT_TRUE(statistics.mean.col(1).isApprox(Eigen::Vector2f(11.5F, 3.0F)));
  EXPECT_TRUE(statistics.mean.col(2).isApprox(Eigen::Vector2f(11.0F, 2.0F)));
}

TEST(ViewsOfVideos, AreInTheirOrder) {
  DatasetIndex dataset;
  for (const int video : {4, 1, 2, 4, 2, 1}) {
    ViewEntry& view = dataset.views.emplace_back();
    view.name.video = video;
    view.name.frame = static_cast<int>(dataset.views.size());
  }
  std::vector<int> frames;
  for (const ViewEntry& view : views_of_videos(dataset, std::vector{1, 4})) {
    frames.push_back(view.name.frame);
  }
  EXPECT_THAT(frames, ElementsAre(1, 2, 4, 6));
}

TEST(Turntables, AreOfEachFolderAndVideo) {
  std::vector<ViewFeatures> views;
  for (const auto& [folder, video] : {std::pair{"/hall/cup", 2},
                                      {"/hall/hat", 2},
                                      {"/hall/cup", 1},
                                      {"/attic/cup", 2},
                                      {"/hall/cup", 2},
                                      {"/hall/hat", 2}}) {
    ViewFeatures& view = views.emplace_back();
    view.folder = folder;
    view.name.video = video;
  }
  const std::vector<TurntableViews> turntables = turntables_of(views);
  ASSERT_EQ(turntables.size(), 4U);
  EXPECT_THAT(turntables[0].views, ElementsAre(0U, 4U));
  EXPECT_THAT(turntables[1].views, ElementsAre(1U, 5U));
  EXPECT_THAT(turntables[2].views, ElementsAre(2U));
  EXPECT_THAT(turntables[3].views, ElementsAre(3U));
}

TEST(NearestView, IsTheOneTheShortWayRound) {
  std::vector<ViewFeatures> views;
  for (const double yaw_rad : {0.0, 1.0, 3.0, 6.2, 0.1}) views.push_back(seen_of("cup", yaw_rad));
  const TurntableViews turntable{{4, 1, 2, 3}};
  EXPECT_EQ(nearest_view(turntable, views, 0.0), 3U) << "0.083 away, the other 0.1";
  EXPECT_EQ(nearest_view(turntable, views, 0.2), 4U);
  EXPECT_EQ(nearest_view(turntable, views, 1.9), 1U);
  EXPECT_EQ(nearest_view(turntable, views, 2.1), 2U);
  EXPECT_EQ(nearest_view(turntable, views, 2.0), 1U) << "of equal ones the first";
  EXPECT_EQ(nearest_view(turntable, views, 1.1 + 4.0 * std::numbers::pi), 1U);
  EXPECT_EQ(nearest_view(turntable, views, -0.9), 3U);
}

}  // namespace
}  // namespace vantage
