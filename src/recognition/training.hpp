/// Learns to recognise the objects of a dataset from its views.
#pragma once

#include <cstdint>
#include <vector>

#include "vantage/belief/objects/psi_rule.hpp"
#include "vantage/belief/objects/recognition_model.hpp"
#include "vantage/recognition/dataset/held_out.hpp"
#include "vantage/recognition/dataset/view_features.hpp"

namespace vantage {

struct TrainingOptions {
  std::uint64_t seed = 1;
  std::vector<Feature> features{Colour{}, BoundingBox{}, Sift{}, Vfh{}};
  std::vector<int> videos{1, 4};
  int bins = 8;
  int feature_views = 1000;
  HeldOut held_out = HeldOutShare{};
  VarianceEstimate variance = ShrunkVariance{};
  PsiRule psi = CalibratedPsi{};
  double transition_prior_moves = 100.0;
  void fields(auto&& f) {
    f("seed", seed, "of every random stream");
    f("features", features, "@@");
    f("videos", videos, "to train on: 1, 2, 4 are 30, 45, 60 deg", between(1, 4));
    f("bins", bins, "of yaw, an object; more tell poses better, with fewer views",
      between(2, 3600));
    f("feature_views", feature_views, "drawn at random, that features learn from; higher is slower",
      at_least(2));
    f("held_out", held_out, "@@");
    f("variance", variance, "that psi is calibrated for");
    f("psi", psi, "@@");
    f("transition_prior_moves", transition_prior_moves,
      "Moves that the start, `rigid`, is worth to a transition learnt from walks round the "
      "training views; higher learns slower, 0: none is learnt.",
      at_least(0.0));
  }
  void check() const;  ///< features and videos: some, of different names and numbers
};

/// What is held out to choose psi is trained on as well once psi is chosen. The same for any number
/// of threads, but for the features' measured cost.
/// @throws ConfigError if `options` are out of range; InputError if a view is bad or there are too
/// few of them; what `how.poll` throws.
RecognitionModel train_recognition(const DatasetIndex& dataset, const TrainingOptions& options,
                                   const LongWork& how);

/// Adds the objects of another dataset; features, psi and the objects known before stay as they
/// are. Of `options`, only `videos` counts.
/// @throws InputError also if an object of that name is known already.
void extend_recognition(RecognitionModel& model, const DatasetIndex& dataset,
                        const TrainingOptions& options, const LongWork& how);

}  // namespace vantage
