// A study of recognition from end to end, on painted blocks: hue tells the object.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "tests/recognition/painted_dataset.hpp"
#include "tests/support/option_numbers.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/error.hpp"
#include "vantage/perception/dataset_reader.hpp"
#include "vantage/recognition/training.hpp"
#include "vantage/study/recognition/recognition_study.hpp"

namespace vantage {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Six objects that the model is trained on, and a lamp that it does not know.
struct PaintedBlocks {
  PaintedBlocks() {
    int hue = 0;
    for (const std::string category : {"cup", "hat", "pen"}) {
      for (const char* number : {"_1", "_2"}) {
        test::put_painted_object(folder.path(), {category, category + number, hue}, 16);
        hue += 20;
      }
    }
    test::put_painted_object(folder.path(), {"lamp", "lamp_1", 145}, 16);
    TrainingOptions options;
    options.features = {Colour{}};
    options.costs_s = {0.5};
    options.leave_out = {"lamp_1"};
    options.transition_prior_moves = 0.0;
    dataset = index_dataset(folder.path());
    model = train_recognition(dataset, options, {.threads = 2});
  }
  support::TemporaryDirectory folder;
  DatasetIndex dataset;
  RecognitionModel model;
};

const PaintedBlocks& painted_blocks() {
  static const PaintedBlocks blocks;
  return blocks;
}

/// A single view each, and nothing beside.
RecognitionStudyOptions plain_study_options() {
  RecognitionStudyOptions options;
  options.starts = 12;
  options.methods = {kSingleView};
  options.literal = false;
  return options;
}

RecognitionStudy painted_study(const RecognitionStudyOptions& options) {
  return run_recognition_study(painted_blocks().model, painted_blocks().dataset, options,
                               {.threads = 2});
}

TEST(PaintedStudy, TriesEveryMethodFromTheSameStarts) {
  RecognitionStudyOptions options = plain_study_options();
  options.literal = options.combinations = options.baselines = options.reliability = true;
  options.recogniser.features = {"colour"};  // all that there is
  options.unknown_starts = 10;
  const RecognitionStudy study = painted_study(options);
  EXPECT_EQ(study.threads, 2);
  EXPECT_EQ(study.options.starts, 12);
  EXPECT_EQ(study.states.objects.size(), 6U);
  EXPECT_TRUE(study.changes.empty());
  std::vector<std::string> names;
  for (const MethodTrials& method : study.methods) {
    names.push_back(method.method);
    ASSERT_EQ(method.trials.size(), 12U) << method.method;
    for (std::size_t i = 0; i < 12; ++i) {
      EXPECT_EQ(method.trials[i].name, study.methods[0].trials[i].name) << method.method;
    }
  }
  const std::string several = "mutual_information, all features; ";
  const std::string single = std::string(kSingleView) + "; ";
  EXPECT_THAT(names, ElementsAre(kSingleView, single + "psi calibrated", several + "psi calibrated",
                                 single + "psi calibrated, views counted whole",
                                 several + "psi calibrated, views counted whole",
                                 single + "psi as published", several + "psi as published",
                                 "only colour", "literal, psi 1", "literal, published psi",
                                 "nearest neighbour", "linear_svm", "kernel_svm"));
  EXPECT_FALSE(study.methods[0].drawn_as);
  EXPECT_EQ(study.methods[3].drawn_as, "psi calibrated, views counted whole");
  EXPECT_FALSE(study.methods[3].several_views);
  EXPECT_TRUE(study.methods[4].several_views);
  for (const std::size_t i : {0U, 1U, 3U, 5U, 8U, 9U}) {
    EXPECT_EQ(study.methods[i].trials[0].observations, 1) << names[i];
  }
}

/// The videos 1 and 4 show every tested view as it is, so its nearest neighbour is of its object.
TEST(PaintedStudy, BaselinesLearnFromWhatIsNotTested) {
  RecognitionStudyOptions options = plain_study_options();
  options.baselines = true;
  options.unknown_starts = 1;  // so that the lamp is no start of the others
  const RecognitionStudy study = painted_study(options);
  ASSERT_EQ(study.methods.size(), 4U);
  EXPECT_FALSE(study.methods[0].label_only);
  EXPECT_EQ(study.methods[1].method, "nearest neighbour");
  EXPECT_TRUE(study.methods[1].label_only);
  for (const Trial& trial : study.methods[1].trials) {
    EXPECT_TRUE(trial.correct) << trial.name;
    EXPECT_EQ(trial.estimate, trial.object);
  }
  DatasetIndex tested = painted_blocks().dataset;
  std::erase_if(tested.views, [](const ViewEntry& view) { return view.name.video != 2; });
  EXPECT_THROW(run_recognition_study(painted_blocks().model, tested, options, {}), ConfigError);
  const RecognitionStudy given =
      run_recognition_study(painted_blocks().model, tested, options, {}, painted_blocks().dataset);
  EXPECT_EQ(given.methods.size(), 4U) << "by what is given to learn from";
}

TEST(PaintedStudy, ShowsUnknownObjectsWhereTheyAreAskedFor) {
  RecognitionStudyOptions options = plain_study_options();
  options.starts = 40;
  options.unknown_starts = 10;
  const RecognitionStudy asked = painted_study(options);
  const UnknownTrials& unknown = asked.methods[0].unknown;
  ASSERT_EQ(unknown.trials.size(), 10U);
  EXPECT_EQ(unknown.category_known, std::vector<bool>(10, false));
  EXPECT_GE(std::ranges::count_if(unknown.trials, &Trial::correct), 7);
  for (const Trial& trial : unknown.trials) {
    EXPECT_EQ(trial.name, "lamp_1");
    EXPECT_EQ(trial.object, -1);
  }
  const auto lamps = [](const RecognitionStudy& study) {
    return std::ranges::count(study.methods[0].trials, "lamp_1", &Trial::name);
  };
  EXPECT_EQ(lamps(asked), 0);
  EXPECT_GE(std::ranges::count_if(asked.methods[0].trials, &Trial::correct), 30);
  options.unknown_starts = 0;
  const RecognitionStudy not_asked = painted_study(options);
  EXPECT_GT(lamps(not_asked), 0) << "one of seven objects";
  EXPECT_TRUE(not_asked.methods[0].unknown.trials.empty());
}

/// By five choices of views: unchanged, another object, turned.
TEST(PaintedStudy, ChangesAreOfKnownObjectsAlone) {
  RecognitionStudyOptions options = plain_study_options();
  options.starts = options.change_starts = 24;  // the same ones
  const RecognitionStudy study = painted_study(options);
  ASSERT_EQ(study.changes.size(), 15U);
  const auto of_lamp = std::ranges::count(study.methods[0].trials, -1, &Trial::object);
  for (const ChangeTrials& change : study.changes) {
    EXPECT_EQ(change.trials.size() + static_cast<std::size_t>(of_lamp), 24U) << change.method;
  }
}

TEST(PaintedStudy, SaysWhatCannotBeStudied) {
  const auto refusal = [](const RecognitionStudyOptions& options) {
    try {
      static_cast<void>(painted_study(options));
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  RecognitionStudyOptions options = plain_study_options();
  options.methods = {kSingleView, "guessing"};
  EXPECT_THAT(refusal(options),
              HasSubstr("methods: unknown 'guessing'; known: single view, all features; "));
  options = plain_study_options();
  options.starts = 0;
  EXPECT_THAT(refusal(options), HasSubstr("starts"));
  options = plain_study_options();
  options.unknown_starts = 1;
  options.unknown_of_dataset = false;
  EXPECT_THAT(refusal(options), HasSubstr("there is no object that the model does not know"));
  options.unknown_datasets = {painted_blocks().folder.path().string()};
  EXPECT_THAT(refusal(options), HasSubstr("the model knows cup_1"));
  options.unknown_datasets.clear();
  options.recogniser.unknown_prior = 0.0;
  EXPECT_THAT(refusal(options), HasSubstr("recogniser.unknown_prior is 0"));
  options = plain_study_options();
  options.recognition.views.weight_per_s = 0.5;
  EXPECT_THAT(refusal(options), HasSubstr("recognition.views.weight_per_s"));
}

/// Those that a study has of its own.
struct OwnStudyOptions : RecognitionStudyOptions {
  void fields(auto&& f) {
    RecognitionStudyOptions::fields(
        [&](std::string_view key, auto& value, std::string_view text, const Range& range = {}) {
          if constexpr (!HasFields<std::remove_cvref_t<decltype(value)>>) {
            f(key, value, text, range);
          }
        });
  }
};

TEST(RecognitionStudyOptionNumbers, AreThoseThatAreTold) {
  support::expect_numbers(OwnStudyOptions{}, {{"seed", 1},
                                              {"starts", 2000, at_least(1)},
                                              {"video", 2, between(1, 4)},
                                              {"literal", 1.0},
                                              {"combinations", 0.0},
                                              {"baselines", 0.0},
                                              {"change_starts", 0, at_least(0)},
                                              {"reliability", 0.0},
                                              {"unknown_starts", 0, at_least(0)},
                                              {"unknown_of_dataset", 1.0}});
}

/// By a box that all have alike, and by colour, which tells them apart unless its psi is 0.
TEST(PaintedStudy, ByPsiOfItsOwnItDoesNotDependOnTheModelsPsi) {
  TrainingOptions training;
  training.features = {BoundingBox{}, Colour{}};
  training.costs_s = {0.5, 0.5};
  training.leave_out = {"lamp_1"};
  training.transition_prior_moves = 0.0;
  RecognitionModel model = train_recognition(painted_blocks().dataset, training, {.threads = 2});
  RecognitionStudyOptions options = plain_study_options();
  options.literal = true;
  const auto estimates_by = [&](double psi_of_colour) {
    model.features[1].psi = psi_of_colour;
    const RecognitionStudy study =
        run_recognition_study(model, painted_blocks().dataset, options, {.threads = 2});
    EXPECT_EQ(study.methods[1].method, "literal, psi 1");
    EXPECT_EQ(study.methods[2].method, "literal, published psi");
    std::vector<std::pair<int, double>> estimates;
    for (const std::size_t i : {1U, 2U}) {
      for (const Trial& trial : study.methods[i].trials) {
        EXPECT_EQ(trial.features, 2) << "all of them";
        estimates.emplace_back(trial.estimate, trial.probability);
      }
    }
    return estimates;
  };
  EXPECT_EQ(estimates_by(0.0), estimates_by(3.0));
}

TEST(PaintedStudy, UnknownObjectsMayBeOfFurtherDatasets) {
  const support::TemporaryDirectory further;
  test::put_painted_object(further.path(), {"vase", "vase_1", 165}, 16);
  RecognitionStudyOptions options = plain_study_options();
  options.unknown_starts = 20;
  options.unknown_datasets = {further.path().string()};
  const auto shown = [&](const char* name) {
    const RecognitionStudy study = painted_study(options);
    return std::ranges::count(study.methods[0].unknown.trials, name, &Trial::name);
  };
  EXPECT_GT(shown("lamp_1"), 0);
  EXPECT_GT(shown("vase_1"), 0);
  options.unknown_of_dataset = false;
  EXPECT_EQ(shown("lamp_1"), 0);
  EXPECT_EQ(shown("vase_1"), 20);
}

TEST(PaintedStudy, WithoutUnknownObjectsNoHypothesisOfThemIsNeeded) {
  RecognitionStudyOptions options = plain_study_options();
  options.recogniser.unknown_prior = 0.0;
  const RecognitionStudy study = painted_study(options);
  EXPECT_EQ(study.methods.at(0).trials.size(), 12U);
  EXPECT_TRUE(study.methods[0].unknown.trials.empty());
}

/// By maximum-likelihood variances, a psi of 1 and without unknown objects.
TEST(PaintedStudy, TheLiteralSettingIsASingleViewOfAPlainModel) {
  RecognitionStudyOptions options = plain_study_options();
  options.literal = true;
  const RecognitionStudy study = painted_study(options);
  RecognitionModel plain = painted_blocks().model;
  for (FeatureModel& feature : plain.features) feature.psi = 1.0;
  options.literal = false;
  options.recogniser.variance = LiteralVariance{};
  options.recogniser.unknown_prior = 0.0;
  const RecognitionStudy by_hand =
      run_recognition_study(plain, painted_blocks().dataset, options, {.threads = 2});
  ASSERT_EQ(study.methods.at(1).method, "literal, psi 1");
  for (std::size_t i = 0; i < 12; ++i) {
    const Trial& trial = study.methods[1].trials.at(i);
    const Trial& other = by_hand.methods.at(0).trials.at(i);
    EXPECT_EQ(trial.estimate, other.estimate) << i;
    EXPECT_DOUBLE_EQ(trial.probability, other.probability) << i;
    EXPECT_DOUBLE_EQ(trial.entropy_bits, other.entropy_bits) << i;
  }
}

TEST(PaintedStudy, ChangesOfUnknownObjectsAreNotStudied) {
  DatasetIndex lamps = painted_blocks().dataset;
  std::erase_if(lamps.views, [](const ViewEntry& view) { return view.name.object != "lamp_1"; });
  RecognitionStudyOptions options = plain_study_options();
  options.change_starts = 2;
  try {
    static_cast<void>(run_recognition_study(painted_blocks().model, lamps, options, {}));
    ADD_FAILURE() << "no error";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("change_starts: needs two objects"));
  }
}

}  // namespace
}  // namespace vantage
