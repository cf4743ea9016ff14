/// Views kept from training, and how likely models of the other views find them.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "vantage/belief/objects/recognition_model.hpp"
#include "vantage/belief/observation/observation_model.hpp"
#include "vantage/belief/observation/psi_rule.hpp"
#include "vantage/recognition/dataset/view_features.hpp"

namespace vantage {

struct HeldOutShare {
  static constexpr std::string_view name = "share";
  static constexpr StrategyText text{.summary =
                                         "Holds out a share of the views, drawn at random, of the "
                                         "same recordings that are trained on."};
  double share = 0.2;
  void fields(auto&& f) {
    f("share", share,
      "share of the training views that is held out; higher calibrates better, but for a poorer "
      "model",
      between(0.01, 0.9));
  }
};

struct HeldOutVideos {
  static constexpr std::string_view name = "videos";
  static constexpr StrategyText text{
      .summary =
          "Holds out each video in turn and trains on the others: another recording, with other "
          "light and elevation. Needs two videos or more."};
  void fields(auto&&) {}
};

struct HeldOutRecordings {
  static constexpr std::string_view name = "recordings";
  static constexpr StrategyText text{
      .summary =
          "Holds out each recording in turn, that is each video of each folder, and trains on the "
          "others: other rooms and light. Needs two recordings or more."};
  void fields(auto&&) {}
};

struct HeldOutAuto {
  static constexpr std::string_view name = "auto";
  static constexpr StrategyText text{
      .summary =
          "By recordings, as `recordings` has it, if pictures were imported from two or more; else "
          "by share, as `share` has it."};
  double share = 0.2;
  void fields(auto&& f) {
    f("share", share,
      "share of the training views that is held out where it is not by recordings; higher "
      "calibrates better, but for a poorer model",
      between(0.01, 0.9));
  }
};

using HeldOut = std::variant<HeldOutShare, HeldOutVideos, HeldOutRecordings, HeldOutAuto>;
template <>
inline constexpr std::string_view strategy_family<HeldOut> = "held out";

struct HoldOutOptions {
  HeldOut held_out;  ///< not `auto`
  VarianceEstimate variance;
  std::uint64_t seed = 1;
  /// States without a view are impossible, as unseen_states() has it, and objects without one are
  /// not asked for.
  bool only_seen = false;
};

/// Log density of a state without a view, with HoldOutOptions::only_seen.
inline constexpr auto kRuledOut = static_cast<float>(kRulesOut);

/// Views held out of the same models.
struct CalibrationFold {
  std::vector<ObservationModel> models;  ///< one a feature, of the views that are not held out
  Eigen::Index first = 0;                ///< of HeldOutViews, and how many
  Eigen::Index count = 0;
};

/// What psi rules and the calibration of unknown objects may look at.
struct Calibration {
  std::vector<CalibrationFold> folds;  ///< at least one
  HeldOutViews held_out;               ///< at most 4000 views, drawn at random
  std::vector<std::size_t> view;       ///< of each view held out, its index
};

/// @param shown the state of each view
/// @param model features and states; nothing it was trained on matters
/// @throws InputError if nothing is left to train a feature on.
Calibration hold_out(std::span<const ViewFeatures> views, std::span<const int> shown,
                     const RecognitionModel& model, const HoldOutOptions& options,
                     const LongWork& how);

}  // namespace vantage
