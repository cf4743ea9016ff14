/// Views kept from training, and how likely models of the other views find them.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "vantage/belief/objects/psi_rule.hpp"
#include "vantage/belief/objects/recognition_model.hpp"
#include "vantage/recognition/dataset/view_features.hpp"

namespace vantage {

/// A share of the views, drawn at random: of the sessions that are trained on.
struct HeldOutShare {
  static constexpr std::string_view name = "share";
  double share = 0.2;
  void fields(auto&& f) {
    f("share", share, "(0, 1); higher calibrates better but for a poorer model",
      between(0.01, 0.9));
  }
};

/// Each video in turn, by a model of the others: another session, with other light and elevation.
struct HeldOutVideos {
  static constexpr std::string_view name = "videos";
  void fields(auto&&) {}
};

using HeldOut = std::variant<HeldOutShare, HeldOutVideos>;
template <>
inline constexpr std::string_view strategy_family<HeldOut> = "held out";

struct HoldOutOptions {
  HeldOut held_out;
  VarianceEstimate variance;
  std::uint64_t seed = 1;
};

/// What a psi rule may look at.
struct Calibration {
  std::vector<ObservationModel> models;  ///< one a feature
  HeldOutViews held_out;                 ///< at most 4000 views, drawn at random
};

/// @param shown the state of each view
/// @param model features and states; nothing it was trained on matters
/// @throws InputError if nothing is left to train a feature on.
Calibration hold_out(std::span<const ViewFeatures> views, std::span<const int> shown,
                     const RecognitionModel& model, const HoldOutOptions& options,
                     const LongWork& how);

}  // namespace vantage
