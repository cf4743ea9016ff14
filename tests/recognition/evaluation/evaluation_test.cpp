#include "vantage/recognition/evaluation/evaluation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "tests/recognition/painted_dataset.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/recognition/dataset/picture_views.hpp"
#include "vantage/recognition/dataset/shown_states.hpp"
#include "vantage/recognition/evaluation/change_evaluation.hpp"
#include "vantage/recognition/evaluation/svm_baseline.hpp"
#include "vantage/recognition/training.hpp"

namespace vantage {
namespace {

using ::testing::HasSubstr;

/// Two cups alike from the front and different from behind, and a hat.
class Evaluation : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const support::TemporaryDirectory folder;
    test::put_painted_object(folder.path(), {"cup", "cup_1", 0, 60}, 16);
    test::put_painted_object(folder.path(), {"cup", "cup_2", 0, 90}, 16);
    test::put_painted_object(folder.path(), {"hat", "hat_1", 140}, 16);
    index_ = new DatasetIndex(index_dataset(folder.path()));
    TrainingOptions training;
    training.features = {Colour{}, BoundingBox{}};
    model_ = new RecognitionModel(train_recognition(*index_, training, {}));
    test_ = new TestViews(read_test_views(*index_, *model_, 2, {}));
    training_ = new std::vector<ViewFeatures>(extract_features(
        views_of_videos(*index_, std::vector{1, 4}),
        std::vector{extractor_of(model_->features[0], ""), extractor_of(model_->features[1], "")},
        {}, "training views"));
  }
  static void TearDownTestSuite() {
    delete index_;
    delete model_;
    delete test_;
    delete training_;
  }

  Evaluation()
      : recogniser_(make_recogniser(*model_, {}, 1)),
        likelihoods_(log_likelihoods(recogniser_, *test_, {})) {}

  std::vector<Trial> run(const RecognitionOptions& options, int threads = 1) {
    return run_trials(recogniser_, *test_, likelihoods_, draw_starts(*test_, 100, 1),
                      {"method", options}, 1, {.threads = threads});
  }
  static double accuracy(const std::vector<Trial>& trials) {
    return static_cast<double>(std::ranges::count_if(trials, &Trial::correct)) / 100.0;
  }

  static DatasetIndex* index_;
  static RecognitionModel* model_;
  static TestViews* test_;
  static std::vector<ViewFeatures>* training_;
  Recogniser recogniser_;
  std::vector<Eigen::MatrixXf> likelihoods_;
};
DatasetIndex* Evaluation::index_ = nullptr;
RecognitionModel* Evaluation::model_ = nullptr;
TestViews* Evaluation::test_ = nullptr;
std::vector<ViewFeatures>* Evaluation::training_ = nullptr;

TEST_F(Evaluation, ASingleViewCannotTellWhatDiffersBehindAndSeveralCan) {
  RecognitionOptions options;
  options.max_views = 1;
  const double single = accuracy(run(options));
  EXPECT_GT(single, 0.6);
  EXPECT_LT(single, 0.95);
  options.max_views = 8;
  const std::vector<Trial> several = run(options);
  EXPECT_GE(accuracy(several), 0.98);
  for (const Trial& trial : several) {
    EXPECT_TRUE(trial.category_correct);
    EXPECT_LE(trial.bin_error, 4);
    EXPECT_GE(trial.features, trial.observations);
  }
}

TEST_F(Evaluation, IsTheSameForAnyNumberOfThreads) {
  const RecognitionOptions options;
  const auto one = run(options, 1);
  const auto three = run(options, 3);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].estimate, three[i].estimate);
    EXPECT_EQ(one[i].observations, three[i].observations);
    EXPECT_EQ(one[i].entropy_bits, three[i].entropy_bits);
    EXPECT_EQ(one[i].feature_time_s, three[i].feature_time_s);
  }
}

TEST_F(Evaluation, ACameraTurnedByABinSeesTheYawLessABin) {
  const Start start{.turntable = 1, .view = test_->turntables[1].views[5]};
  DatasetCamera camera(recogniser_, *test_, likelihoods_, start);
  const ObjectCamera as_camera = camera.as_object_camera();
  const auto actions = as_camera.actions();
  ASSERT_EQ(actions.size(), 7U);
  const double before_rad = test_->views[camera.view()].yaw_rad;
  as_camera.turn(actions[1]);
  const double turned_rad = before_rad - test_->views[camera.view()].yaw_rad;
  EXPECT_NEAR(std::remainder(turned_rad - actions[1].yaw_rad, 2.0 * std::numbers::pi), 0.0, 1e-6);
  EXPECT_NEAR(as_camera.bearing_rad(), actions[1].yaw_rad, 1e-12);
  EXPECT_TRUE(as_camera.actions()[5].visited);
  EXPECT_FALSE(as_camera.actions()[0].visited);
}

/// Three views at 0, 40 and 80 deg: nothing is to be seen from the back, and a turn leads as far as
/// there is a view.
TEST(SparseTurntable, TheCameraIsOfferedWhatItCanSee) {
  const double degree = std::numbers::pi / 180.0;
  TestViews test;
  test.turntables.emplace_back();
  for (const double yaw_deg : {0.0, 40.0, 80.0}) {
    test.turntables[0].views.push_back(test.views.size());
    test.views.emplace_back().yaw_rad = yaw_deg * degree;
  }
  const Recogniser recogniser{
      .states = {.objects = {"cup_1"}, .categories = {"cup"}, .category_of = {0}},
      .features = {},
      .tables = {}};
  DatasetCamera camera(recogniser, test, {}, {.turntable = 0, .view = 2});
  const auto actions = camera.as_object_camera().actions();
  std::vector<double> turns_deg;
  for (const ObjectViewAction& action : actions) turns_deg.push_back(action.yaw_rad / degree);
  // 45 leads to the view at 40 within a quarter of a bin, 90 to that at 0.
  EXPECT_THAT(turns_deg, ::testing::ElementsAre(::testing::DoubleNear(45.0, 1e-6),
                                                ::testing::DoubleNear(90.0, 1e-6)));
  camera = DatasetCamera(recogniser, test, {}, {.turntable = 0, .view = 0});
  test.views[1].yaw_rad = 65.0 * degree;  // beside a whole bin: as far as it is
  test.views[2].yaw_rad = 65.0 * degree;
  const auto strayed = camera.as_object_camera().actions();
  ASSERT_EQ(strayed.size(), 1U);
  EXPECT_NEAR(strayed[0].yaw_rad, 295.0 * degree, 1e-6);
}

TEST_F(Evaluation, StartsAreDrawnFromEveryObject) {
  std::vector<int> counts(3, 0);
  for (const Start& start : draw_starts(*test_, 300, 4)) {
    ++counts[start.turntable];
    EXPECT_EQ(test_->views[start.view].name.object,
              test_->views[test_->turntables[start.turntable].views[0]].name.object);
  }
  for (const int count : counts) EXPECT_GT(count, 60);
}

TEST_F(Evaluation, TheTablesHaveTheirMethods) {
  std::vector<std::string> names;
  for (const Method& method : published_methods({})) names.push_back(method.name);
  EXPECT_THAT(names, ::testing::IsSupersetOf({"single view, all features", "random", "star",
                                              "jeffreys", "loss_of_entropy", "mutual_information",
                                              "mutual_information, all features"}));
}

TEST_F(Evaluation, SupportVectorMachinesTellWhatASingleViewTells) {
  std::vector<int> label;
  for (const int state : states_shown(*training_, model_->states)) {
    label.push_back(model_->states.object_of(state));
  }
  for (const Svm& svm : {Svm(LinearSvm{}), Svm(KernelSvm{})}) {
    const std::vector<int> predicted = svm_predictions(svm, {*training_, label}, test_->views);
    int hats = 0;
    int right = 0;
    for (std::size_t i = 0; i < predicted.size(); ++i) {
      const int truth = model_->states.object_of(test_->shown[i]);
      hats += (predicted[i] == 2) == (truth == 2);
      right += predicted[i] == truth;
    }
    EXPECT_EQ(hats, 48);
    EXPECT_GE(right, 32);
  }
}

TEST_F(Evaluation, ChangesAreScoredByScenario) {
  ChangeOptions options;
  options.prior_pose = 0.25;
  options.prior_object = 0.25;
  const auto all = evaluate_changes(recogniser_, *test_, likelihoods_, draw_starts(*test_, 30, 1),
                                    options, 1, {});
  ASSERT_EQ(all.size(), 15U);
  for (const ChangeTrials& change : all) {
    ASSERT_EQ(change.trials.size(), 30U);
    EXPECT_LE(change.kind_accuracy(), change.accuracy());
    const bool unchanged = change.scenario == Change::none;
    EXPECT_GE(unchanged ? change.accuracy() : change.detectable_accuracy(), unchanged ? 0.9 : 0.75);
  }
}

TEST_F(Evaluation, AnUnknownObjectIsAnErrorThatNamesIt) {
  RecognitionModel model = *model_;
  model.states.objects[2] = "hat_7";
  try {
    states_shown(test_->views, model.states);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'hat_1'"));
  }
}

TEST_F(Evaluation, ATrialAddsUpWhatItsViewsTook) {
  const double cost_s =
      recogniser_.features[0].observation.cost_s + recogniser_.features[1].observation.cost_s;
  for (const bool all : {true, false}) {
    RecognitionOptions options;
    options.all_features = all;
    options.max_views = 3;
    int of_several = 0;
    for (const Trial& trial : run(options)) {
      of_several += trial.observations > 1 ? 1 : 0;
      EXPECT_EQ(trial.view_time_s > 0.0, trial.observations > 1);
      if (all) {
        EXPECT_EQ(trial.features, 2 * trial.observations);
        EXPECT_NEAR(trial.feature_time_s, trial.observations * cost_s, 1e-9);
      } else {
        EXPECT_GT(trial.selection_time_s, 0.0);
      }
    }
    EXPECT_GT(of_several, 10);
  }
}

TEST(TestViewsRead, SayWhatOfThemTheModelKnows) {
  const support::TemporaryDirectory folder;
  test::put_painted_object(folder.path(), {"cup", "cup_1", 0}, 4);
  test::put_painted_object(folder.path(), {"hat", "hat_1", 80}, 4);
  const TrainedFeature colour(Colour{}, 0.0);
  RecognitionModel model;
  model.states = {.objects = {"cup_1"}, .categories = {"cup"}, .category_of = {0}, .bins = 4};
  model.features.push_back({.name = "colour",
                            .statistics = empty_statistics(colour.dimension(), 4),
                            .blobs = {{kExtractorBlob, colour.to_bytes()}}});
  const TestViews test = read_test_views(index_dataset(folder.path()), model, 2, {});
  ASSERT_EQ(test.views.size(), 8U);
  EXPECT_THAT(test.shown, ::testing::ElementsAre(0, 1, 2, 3, -1, -1, -1, -1));
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(test.views[i].name.video, 2);
    EXPECT_EQ(test.category[i], i < 4 ? 0 : kNoCategory);
  }
  EXPECT_EQ(test.turntables.size(), 2U);
}

TEST_F(Evaluation, ACameraKnowsAllTheViewsItWasAt) {
  DatasetCamera camera(recogniser_, *test_, likelihoods_,
                       {.turntable = 1, .view = test_->turntables[1].views[5]});
  const ObjectCamera as_camera = camera.as_object_camera();
  as_camera.turn(as_camera.actions()[1]);
  as_camera.turn(as_camera.actions()[0]);
  const auto actions = as_camera.actions();
  ASSERT_EQ(actions.size(), 7U);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(actions[i].visited, i == 4 || i == 6) << "three bins back, or one: " << i;
  }
}

/// Of four views by name, in another order than those of the model.
TEST(TestViewsRead, AreMadeToFitTheModelsPictures) {
  const support::TemporaryDirectory folder;
  test::put_painted_object(folder.path(), {"cup", "cup_1", 0}, 4);
  const TrainedFeature colour(Colour{}, 0.0);
  RecognitionModel model;
  model.states = {.objects = {"cup_1"}, .categories = {"cup"}, .category_of = {0}, .bins = 4};
  model.features.push_back({.name = "colour",
                            .statistics = empty_statistics(colour.dimension(), 4),
                            .blobs = {{kExtractorBlob, colour.to_bytes()}}});
  PictureNotes notes;
  notes.bins = 4;
  notes.degrees = false;
  notes.views = {"a", "b", "c", "d"};
  keep_notes(notes, 0.0, model);
  std::ranges::reverse(notes.views);
  DatasetIndex dataset = index_dataset(folder.path());
  for (ViewEntry& view : dataset.views) view.notes = std::make_shared<const PictureNotes>(notes);
  const TestViews test = read_test_views(dataset, model, 2, {});
  ASSERT_EQ(test.shown.size(), 12U);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(test.shown[i], 3 - static_cast<int>(i % 4)) << i;
}

}  // namespace
}  // namespace vantage
