#include "vantage/recognition/recogniser.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_directory.hpp"

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

TEST(Recogniser, AModelOfNothingIsAnError) {
  expect_error([] { make_recogniser(RecognitionModel{}, {}, 1); }, "no features");
}

}  // namespace
}  // namespace vantage
