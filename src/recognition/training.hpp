/// Learns to recognise the objects of a dataset from its views.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/belief/objects/recognition_model.hpp"
#include "vantage/belief/observation/psi_rule.hpp"
#include "vantage/recognition/dataset/held_out.hpp"
#include "vantage/recognition/dataset/view_features.hpp"

namespace vantage {

struct TrainingOptions {
  std::uint64_t seed = 1;
  std::vector<Feature> features{Colour{}, BoundingBox{}, Sift{}, Vfh{}};
  std::vector<double> costs_s = {};
  std::vector<int> videos{1, 4};
  std::vector<std::string> recordings;
  int bins = 0;
  int feature_views = 1000;
  HeldOut held_out = HeldOutAuto{};
  VarianceEstimate variance = ShrunkVariance{};
  PsiRule psi = CalibratedPsi{};
  /// The transition is learnt from walks round the training views.
  double transition_prior_moves = 100.0;
  bool unknown = true;
  std::vector<std::string> leave_out;
  void fields(auto&& f) {
    f("seed", seed, "seed of every random stream; the same seed gives the same model");
    f("features", features, "features to learn, each a name or a name with options");
    f("costs_s", costs_s,
      "time to extract each of `features` from a view, in their order, that views and features are "
      "chosen by where cost counts; empty: as measured in training, never twice the same",
      above(0.0));
    f("videos", videos,
      "videos of a turntable dataset to train on: 1, 2 and 4 are recorded from 30, 45 and 60 deg "
      "of elevation; of imported pictures see `recordings`",
      between(1, 4));
    f("recordings", recordings,
      "names of the recordings of imported pictures to train on; empty: all");
    f("bins", bins,
      "number of yaw bins of an object; more tell poses apart better, with fewer views each; 0: as "
      "the pictures were imported, else 8",
      between(0, 3600));
    f("feature_views", feature_views,
      "number of views, drawn at random, that features are learnt from; higher is slower",
      at_least(2));
    f("held_out", held_out, "which views are held out of training to calibrate psi");
    f("variance", variance, "estimate of the variances that psi is calibrated for");
    f("psi", psi, "rule for psi, the exponent that says how far a feature's density is trusted");
    f("transition_prior_moves", transition_prior_moves,
      "number of moves that the initial transition, `rigid`, is worth when one is learnt in "
      "training; higher learns more slowly; 0: none is learnt",
      at_least(0.0));
    f("unknown", unknown,
      "true: also learnt is what objects look like that are none of these, and how far views of "
      "one "
      "object repeat each other; false: every object is held to be one of the model's");
    f("leave_out", leave_out,
      "names of objects of the dataset that are not learnt, so that `evaluate` can show them as "
      "unknown ones");
  }
  void check() const;  ///< features and videos: some, of different names and numbers; all costs
};

/// The part of training that takes longest, as LongWork tells it.
inline constexpr std::string_view kExtractingFeatures = "extracting features";

/// What is held out to choose psi is trained on as well once psi is chosen. The same for any number
/// of threads, but for the features' measured cost.
/// @throws ConfigError if `options` are out of range; InputError if a view is bad or there are too
/// few of them; what `how.poll` throws.
RecognitionModel train_recognition(const DatasetIndex& dataset, const TrainingOptions& options,
                                   const LongWork& how);

/// Adds the objects of another dataset; features, psi and the objects known before stay as they
/// are. Of `options`, `videos`, `recordings` and `leave_out` count.
/// @throws InputError also if an object of that name is known already.
void extend_recognition(RecognitionModel& model, const DatasetIndex& dataset,
                        const TrainingOptions& options, const LongWork& how);

}  // namespace vantage
