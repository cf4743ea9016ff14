/// Recognition over a dataset: every method from the same starts, in the form of the published
/// tables.  [Potthast2016, tables 4.2-4.7, 4.10-4.15]
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vantage/information/resampling.hpp"
#include "vantage/recognition/evaluation/change_evaluation.hpp"
#include "vantage/recognition/evaluation/evaluation.hpp"
#include "vantage/study/recognition/reliability.hpp"
#include "vantage/study/recognition/unknown_detection.hpp"

namespace vantage {

/// One view, with every feature.
inline constexpr auto kSingleView = "single view, all features";

struct RecognitionStudyOptions {
  std::uint64_t seed = 1;
  int starts = 2000;
  int video = 2;
  std::vector<std::string> recordings;
  RecogniserOptions recogniser;
  RecognitionOptions recognition;
  std::vector<std::string> methods;
  bool literal = true;
  bool combinations = false;
  bool baselines = false;
  int change_starts = 0;
  bool reliability = false;
  int unknown_starts = 0;
  bool unknown_of_dataset = true;
  std::vector<std::string> unknown_datasets;
  void fields(auto&& f) {
    f("seed", seed, "seed of starts, choices and confidence intervals");
    f("starts", starts, "number of trials of each method; more make confidence intervals narrower",
      at_least(1));
    f("video", video,
      "video of a turntable dataset to test on: 1, 2 and 4 are recorded from 30, 45 and 60 deg of "
      "elevation; of imported pictures see `recordings`",
      between(1, 4));
    f("recordings", recordings,
      "names of the recordings of imported pictures to test on; empty: all");
    f("recogniser", recogniser,
      "which features of the model are used, and how its variances are estimated");
    f("recognition", recognition, "options of recognition that all methods share");
    f("methods", methods, "names of the methods to evaluate, such as `random`; empty: all");
    f("literal", literal,
      "true: also a single view with maximum-likelihood variances, by psi 1 and by psi as "
      "published");
    f("combinations", combinations, "true: also a single view by every combination of features");
    f("baselines", baselines,
      "true: also the nearest neighbour and support vector machines, which take long to train");
    f("change_starts", change_starts,
      "number of trials of change detection for each scenario and method; 0: none", at_least(0));
    f("reliability", reliability,
      "true: also a single view and several, by psi as published, and with every view counted "
      "whole, beside which the probabilities of the model's own are drawn");
    f("unknown_starts", unknown_starts,
      "number of trials of each method that show objects that the model does not know; 0: none, "
      "and such objects of the dataset count for their category alone",
      at_least(0));
    f("unknown_of_dataset", unknown_of_dataset,
      "true: objects of the dataset that the model was not trained on are shown as unknown ones; "
      "false: they are left out");
    f("unknown_datasets", unknown_datasets,
      "folders of views of further objects that the model does not know");
  }
  void check() const;  ///< no weight of what motions cost: those in a dataset cost nothing
};

struct MethodTrials {
  std::string method;
  std::vector<Trial> trials;  ///< one a start
  /// A classifier tells an object and nothing else: no pose, no entropy, no cost.
  bool label_only = false;
  UnknownTrials unknown = {};  ///< of objects that the model does not know; none: not asked for
  /// In the figure of reliability, and by several views or one; none: it is not drawn.
  std::optional<std::string> drawn_as = {};
  bool several_views = false;
};

struct RecognitionStudy {
  RecognitionStudyOptions options;
  ObjectStates states;
  std::vector<MethodTrials> methods;
  std::vector<ChangeTrials> changes;
  int threads = 1;  ///< it ran on; times depend on them, nothing else
};

/// @throws ConfigError if `options` are out of range; InputError as read_test_views().
/// @param training what the baselines are trained on; empty: what the dataset has beside the views
/// that are tested
RecognitionStudy run_recognition_study(const RecognitionModel& model, const DatasetIndex& dataset,
                                       const RecognitionStudyOptions& options, const LongWork& how,
                                       const DatasetIndex& training = {});

/// NaN of nothing, which JSON has as null.
struct Estimate {
  double mean = 0.0;
  Interval interval;  ///< 95 %, resampling whole objects
};

/// To another method, from the same starts.
struct PairedEstimate {
  std::string reference;
  Estimate accuracy_percent;
  Estimate observations;
  double p_value = 1.0;  ///< of the accuracy, sign-flip test
};

struct MethodSummary {
  std::string method;
  Estimate accuracy_percent;  ///< of objects that the model knows
  double category_percent = 0.0;
  Interval category_interval = {};
  Estimate observations;
  // Nothing of a method that tells labels only:
  std::optional<Estimate> bin_error = {};
  std::optional<double> features = {};  ///< extracted, a trial; so are the times
  std::optional<double> feature_time_s = {};
  std::optional<double> selection_time_s = {};
  std::optional<double> view_time_s = {};
  std::vector<PairedEstimate> differences = {};  ///< to random views and the single view
  std::optional<Reliability> reliability = {};
  std::optional<UnknownDetection> unknown = {};
};
std::vector<MethodSummary> summaries(const RecognitionStudy& study);

/// Makes the folder of write_recognition_study().
/// @throws ConfigError if it holds one and `overwrite` is not set, OutputError
void prepare_recognition_study(const std::filesystem::path& directory, bool overwrite);

/// config.yaml, results.csv (a row a trial), changes.csv, summary.json, recognition.md, and with
/// `reliability` reliability.svg and reliability.csv.
/// @throws OutputError
void write_recognition_study(const RecognitionStudy& study, const std::filesystem::path& directory);

/// The tables, as Markdown.
std::string recognition_tables(const RecognitionStudy& study);

}  // namespace vantage
