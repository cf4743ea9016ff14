#include "vantage/perception/features/onnx.hpp"

#include <fmt/format.h>
#include <opencv2/dnn.hpp>

#include <array>
#include <fstream>
#include <mutex>
#include <sstream>

#include "vantage/perception/features/kit/k_means.hpp"
#include "vantage/perception/features/kit/object_pixels.hpp"

namespace vantage {
namespace {

constexpr int kMinPixels = 16;
constexpr std::array<float, 3> kMean{0.485F, 0.456F, 0.406F};
constexpr std::array<float, 3> kDeviation{0.229F, 0.224F, 0.225F};

std::string read_network(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  if (stream) content << stream.rdbuf();
  if (!stream || content.str().empty()) {
    throw InputError(fmt::format("feature onnx: '{}' cannot be read or is empty", file));
  }
  return content.str();
}

/// In the middle of the square; channel by channel.
Eigen::VectorXf network_input(const ObjectView& view) {
  const int longer_px = std::max(view.width_px, view.height_px);
  const auto side = [&](int px) { return std::max(1, px * Onnx::side_px / longer_px); };
  const ObjectView crop = resized(view, side(view.width_px), side(view.height_px));
  const ObjectPixels pixels = resized(object_pixels(view), crop.width_px, crop.height_px);
  const int left_px = (Onnx::side_px - crop.width_px) / 2;
  const int top_px = (Onnx::side_px - crop.height_px) / 2;
  constexpr Eigen::Index plane = Onnx::side_px * Onnx::side_px;
  Eigen::VectorXf input = Eigen::VectorXf::Zero(3 * plane);
  for (int row = 0; row < crop.height_px; ++row) {
    for (int column = 0; column < crop.width_px; ++column) {
      const std::size_t i = crop.index(row, column);
      if (pixels.colour[i] == 0) continue;
      const Eigen::Index at = (top_px + row) * Onnx::side_px + left_px + column;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto value = static_cast<float>(crop.rgb[3 * i + c]) / 255.0F;
        input[static_cast<Eigen::Index>(c) * plane + at] = (value - kMean[c]) / kDeviation[c];
      }
    }
  }
  return input;
}

/// Unit length; or why there is none.
FeatureResult describe(const OnnxNetwork& network, const ObjectView& view) {
  if (auto why = lacks_colour(object_pixels(view), kMinPixels); !why.empty()) {
    return FeatureResult::skip(why);
  }
  const Eigen::VectorXf output = network.compute(network_input(view));
  const float length = output.norm();
  if (!(length > 0.0F) || !output.allFinite()) {
    return FeatureResult::skip("the network's output is zero or not finite");
  }
  return {output / length, {}};
}

}  // namespace

struct OnnxNetwork::Impl {
  cv::dnn::Net net;
  std::mutex mutex;
};

OnnxNetwork::OnnxNetwork(std::string bytes, std::string file)
    : bytes_(std::move(bytes)), file_(std::move(file)), impl_(std::make_shared<Impl>()) {
  try {
    impl_->net = cv::dnn::readNetFromONNX(bytes_.data(), bytes_.size());
    if (impl_->net.empty()) throw InputError("it has no layers");
    impl_->net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
  } catch (const std::exception& error) {
    throw InputError(
        fmt::format("feature onnx: '{}' is no ONNX network that OpenCV {} can load: {}", file_,
                    CV_VERSION, error.what()));
  }
}

Eigen::VectorXf OnnxNetwork::compute(const Eigen::VectorXf& input) const {
  const std::array<int, 4> shape{1, 3, Onnx::side_px, Onnx::side_px};
  expects(input.size() == Eigen::Index{3} * shape[2] * shape[3], "the network's input is a square");
  const cv::Mat blob(4, shape.data(), CV_32F, const_cast<float*>(input.data()));
  try {
    const std::scoped_lock lock(impl_->mutex);
    impl_->net.setInput(blob);
    const cv::Mat output = impl_->net.forward();
    if (output.type() != CV_32F || output.total() == 0 || !output.isContinuous()) {
      throw InputError("its output is no array of floats");
    }
    return Eigen::Map<const Eigen::VectorXf>(output.ptr<float>(),
                                             static_cast<Eigen::Index>(output.total()));
  } catch (const std::exception& error) {
    throw InputError(fmt::format("feature onnx: '{}' cannot take an input of 1 x 3 x {} x {}: {}",
                                 file_, Onnx::side_px, Onnx::side_px, error.what()));
  }
}

TrainedOnnx Onnx::train(std::span<const ObjectView> views, Rng& rng) const {
  OnnxNetwork network(read_network(file), file);
  const auto chosen = some_indices(static_cast<Eigen::Index>(views.size()), training_views, rng);
  Eigen::MatrixXf outputs;
  Eigen::Index used = 0;
  for (const Eigen::Index view : chosen) {
    const FeatureResult result = describe(network, views[static_cast<std::size_t>(view)]);
    if (!result.extracted()) continue;
    if (used == 0) outputs.resize(result.vector.size(), static_cast<Eigen::Index>(chosen.size()));
    outputs.col(used++) = result.vector;
  }
  if (used < 2) {
    throw InputError(
        fmt::format("feature onnx: '{}': {} training views can be used, fewer than 2", file, used));
  }
  return {std::move(network), learn_pca(outputs.leftCols(used), components)};
}

FeatureResult TrainedOnnx::extract(const ObjectView& view) const {
  FeatureResult result = describe(network_, view);
  if (result.extracted()) result.vector = pca_.project(result.vector);
  return result;
}

void TrainedOnnx::put_state(std::string& bytes) const {
  put_text(bytes, network_.file());
  put_text(bytes, network_.bytes());
  put_matrix(bytes, pca_.mean);
  put_matrix(bytes, pca_.axes);
  put_matrix(bytes, pca_.variance);
}

TrainedOnnx Onnx::take_state(ByteReader& reader) {
  std::string file = reader.text("the name of the network");
  OnnxNetwork network(reader.text("the network"), std::move(file));
  Pca pca;
  pca.mean = take_matrix(reader, -1, 1);
  pca.axes = take_matrix(reader, pca.mean.size(), -1);
  pca.variance = take_vector(reader, pca.axes.cols());
  const auto outputs = network.compute(Eigen::VectorXf::Zero(3 * side_px * side_px)).size();
  if (outputs != pca.mean.size()) reader.fail("holds components of another network");
  return {std::move(network), std::move(pca)};
}

}  // namespace vantage
