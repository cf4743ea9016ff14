/// How well objects of a dataset are recognised: the same starts for every method.
/// [Potthast2016, 4.5.5-4.5.6]
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "vantage/recognition/dataset/turntable_views.hpp"
#include "vantage/recognition/recognition.hpp"

namespace vantage {

/// What is leafed through: features are extracted once, whoever asks.
struct TestViews {
  std::vector<ViewFeatures> views;
  std::vector<int> shown;                  ///< state of each view; -1: of an unknown object
  std::vector<int> category;               ///< of each view; kNoCategory: none of the model's
  std::vector<TurntableViews> turntables;  ///< of each object
};

/// Views of imported pictures are fitted to the model: cut as its own were, views by name in its
/// order.
/// @param model for its states, extractors and notes
/// @param recordings of imported pictures; empty: all
/// @throws InputError if the dataset has no view of `video`, or a bad one.
TestViews read_test_views(const DatasetIndex& dataset, const RecognitionModel& model, int video,
                          const LongWork& how, std::span<const std::string> recordings = {});

/// Whether a view shows what the model was trained on.
bool is_known(const TestViews& test, std::size_t view);

/// Where the camera is at first.
struct Start {
  std::size_t turntable = 0;
  std::size_t view = 0;  ///< one of the turntable's
};

/// Any object, then any of its views, each as likely as the other.
std::vector<Start> draw_starts(const TestViews& test, int count, std::uint64_t seed);

/// How a method did from one start.
struct Trial {
  int object = 0;         ///< what it was; -1: nothing that the model was trained on
  int estimate = 0;       ///< what it was held for; object_count() of the states: unknown
  std::string name = {};  ///< of the object
  std::string category = {};
  bool correct = false;
  bool category_correct = false;  ///< of an unknown object, that it is of none of the model's too
  int observations = 0;
  int bin_error = 0;  ///< of the expected yaw at the last view, whatever the object; 0 if unknown
  int features = 0;   ///< extracted, over all views
  double entropy_bits = 0.0;
  double probability = 0.0;          ///< of the estimate
  double unknown_probability = 0.0;  ///< that it is none of the model's objects
  double feature_time_s = 0.0;       ///< the features' measured costs
  double selection_time_s = 0.0;
  double view_time_s = 0.0;
};

/// Of a view of the test that is held for `estimate`, one of the objects or object_count().
Trial judged(const ObjectStates& states, const TestViews& test, std::size_t view, int estimate);
/// Of a view of the test after which that is believed. The category is right if it is the most
/// probable one, or if an object of none of the model's is held to be of none.
Trial judged(const ObjectStates& states, const TestViews& test, std::size_t view,
             const ObjectBelief& belief);

struct Method {
  std::string name;
  RecognitionOptions options;
};

/// Those of the published tables: a single view and several, with all features and with chosen
/// ones, by each choice of views. What they have in common is as in `common`.
std::vector<Method> published_methods(const RecognitionOptions& common);

/// A camera turned about an object of the dataset, by whole bins, to the view nearest to where that
/// leads. Where no view is near, as of objects seen from few sides, by as much as leads to one.
class DatasetCamera {
 public:
  /// @param log_likelihood of each feature, states x views, psi included
  DatasetCamera(const Recogniser& recogniser, const TestViews& test,
                std::span<const Eigen::MatrixXf> log_likelihood, const Start& start);
  [[nodiscard]] ObjectCamera as_object_camera();
  [[nodiscard]] std::size_t view() const { return view_; }  ///< index into the test views

 private:
  [[nodiscard]] ExtractedFeature extract(std::size_t feature) const;
  [[nodiscard]] std::vector<ObjectViewAction> actions() const;
  [[nodiscard]] std::size_t view_after(double turn_rad) const;
  /// From the present view, of the object.
  [[nodiscard]] double turn_to(std::size_t view) const;
  void turn(const ObjectViewAction& action);

  const Recogniser* recogniser_;
  const TestViews* test_;
  std::span<const Eigen::MatrixXf> log_likelihood_;
  std::size_t turntable_;
  std::size_t view_;
  double bearing_rad_ = 0.0;
  std::vector<std::size_t> seen_;
};

/// Of each feature of the recogniser, states x views, psi included; zero where there is no feature.
std::vector<Eigen::MatrixXf> log_likelihoods(const Recogniser& recogniser, const TestViews& test,
                                             const LongWork& how);

/// A trial from each start. The random numbers are a start's own, the same for every method, and
/// results do not depend on the threads.
std::vector<Trial> run_trials(const Recogniser& recogniser, const TestViews& test,
                              std::span<const Eigen::MatrixXf> log_likelihood,
                              std::span<const Start> starts, const Method& method,
                              std::uint64_t seed, const LongWork& how);

}  // namespace vantage
