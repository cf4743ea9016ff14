/// Active recognition of one object: look, extract features while they are worth it, choose the
/// next view, until it is sure enough.  [Potthast2016, figure 4.1]
///
/// Who moves the camera is the caller's business: a dataset that is leafed through, or a robot.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vantage/belief/objects/object_belief.hpp"
#include "vantage/belief/objects/transition.hpp"
#include "vantage/planners/objects/feature_choice.hpp"
#include "vantage/planners/objects/object_view_choice.hpp"
#include "vantage/recognition/recogniser.hpp"

namespace vantage {

struct RecognitionOptions {
  FeatureChoice features;
  bool all_features = false;
  ObjectViewOptions views;
  EnoughViews enough;
  TransitionModel transition = RigidTransition{};
  int max_views = 8;
  void fields(auto&& f) {
    f("features", features, "which features are extracted from a view, and when that is enough");
    f("all_features", all_features,
      "true: every feature is extracted from a view instead of choosing");
    f("views", views, "which view is taken next");
    f("enough", enough, "stopping criterion: when no further view is taken");
    f("transition", transition, "how the belief changes when the camera moves round the object");
    f("max_views", max_views,
      "greatest number of views, after which recognition ends whether sure or not",
      between(1, 1000));
  }
};

/// @throws ConfigError naming the option that asks for a feature that the recogniser has not, or
/// gives the slips of another number of yaw bins.
void require_fits(const RecognitionOptions& options, const Recogniser& recogniser);

/// A feature as a view gives it, and the time that took.
struct ExtractedFeature {
  FeatureResult result;
  double time_s = 0.0;
  /// Of every state, psi included, where the caller has it from before; empty: of `result`.
  Eigen::VectorXd log_likelihood = {};
  bool place_seen = true;  ///< whether the view shows where the object is to be, empty or not
};
/// Extracts the feature of that index from the view at hand.
using ExtractFeature = std::function<ExtractedFeature(std::size_t feature)>;

/// Extracts from `view`, which must outlive the result, and takes the time.
ExtractFeature extract_from(const Recogniser& recogniser, const ObjectView& view);

struct SkippedFeature {
  std::string feature;
  std::string reason;
};

/// What one view told.
struct ViewReport {
  double view_rad = 0.0;              ///< bearing of the camera round the object, as commanded
  std::vector<std::string> features;  ///< that were extracted, in order
  std::vector<SkippedFeature> skipped;
  double entropy_bits = 0.0;  ///< of the state, after the view
  double feature_time_s = 0.0;
  double selection_time_s = 0.0;  ///< to choose the features
  double view_time_s = 0.0;       ///< to choose this view: NextView::time_s, put in by who moves
};

/// What is known of the object so far.
struct Recognition {
  ObjectBelief belief;
  std::vector<ViewReport> views;
};

/// Nothing seen yet; states that no view can be of have no probability.
Recognition begin_recognition(const Recogniser& recogniser);

/// What the next view counts: views repeat each other, but for those that told nothing.
double next_view_weight(const Recogniser& recogniser, const Recognition& recognition);
/// To the power of `weight`; 0 * -inf, which only a weight of 0 gives, is NaN and left out by
/// update().
Eigen::VectorXd weighted(Eigen::VectorXd log_likelihood, double weight);

/// Measurement update with a view from where the camera is: chooses features, extracts and applies
/// them, and appends a report to `recognition.views`. A feature that cannot be extracted, or that
/// the belief cannot be reconciled with, is reported as skipped and not tried again at this view.
void update_with_view(const Recogniser& recogniser, const RecognitionOptions& options,
                      const ExtractFeature& extract, double view_rad, Recognition& recognition,
                      Rng& rng);

/// Why no further view is taken, if so.
enum class RecognitionEnd { sure, max_views };
std::optional<RecognitionEnd> recognition_end(const Recogniser& recogniser,
                                              const RecognitionOptions& options,
                                              const Recognition& recognition);

/// How probable it is that, after such a turn, a known object shows a side that the model has no
/// view of, given that it is a known one; 0 if it cannot be one.
double p_unseen_side(const Recogniser& recogniser, const RecognitionOptions& options,
                     const Recognition& recognition, double motion_rad);

/// Which of `actions` to take next, and how long the choice took. The belief is not changed.
struct NextView {
  ObjectViewDecision decision;
  double time_s = 0.0;
};
NextView next_view(const Recogniser& recogniser, const RecognitionOptions& options,
                   const Recognition& recognition, std::span<const ObjectViewAction> actions,
                   Rng& rng);

/// Prediction: the camera turned about the object by `motion_rad`, counter-clockwise seen from
/// above: the object's yaw, as the camera sees it, is less by as much, and what is believed of it
/// follows.
void predict_motion(const Recogniser& recogniser, const RecognitionOptions& options,
                    double motion_rad, Recognition& recognition);

/// A camera that can be turned about an object.
struct ObjectCamera {
  ExtractFeature extract;                                    ///< from the view where it is
  std::function<double()> bearing_rad;                       ///< where that is
  std::function<std::vector<ObjectViewAction>()> actions;    ///< at least one, or there is no next
  std::function<void(const ObjectViewAction& action)> turn;  ///< to there
};

/// The loop: look, choose and extract features, choose a view, turn, until it ends.
/// @throws ConfigError if `options` are out of range.
Recognition recognise(const Recogniser& recogniser, const RecognitionOptions& options,
                      const ObjectCamera& camera, Rng& rng);

}  // namespace vantage
