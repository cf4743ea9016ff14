/// A network of the user's own as a feature.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/perception/features/kit/feature_result.hpp"
#include "vantage/perception/features/kit/pca.hpp"
#include "vantage/perception/features/kit/state_bytes.hpp"
#include "vantage/perception/object_view.hpp"

namespace vantage {

class TrainedOnnx;

/// Output of an ONNX network for the masked crop, L2-normalised, its principal components. Input:
/// 1 x 3 x 224 x 224, RGB in 0 .. 1 less ImageNet's means over its deviations, zero beside the
/// object, the crop's longer side filling the square; output: any shape, always the same.
struct Onnx {
  static constexpr std::string_view name = "onnx";
  static constexpr StrategyText text{
      .summary =
          "Output of an ONNX network of your own for the masked crop of the object, reduced to "
          "principal components.",
      .formula = "principal components of y / |y|, y the output of the network"};
  std::string file;
  int components = 256;
  int training_views = 2000;
  void fields(auto&& f) {
    f("file", file, "path of the ONNX network");
    f("components", components,
      "number of principal components that are kept, n - 1 at most of n training views; higher "
      "keeps more of the output",
      between(1, 100000));
    f("training_views", training_views,
      "number of views, drawn at random, that principal components are learnt from; higher takes "
      "longer",
      at_least(2));
  }

  static constexpr int side_px = 224;

  /// @throws InputError naming the file if it is no network, does not take such an input or gives
  /// nothing that can be used; also if fewer than two views can be used.
  [[nodiscard]] TrainedOnnx train(std::span<const ObjectView> views, Rng& rng) const;
  static TrainedOnnx take_state(ByteReader& reader);
};

/// A loaded network. Copies share it; it computes for one of them at a time.
class OnnxNetwork {
 public:
  /// @param file for messages
  /// @throws InputError naming the file.
  OnnxNetwork(std::string bytes, std::string file);
  /// Output, flattened.
  /// @param input 3 * 224 * 224 numbers, channel by channel
  /// @throws InputError naming the file.
  [[nodiscard]] Eigen::VectorXf compute(const Eigen::VectorXf& input) const;
  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  struct Impl;
  std::string bytes_;
  std::string file_;
  std::shared_ptr<Impl> impl_;
};

/// Holds the network itself, so that it works without the file.
class TrainedOnnx {
 public:
  TrainedOnnx(OnnxNetwork network, Pca pca) : network_(std::move(network)), pca_(std::move(pca)) {}
  [[nodiscard]] std::string_view feature_name() const { return Onnx::name; }
  [[nodiscard]] int dimension() const { return static_cast<int>(pca_.axes.cols()); }
  [[nodiscard]] FeatureResult extract(const ObjectView& view) const;
  void put_state(std::string& bytes) const;

 private:
  OnnxNetwork network_;
  Pca pca_;
};

}  // namespace vantage
