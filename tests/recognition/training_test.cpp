#include "vantage/recognition/training.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <variant>

#include "tests/recognition/made_up.hpp"
#include "tests/recognition/painted_dataset.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/perception/dataset_reader.hpp"
#include "vantage/recognition/change_detection.hpp"
#include "vantage/recognition/dataset/picture_views.hpp"
#include "vantage/recognition/dataset/shown_states.hpp"
#include "vantage/recognition/dataset/transition_training.hpp"
#include "vantage/recognition/recognition.hpp"

namespace vantage {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Training : public ::testing::Test {
 protected:
  Training() {
    put("cup", "cup_1", 0);
    put("cup", "cup_2", 40);
    put("hat", "hat_1", 80);
    options_.features = {Colour{}, BoundingBox{}};
    options_.transition_prior_moves = 10.0;
  }

  void put(const std::string& category, const std::string& object, int hue) {
    test::put_painted_object(folder_.path(), {category, object, hue}, 16);
  }
  [[nodiscard]] RecognitionModel train(int threads = 2) const {
    return train_recognition(index_dataset(folder_.path()), options_, {.threads = threads});
  }
  void expect_error(const std::string& part) const {
    try {
      (void)train();
      FAIL() << "no error that says " << part;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(part));
    }
  }

  support::TemporaryDirectory folder_;
  TrainingOptions options_;
};

/// Without what was measured with a clock.
void expect_same(const RecognitionModel& a, const RecognitionModel& b) {
  ASSERT_EQ(a.features.size(), b.features.size());
  EXPECT_EQ(a.states.objects, b.states.objects);
  for (std::size_t f = 0; f < a.features.size(); ++f) {
    EXPECT_EQ(a.features[f].statistics.count, b.features[f].statistics.count);
    EXPECT_EQ(a.features[f].statistics.mean, b.features[f].statistics.mean);
    EXPECT_EQ(a.features[f].statistics.squared_deviation,
              b.features[f].statistics.squared_deviation);
    EXPECT_EQ(a.features[f].psi, b.features[f].psi);
  }
}

TEST_F(Training, ViewsNotTrainedOnAreRecognisedWithTheirPose) {
  const Recogniser recogniser = make_recogniser(train(), {}, 1);
  RecognitionOptions options;
  options.all_features = true;
  Rng rng(1);
  int views = 0;
  for (const ViewEntry& entry : index_dataset(folder_.path()).views) {
    if (entry.name.video != 2) continue;
    const LabelledView view = load_view(entry);
    Recognition known = begin_recognition(recogniser);
    update_with_view(recogniser, options, extract_from(recogniser, view.view), 0.0, known, rng);
    const int best = most_probable_state(known.belief);
    const auto object = static_cast<std::size_t>(recogniser.states.object_of(best));
    EXPECT_EQ(recogniser.states.objects[object], view.name.object);
    EXPECT_LE(bin_error(recogniser.states, best, yaw_bin(view.yaw_rad)), 1);
    ++views;
  }
  EXPECT_EQ(views, 48);
}

TEST_F(Training, EveryTrainingViewCounts) {
  const RecognitionModel model = train();
  EXPECT_THAT(model.states.objects, ElementsAre("cup_1", "cup_2", "hat_1"));
  EXPECT_THAT(model.states.categories, ElementsAre("cup", "hat"));
  const std::vector<int>& count = model.features[0].statistics.count;
  EXPECT_EQ(std::accumulate(count.begin(), count.end(), 0), 3 * 2 * 16);
  EXPECT_GT(model.features[0].psi, 0.0);
  EXPECT_GT(model.features[0].cost_s, 0.0);
  EXPECT_EQ(model.states.bins, 8);
}

TEST_F(Training, ACopyOfAViewCountsOnce) {
  const auto folder = folder_ / "cup/cup_1";
  for (const std::string file :
       {"crop.png", "depthcrop.png", "maskcrop.png", "loc.txt", "pose.txt"}) {
    std::filesystem::copy_file(folder / ("cup_1_1_1_" + file), folder / ("cup_1_1_17_" + file));
  }
  options_.bins = 4;
  const RecognitionModel model = train();
  EXPECT_EQ(model.states.bins, 4);
  const std::vector<int>& count = model.features[0].statistics.count;
  EXPECT_EQ(std::accumulate(count.begin(), count.end(), 0), 3 * 2 * 16);
}

TEST_F(Training, TellsOfEachPartHowMuchThereIs) {
  options_.feature_views = 10;
  std::map<std::string, std::size_t> parts;
  const LongWork how{
      .threads = 2,
      .tell = [&](const std::string& part, std::size_t, std::size_t of) { parts[part] = of; }};
  (void)train_recognition(index_dataset(folder_.path()), options_, how);
  EXPECT_EQ(parts["reading views to learn features from"], 10U);
  EXPECT_EQ(parts["learning features"], 2U);
  EXPECT_EQ(parts[std::string(kExtractingFeatures)], 96U);
}

/// Else there were none to train on.
TEST_F(Training, OfPicturesOfOneRecordingAShareIsHeldOut) {
  DatasetIndex dataset = index_dataset(folder_.path());
  std::erase_if(dataset.views, [](const ViewEntry& view) { return view.name.video != 1; });
  for (ViewEntry& view : dataset.views) view.notes = std::make_shared<const PictureNotes>();
  EXPECT_GT(train_recognition(dataset, options_, {}).features[0].psi, 0.0);
}

TEST_F(Training, WithoutViewsHeldOutPsiIsForRulesThatNeedNone) {
  const support::TemporaryDirectory few;
  test::put_painted_object(few.path(), {"cup", "cup_1", 0}, 8);
  test::put_painted_object(few.path(), {"hat", "hat_1", 80}, 8);
  options_.held_out = HeldOutShare{.share = 0.01};
  options_.seed = 3;
  const auto train_few = [&] {
    return train_recognition(index_dataset(few.path()), options_, {.threads = 1});
  };
  EXPECT_THROW(train_few(), InputError) << "this seed holds out none of the 32";
  options_.held_out = HeldOutAuto{.share = 0.01};
  EXPECT_THROW(train_few(), InputError) << "by the same share";
  options_.psi = PerDimensionPsi{};
  const RecognitionModel model = train_few();
  EXPECT_EQ(model.features[0].psi, 1.0 / 144.0);
  EXPECT_EQ(model.features[1].psi, 1.0 / 3.0);
  options_.psi = DissertationPsi{};
  EXPECT_EQ(train_few().features[1].psi, 0.02);
}

TEST_F(Training, IsTheSameForAnyNumberOfThreads) { expect_same(train(1), train(3)); }

TEST_F(Training, ObjectsAddedLaterAreAsIfTheyHadBeenThere) {
  RecognitionModel model = train();
  const double psi = model.features[0].psi;
  const support::TemporaryDirectory more;
  test::put_painted_object(more.path(), {"hat", "hat_2", 120}, 16);
  test::put_painted_object(more.path(), {"shoe", "shoe_1", 150}, 16);
  extend_recognition(model, index_dataset(more.path()), options_, {.threads = 2});
  EXPECT_THAT(model.states.categories, ElementsAre("cup", "hat", "shoe"));
  EXPECT_THAT(model.states.category_of, ElementsAre(0, 0, 1, 1, 2));
  put("hat", "hat_2", 120);
  put("shoe", "shoe_1", 150);
  RecognitionModel whole = train();
  EXPECT_EQ(model.features[0].psi, psi);
  for (std::size_t f = 0; f < 2; ++f) whole.features[f].psi = model.features[f].psi;
  expect_same(model, whole);
}

TEST_F(Training, AnObjectKnownAlreadyIsNotAddedTwice) {
  RecognitionModel model = train();
  try {
    extend_recognition(model, index_dataset(folder_.path()), options_, {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'cup_1' already"));
  }
}

TEST_F(Training, LearnsATransitionThatKeepsTheObjectAndDistributesSlips) {
  const LearnedTransition learnt = transition_of(train());
  EXPECT_NEAR(learnt.same_object, 1.0, 1e-9);
  EXPECT_NO_THROW(learnt.check());
  EXPECT_GT(learnt.slip[1 * 8 + 0], 0.5);
}

TEST_F(Training, VideosCanBeHeldOutInTurn) {
  options_.held_out = HeldOutVideos{};
  EXPECT_GT(train().features[0].psi, 0.0);
  options_.videos = {1};
  expect_error("two videos");
}

TEST_F(Training, SaysWhatIsWrongWithItsOptions) {
  options_.videos = {3};
  expect_error("3 is none of 1, 2, 4");
  options_.videos = {1, 1};
  expect_error("each once");
  options_.videos = {1, 4};
  options_.features = {Colour{}, Colour{}};
  expect_error("'colour' appears twice");
  options_.features = {};
  expect_error("at least one");
}

TEST_F(Training, NotesOfOneDirectionTellNoPosesApart) {
  DatasetIndex dataset = index_dataset(folder_.path());
  const auto notes = std::make_shared<PictureNotes>();
  notes->bins = 1;
  for (ViewEntry& view : dataset.views) view.notes = notes;
  EXPECT_THROW((void)train_recognition(dataset, options_, {}), ConfigError);
}

TEST_F(Training, ABadViewIsAnErrorOfItsFile) {
  write_file(folder_.path() / "cup" / "cup_1" / "cup_1_1_3_crop.png", "no picture");
  expect_error("cup_1_1_3_crop.png");
}

TEST_F(Training, EndsWhereItIsPolled) {
  struct Stop {};
  std::atomic<int> calls = 0;
  const LongWork how{.threads = 2, .poll = [&] {
                       if (++calls > 20) throw Stop{};
                     }};
  EXPECT_THROW(train_recognition(index_dataset(folder_.path()), options_, how), Stop);
}

TEST_F(Training, StatedCostsMakeTheSameModelEachTime) {
  options_.costs_s = {0.5, 0.25};
  const RecognitionModel model = train(1);
  EXPECT_EQ(model.features[0].cost_s, 0.5);
  EXPECT_EQ(model.features[1].cost_s, 0.25);
  write_recognition_model(model, folder_ / "first");
  write_recognition_model(train(3), folder_ / "second");
  EXPECT_TRUE(read_file(folder_ / "first") == read_file(folder_ / "second"));
  options_.costs_s = {0.5};
  expect_error("costs_s: 1 of them for 2 features");
}

/// Two objects of each of three categories, and one of a hue that none of them has.
class UnknownObjects : public ::testing::Test {
 protected:
  UnknownObjects() {
    int hue = 0;
    for (const std::string category : {"cup", "hat", "pen"}) {
      for (const char* number : {"_1", "_2"}) {
        test::put_painted_object(folder_.path(), {category, category + number, hue}, 16);
        hue += 20;
      }
    }
    test::put_painted_object(folder_.path(), {"lamp", "lamp_1", 145}, 16);
    options_.features = {Colour{}};
    options_.leave_out = {"lamp_1"};
    options_.transition_prior_moves = 0.0;
  }
  [[nodiscard]] RecognitionModel train() const {
    return train_recognition(index_dataset(folder_.path()), options_, {.threads = 2});
  }

  support::TemporaryDirectory folder_;
  TrainingOptions options_;
};

TEST_F(UnknownObjects, AreFoundAndKnownOnesAreNot) {
  const RecognitionModel model = train();
  EXPECT_EQ(model.states.object_count(), 6);
  const Recogniser recogniser = make_recogniser(model, {}, 1);
  EXPECT_EQ(recogniser.states.unknown_size(), 4);
  RecognitionOptions options;
  options.all_features = true;
  Rng rng(1);
  int found = 0;
  int alarms = 0;
  for (const ViewEntry& entry : index_dataset(folder_.path()).views) {
    if (entry.name.video != 2) continue;
    const LabelledView view = load_view(entry);
    Recognition known = begin_recognition(recogniser);
    update_with_view(recogniser, options, extract_from(recogniser, view.view), 0.0, known, rng);
    const bool unknown = estimate_of(recogniser.states, known.belief).object == kUnknown;
    (entry.name.object == "lamp_1" ? found : alarms) += unknown ? 1 : 0;
  }
  EXPECT_GE(found, 15) << "of 16";
  EXPECT_LE(alarms, 5) << "of 96";
}

TEST_F(UnknownObjects, PutInThePlaceOfAKnownOneAreAChange) {
  const Recogniser recogniser = make_recogniser(train(), {}, 1);
  Rng rng(1);
  for (const ViewEntry& entry : index_dataset(folder_.path()).views) {
    if (entry.name.video != 2 || entry.name.object != "lamp_1" || entry.name.frame > 4) continue;
    const LabelledView view = load_view(entry);
    const ChangeOptions options;
    ChangeSearch search = begin_change_search(recogniser, options, 0);
    update_with_view(recogniser, options, extract_from(recogniser, view.view), 0.0, search, rng);
    EXPECT_EQ(verdict(recogniser, options, search), Change::object);
    EXPECT_TRUE(is_unknown(recogniser.states, search.hypotheses.changed));
  }
}

// To the bit what it is without the hypothesis.
TEST_F(UnknownObjects, AreSwitchedOffByAPriorOfZero) {
  RecognitionModel model = train();
  RecogniserOptions switched_off;
  switched_off.unknown_prior = 0.0;
  switched_off.repeated_views = false;
  const Recogniser off = make_recogniser(model, switched_off, 1);
  for (FeatureModel& feature : model.features) feature.unknown.reset();
  model.view_correlation = 0.0;
  const Recogniser without = make_recogniser(model, {}, 1);
  EXPECT_EQ(off.states.unknown_size(), 0);
  EXPECT_EQ(off.tables.bhattacharyya_nats, without.tables.bhattacharyya_nats);
  const LabelledView view = load_view(index_dataset(folder_.path()).views.front());
  Rng rng(1);
  RecognitionOptions options;
  const auto seen_by = [&](const Recogniser& recogniser) {
    Recognition known = begin_recognition(recogniser);
    for (int i = 0; i < 2; ++i) {
      predict_motion(recogniser, options, 0.3 * i, known);
      update_with_view(recogniser, options, extract_from(recogniser, view.view), 0.0, known, rng);
    }
    return known.belief.log_p;
  };
  EXPECT_EQ(seen_by(off), seen_by(without));
}

TEST_F(UnknownObjects, AreNotLearntWhereNotAskedFor) {
  options_.unknown = false;
  const RecognitionModel model = train();
  EXPECT_FALSE(model.features[0].unknown);
  EXPECT_EQ(model.view_correlation, 0.0);
  EXPECT_EQ(make_recogniser(model, {}, 1).states.unknown_size(), 0);
}

TEST_F(UnknownObjects, LeftOutMustBeThere) {
  options_.leave_out = {"lamp_9"};
  EXPECT_THROW(static_cast<void>(train()), InputError);
}

TEST(RepeatedViews, CountForLess) {
  Rng rng(3);
  Recogniser recogniser = test::made_up_recogniser(6, {2.0}, {}, rng);
  RecognitionOptions options;
  options.all_features = true;
  const auto p_after = [&](double correlation) {
    recogniser.view_correlation = correlation;
    Recognition known = begin_recognition(recogniser);
    for (int i = 0; i < 3; ++i) {
      const auto extract = [&](std::size_t) {
        Eigen::VectorXd log_likelihood = Eigen::VectorXd::Zero(recogniser.states.size());
        log_likelihood.head(8).setConstant(1.0);
        return ExtractedFeature{.result = {Eigen::VectorXf::Zero(1), {}},
                                .log_likelihood = log_likelihood};
      };
      update_with_view(recogniser, options, extract, 0.0, known, rng);
    }
    return p_object(recogniser.states, known.belief)[0];
  };
  const auto p_of = [](double views) { return std::exp(views) / (std::exp(views) + 5.0); };
  EXPECT_NEAR(p_after(0.0), p_of(3.0), 1e-9);
  EXPECT_NEAR(p_after(0.5), p_of(3.0 / (1.0 + 2.0 * 0.5)), 1e-9);
  EXPECT_NEAR(p_after(1.0), p_of(1.0), 1e-9);
}

TEST_F(Training, LeavingOutAllObjectsLeavesNone) {
  options_.leave_out = {"cup_1", "cup_2", "hat_1"};
  expect_error("leave_out: leaves no object to train on");
}

TEST_F(Training, AFeatureThatNoViewHasIsNamed) {
  options_.features = {BoundingBox{}, Colour{.min_pixels = 100000}};
  expect_error("feature 'colour' can be extracted from none of 96 views; ");
}

TEST_F(Training, WithoutPriorMovesNoTransitionIsLearnt) {
  options_.transition_prior_moves = 0.0;
  EXPECT_EQ(train().transitions.slip.size(), 0);
}

}  // namespace
}  // namespace vantage
