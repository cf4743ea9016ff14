#include "vantage/recognition/recogniser.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/support/temporary_directory.hpp"
#include "vantage/belief/objects/baum_welch.hpp"
#include "vantage/recognition/dataset/picture_views.hpp"
#include "vantage/recognition/lean_recogniser.hpp"
#include "vantage/recognition/recognition.hpp"

namespace vantage {
namespace {

using ::testing::HasSubstr;

/// Three objects seen thrice in each of two poses by `bounding_box` and `colour`.
RecognitionModel small_model() {
  RecognitionModel model;
  model.states.objects = {"a_1", "a_2", "b_1"};
  model.states.categories = {"a", "b"};
  model.states.category_of = {0, 0, 1};
  model.states.bins = 2;
  Rng rng(1);
  const auto add = [&](const TrainedFeature& extractor, double psi) {
    FeatureModel feature{.name = std::string(extractor.name()),
                         .statistics = empty_statistics(extractor.dimension(), 6),
                         .psi = psi,
                         .cost_s = 0.01,
                         .blobs = {{kExtractorBlob, extractor.to_bytes()}}};
    for (int i = 0; i < 18; ++i) {
      Eigen::VectorXf x(extractor.dimension());
      for (float& value : x) value = static_cast<float>(rng.normal(i % 6, 0.5));
      add_view(feature.statistics, i % 6, x);
    }
    model.features.push_back(feature);
  };
  add(TrainedFeature(BoundingBox{}, 0.01), 0.5);
  add(TrainedFeature(Colour{}, 0.01), 0.02);
  return model;
}

void expect_error(const auto& call, const std::string& part) {
  try {
    call();
    FAIL() << "no error that says " << part;
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr(part));
  }
}

TEST(Recogniser, TablesOfAllFeaturesAreTheSumOfEach) {
  const Recogniser recogniser = make_recogniser(small_model(), {}, 2);
  ASSERT_EQ(recogniser.features.size(), 2U);
  const std::vector<const ObservationModel*> models{&recogniser.features[0].observation,
                                                    &recogniser.features[1].observation};
  const std::vector<int> all{0, 1, 2, 3, 4, 5};
  const Eigen::MatrixXf expected = state_divergences(Divergence::bhattacharyya, models, all);
  EXPECT_LT((recogniser.tables.bhattacharyya_nats - expected).cwiseAbs().maxCoeff(),
            1e-4F * expected.maxCoeff());
}

TEST(Recogniser, TakesTheFeaturesAskedForInThatOrder) {
  const Recogniser one = make_recogniser(small_model(), {.features = {"colour"}}, 1);
  ASSERT_EQ(one.features.size(), 1U);
  EXPECT_EQ(one.features[0].observation.feature, "colour");
  EXPECT_EQ(one.features[0].observation.psi, 0.02);
  const Recogniser two =
      make_recogniser(small_model(), {.features = {"colour", "bounding_box"}}, 1);
  EXPECT_EQ(two.features[1].extractor.name(), "bounding_box");
}

TEST(Recogniser, TakesSomeTimeForEveryFeature) {
  RecognitionModel model = small_model();
  model.features[1].cost_s = 0.0;
  const Recogniser recogniser = make_recogniser(model, {}, 1);
  EXPECT_EQ(recogniser.features[0].observation.cost_s, 0.01);
  EXPECT_EQ(recogniser.features[1].observation.cost_s, 1e-6) << "gains per second are finite";
}

TEST(Recogniser, NamesTheFeatureThatIsNotThere) {
  expect_error([] { make_recogniser(small_model(), {.features = {"sift"}}, 1); },
               "no 'sift'; known: bounding_box, colour");
  expect_error(
      [] {
        make_recogniser(small_model(), {.features = {"colour", "colour"}}, 1);
      },
      "twice");
}

TEST(Recogniser, ADamagedModelIsAnErrorOfItsFile) {
  const support::TemporaryDirectory directory;
  const auto path = directory.path() / "model.vrm";
  RecognitionModel model = small_model();
  write_recognition_model(model, path);
  EXPECT_EQ(load_recogniser(path, {}, 1).states.size(), 6);
  model.features[0].blobs[kExtractorBlob] = model.features[1].blobs[kExtractorBlob];
  write_recognition_model(model, path);
  expect_error([&] { load_recogniser(path, {}, 1); }, path.string());
  model.features[0].blobs.clear();
  write_recognition_model(model, path);
  expect_error([&] { load_recogniser(path, {}, 1); }, "nothing to extract");
  expect_error([&] { load_recogniser(directory.path() / "none", {}, 1); }, "none");
}

TEST(Recogniser, KnowsUnknownObjectsIfAllItsFeaturesDo) {
  RecognitionModel model = small_model();
  model.view_correlation = 0.3;
  EXPECT_EQ(make_recogniser(model, {}, 1).states.unknown_size(), 0);
  model.features[0].unknown = UnknownFactors{};
  EXPECT_EQ(make_recogniser(model, {}, 1).states.unknown_size(), 0) << "one of two";
  EXPECT_EQ(make_recogniser(model, {}, 1).unknown_prior, 0.0);
  EXPECT_EQ(make_recogniser(model, {.features = {"bounding_box"}}, 1).states.unknown_size(), 3);
  model.features[1].unknown = UnknownFactors{};
  const Recogniser knowing = make_recogniser(model, {}, 1);
  EXPECT_EQ(knowing.states.unknown_category, (std::vector<int>{0, 1, kNoCategory}));
  EXPECT_EQ(knowing.unknown_prior, 0.1);
  EXPECT_EQ(knowing.view_correlation, 0.3);
  EXPECT_EQ(knowing.features[1].observation.states(), 9);
  EXPECT_EQ(knowing.tables.bhattacharyya_nats.rows(), 9);
  const Recogniser not_asked =
      make_recogniser(model, {.features = {}, .unknown_prior = 0.0, .repeated_views = false}, 1);
  EXPECT_EQ(not_asked.states.unknown_size(), 0);
  EXPECT_EQ(not_asked.unknown_prior, 0.0);
  EXPECT_EQ(not_asked.view_correlation, 0.0);
}

TEST(Recogniser, HoldsWhatNoPictureShowedForImpossible) {
  RecognitionModel model = small_model();
  for (FeatureModel& feature : model.features) {
    feature.statistics.count[4] = 0;
    feature.statistics.mean.col(4).setZero();
    feature.statistics.squared_deviation.col(4).setZero();
  }
  EXPECT_EQ(make_recogniser(model, {}, 1).features[0].prepared.log_factor[4], 0.0);
  keep_notes({}, 0.0, model);
  const Recogniser of_pictures = make_recogniser(model, {}, 1);
  for (const RecogniserFeature& feature : of_pictures.features) {
    for (int state = 0; state < 6; ++state) {
      EXPECT_EQ(feature.prepared.log_factor[state] < -1e8, state == 4) << state;
      EXPECT_EQ(feature.prepared.log_at_mean[state] < -1e8, state == 4) << state;
    }
  }
}

TEST(Recogniser, TakesTheFloorOfVariancesFromTheModel) {
  RecognitionModel model = small_model();
  keep_notes({}, 100.0, model);
  const Eigen::MatrixXf raised = make_recogniser(model, {}, 1).features[0].observation.variance;
  EXPECT_LT(raised.maxCoeff() - raised.minCoeff(), 1e-6F * raised.maxCoeff());
  keep_notes({}, 0.0, model);
  const Eigen::MatrixXf plain = make_recogniser(model, {}, 1).features[0].observation.variance;
  EXPECT_LT(plain.maxCoeff(), 0.5F * raised.minCoeff());
}

TEST(Recogniser, AtOnceReadyIsTheSameWithoutTables) {
  const support::TemporaryDirectory directory;
  write_recognition_model(small_model(), directory / "model.vrm");
  const Recogniser whole = load_recogniser(directory / "model.vrm", {}, 1);
  const Recogniser lean = load_lean_recogniser(directory / "model.vrm", {});
  EXPECT_EQ(whole.tables.bhattacharyya_nats.rows(), 6);
  EXPECT_EQ(whole.features[1].tables.bhattacharyya_nats.rows(), 6);
  EXPECT_EQ(lean.tables.bhattacharyya_nats.size(), 0);
  EXPECT_EQ(lean.features[1].tables.bhattacharyya_nats.size(), 0);
  EXPECT_EQ(lean.features[1].prepared.log_at_mean, whole.features[1].prepared.log_at_mean);
}

TEST(Recogniser, ExtractsByTheNameAndSizeOfItsFeature) {
  RecognitionModel model = small_model();
  EXPECT_EQ(extractor_of(model.features[0], "here").name(), "bounding_box");
  FeatureModel other_size = model.features[0];
  other_size.statistics = empty_statistics(other_size.statistics.dimensions() + 1, 6);
  expect_error([&] { extractor_of(other_size, "here"); }, "here: feature 'bounding_box' of 4");
  FeatureModel other_name = model.features[0];
  other_name.name = "colour";
  expect_error([&] { extractor_of(other_name, "here"); }, "extracted as 'bounding_box' of 3");
  model.features.clear();
  expect_error([&] { make_recogniser(model, {}, 1); }, "no features");
}

TEST(Recogniser, AModelOfNothingIsAnError) {
  expect_error([] { make_recogniser(RecognitionModel{}, {}, 1); }, "no features");
}

/// What is unknown is told from how objects differ from each other.
TEST(Recogniser, KnowsUnknownObjectsIfItKnowsTwo) {
  const auto unknown_of = [](int objects) {
    RecognitionModel model = small_model();
    model.states.objects.resize(static_cast<std::size_t>(objects));
    model.states.category_of.resize(static_cast<std::size_t>(objects));
    model.states.categories = {"a"};
    Rng rng(2);
    for (FeatureModel& feature : model.features) {
      feature.statistics = empty_statistics(feature.statistics.dimensions(), 2 * objects);
      for (int i = 0; i < 6 * objects; ++i) {
        Eigen::VectorXf x(feature.statistics.dimensions());
        for (float& value : x) value = static_cast<float>(rng.normal(i % (2 * objects), 0.5));
        add_view(feature.statistics, i % (2 * objects), x);
      }
      feature.unknown = UnknownFactors{};
    }
    return make_recogniser(model, {}, 1).states.unknown_size();
  };
  EXPECT_GT(unknown_of(2), 0);
  EXPECT_EQ(unknown_of(1), 0);
}

TEST(Recogniser, BeginsWithoutWhatNoPictureShowed) {
  RecognitionModel model = small_model();
  for (FeatureModel& feature : model.features) {
    feature.statistics.count[4] = 0;
    feature.statistics.mean.col(4).setZero();
    feature.statistics.squared_deviation.col(4).setZero();
  }
  EXPECT_TRUE(make_recogniser(model, {}, 1).unseen.empty()) << "it is of no pictures";
  keep_notes({}, 0.0, model);
  const Recogniser of_pictures = make_recogniser(model, {}, 1);
  EXPECT_EQ(of_pictures.unseen, std::vector<int>{4});
  const Eigen::VectorXd p = p_state(begin_recognition(of_pictures).belief);
  for (int state = 0; state < 4; ++state) EXPECT_NEAR(p[state], 1.0 / 6.0, 1e-12) << state;
  EXPECT_EQ(p[4], 0.0);
  EXPECT_NEAR(p[5], 1.0 / 3.0, 1e-12) << "of that object no other side is known";
}

TEST(Recogniser, SaysOfAFileThatItWasTrainedWithoutUnknownObjects) {
  const support::TemporaryDirectory directory;
  RecognitionModel model = small_model();
  const auto said = [&](double unknown_prior) {
    write_recognition_model(model, directory / "model.vrm");
    testing::internal::CaptureStderr();
    load_recogniser(directory / "model.vrm",
                    {.features = {}, .unknown_prior = unknown_prior, .repeated_views = true}, 1);
    make_recogniser(model, {}, 1);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_THAT(said(0.1), HasSubstr("model.vrm: was trained without unknown objects"));
  EXPECT_EQ(said(0.0), "") << "nobody asked";
  for (FeatureModel& feature : model.features) feature.unknown = UnknownFactors{};
  EXPECT_EQ(said(0.1), "");
}

TEST(Recogniser, OptionsAreInTheirRange) {
  RecogniserOptions options;
  options.unknown_prior = 1.0;
  expect_error([&] { make_recogniser(small_model(), options, 1); }, "unknown_prior");
}

TEST(Recogniser, HasTheTransitionThatItsModelLearnt) {
  RecognitionModel model = small_model();
  const LearnedTransition rigid = make_recogniser(model, {}, 1).transition;
  ASSERT_EQ(rigid.slip.size(), 4U);
  EXPECT_NEAR(rigid.slip[0], 0.9, 1e-12);
  model.transitions = prior_counts(RigidTransition{.slip = 0.4}, 2, 10.0);
  EXPECT_NEAR(make_recogniser(model, {}, 1).transition.slip[0], 0.6, 1e-12);
}

TEST(Recogniser, MayKnowASingleState) {
  RecognitionModel model = small_model();
  model.states = {.objects = {"a_1"}, .categories = {"a"}, .category_of = {0}, .bins = 1};
  for (FeatureModel& feature : model.features) {
    feature.statistics = empty_statistics(feature.statistics.dimensions(), 1);
    for (const float value : {1.0F, 2.0F, 4.0F}) {
      add_view(feature.statistics, 0,
               Eigen::VectorXf::Constant(feature.statistics.dimensions(), value));
    }
  }
  EXPECT_EQ(make_recogniser(model, {}, 1).states.size(), 1);
}

}  // namespace
}  // namespace vantage
