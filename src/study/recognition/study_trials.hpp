/// The trials of one method in a study, of known and of unknown objects.
#pragma once

#include <span>
#include <vector>

#include "vantage/study/recognition/recognition_study.hpp"

namespace vantage {

/// The views of a dataset parted by whether the model knows the object.
struct PartedViews {
  DatasetIndex known;
  DatasetIndex unknown;
};
PartedViews parted(const DatasetIndex& dataset, const ObjectStates& states);

/// Objects that the model does not know; without starts they were not asked for.
struct UnknownViews {
  TestViews test;
  std::vector<Start> starts;
};
/// @param of_dataset those of the dataset that is tested
/// @throws ConfigError if there are none, or the model knows an object of `unknown_datasets`.
UnknownViews unknown_views(DatasetIndex of_dataset, const RecognitionModel& model,
                           const RecognitionStudyOptions& options, const LongWork& how);

/// What the trials of one recogniser need.
struct Trials {
  const TestViews& test;
  const std::vector<Start>& starts;
  const UnknownViews& unknown;
  const RecognitionStudyOptions& options;
  const LongWork& how;
};

/// As log_likelihoods(), of the unknown objects; nothing if they were not asked for.
std::vector<Eigen::MatrixXf> unknown_likelihoods(const Recogniser& recogniser,
                                                 const Trials& trials);
/// @param of_unknown unknown_likelihoods(); none if the recogniser has no hypothesis of them
MethodTrials trials_of(const Recogniser& recogniser, const Method& method,
                       std::span<const Eigen::MatrixXf> likelihoods,
                       std::span<const Eigen::MatrixXf> of_unknown, const Trials& trials);

}  // namespace vantage
