/// Features of objects: what a recogniser extracts from a view, one at a time, cheap ones first.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "vantage/core/rng.hpp"
#include "vantage/core/strategy.hpp"
#include "vantage/perception/features/bounding_box.hpp"
#include "vantage/perception/features/colour.hpp"
#include "vantage/perception/features/kit/feature_result.hpp"
#include "vantage/perception/features/onnx.hpp"
#include "vantage/perception/features/patches/kernel_descriptor.hpp"
#include "vantage/perception/features/sift.hpp"
#include "vantage/perception/features/soft_colour.hpp"
#include "vantage/perception/features/standing_box.hpp"
#include "vantage/perception/features/vfh.hpp"
#include "vantage/perception/object_view.hpp"

namespace vantage {

/// How to extract a feature. Each has `train(views, rng)`, which gives what extracts it.
using Feature =
    std::variant<Colour, BoundingBox, Sift, Vfh, KernelDescriptor<PatchKind::rgb_gradient>,
                 KernelDescriptor<PatchKind::lbp>, KernelDescriptor<PatchKind::normalised_rgb>,
                 KernelDescriptor<PatchKind::depth_gradient>,
                 KernelDescriptor<PatchKind::depth_lbp>, KernelDescriptor<PatchKind::normal_spin>,
                 KernelDescriptor<PatchKind::size>, Onnx, SoftColour, StandingBox>;
template <>
inline constexpr std::string_view strategy_family<Feature> = "feature";

/// A feature ready to be extracted. Immutable; copies share what was learnt, and may be used from
/// several threads at once.
class TrainedFeature {
 public:
  using State = std::variant<Colour, BoundingBox, Vfh, TrainedSift, TrainedKernelDescriptor,
                             TrainedOnnx, SoftColour, StandingBox>;
  /// @param cost_s time to extract it from one view
  TrainedFeature(State state, double cost_s)
      : state_(std::make_shared<const State>(std::move(state))), cost_s_(cost_s) {}

  [[nodiscard]] std::string_view name() const;
  [[nodiscard]] int dimension() const;                     ///< of every vector it extracts
  [[nodiscard]] double cost_s() const { return cost_s_; }  ///< as measured when it was trained
  [[nodiscard]] FeatureResult extract(const ObjectView& view) const;

  /// The same with another cost.
  [[nodiscard]] TrainedFeature with_cost_s(double cost_s) const;

  /// Of all that decides what it extracts: the cost is not among it.
  [[nodiscard]] std::uint64_t state_hash() const;

  /// In the machine's byte order.
  [[nodiscard]] std::string to_bytes() const;
  /// @param source whose bytes they are, for messages: a file's path
  /// @throws InputError if they are not those of a feature, whole and within range.
  static TrainedFeature from_bytes(std::string_view bytes, const std::string& source);

 private:
  std::shared_ptr<const State> state_;
  double cost_s_;
};

/// Learns what the feature needs and measures its cost: the median time over up to 9 of the views
/// that it can be extracted from, 0 without any. Everything but the cost is the same for the same
/// views and generator.
/// @throws InputError if there is nothing to learn from.
TrainedFeature train_feature(const Feature& feature, std::span<const ObjectView> views, Rng& rng);

}  // namespace vantage
