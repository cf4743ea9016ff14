#include "vantage/perception/features/sift.hpp"

#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include "vantage/perception/features/kit/histogram.hpp"
#include "vantage/perception/features/kit/k_means.hpp"
#include "vantage/perception/features/kit/object_pixels.hpp"
#include "vantage/perception/features/kit/training_views.hpp"

namespace vantage {
namespace {

constexpr int kSiftBins = 128;

/// The longer side brought between the limits.
ObjectView scaled(const ObjectView& view, const Sift& options) {
  const int longer_px = std::max(view.width_px, view.height_px);
  const int wanted_px = std::min(std::max(longer_px, options.min_side_px), options.max_side_px);
  const double scale = static_cast<double>(wanted_px) / longer_px;
  const auto side = [&](int px) { return std::max(1, static_cast<int>(std::lround(px * scale))); };
  return resized(view, side(view.width_px), side(view.height_px));
}

std::vector<cv::KeyPoint> grid_on(const ObjectPixels& pixels, const Sift& options) {
  std::vector<cv::KeyPoint> points;
  const int start_px = options.step_px / 2;
  for (int y = start_px; y < pixels.height_px; y += options.step_px) {
    for (int x = start_px; x < pixels.width_px; x += options.step_px) {
      const auto i = static_cast<std::size_t>(y) * pixels.width_px + x;
      if (pixels.colour[i] == 0) continue;
      points.emplace_back(static_cast<float>(x), static_cast<float>(y),
                          static_cast<float>(options.size_px), 0.0F);
    }
  }
  return points;
}

}  // namespace

DenseSift dense_root_sift(const ObjectView& view, const Sift& options) {
  if (view.mask.empty()) return {};
  const ObjectView crop = scaled(view, options);
  const ObjectPixels pixels = resized(object_pixels(view), crop.width_px, crop.height_px);
  std::vector<cv::KeyPoint> points = grid_on(pixels, options);
  if (points.empty()) return {};
  const cv::Mat rgb(crop.height_px, crop.width_px, CV_8UC3,
                    const_cast<std::uint8_t*>(crop.rgb.data()));
  cv::Mat grey;
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  cv::Mat found;
  cv::SIFT::create()->compute(grey, points, found);
  DenseSift result{Eigen::MatrixXf(kSiftBins, found.rows), Eigen::Matrix2Xf(2, found.rows)};
  for (int i = 0; i < found.rows; ++i) {
    const auto& at = points[static_cast<std::size_t>(i)].pt;
    const auto place = place_in_box(pixels, at.x, at.y);
    result.descriptors.col(i) =
        root_of_shares(Eigen::Map<const Eigen::VectorXf>(found.ptr<float>(i), kSiftBins));
    result.places.col(i) = Eigen::Vector2f(place[0], place[1]);
  }
  return result;
}

TrainedSift::TrainedSift(const Sift& options, Eigen::MatrixXf words)
    : options_(options), words_(std::move(words)) {}

FeatureResult TrainedSift::extract(const ObjectView& view) const {
  const DenseSift sift = dense_root_sift(view, options_);
  if (sift.descriptors.cols() == 0) return FeatureResult::skip("no grid point is on the object");
  const std::vector<int> words = nearest_words(words_, sift.descriptors);
  Eigen::VectorXf histogram = Eigen::VectorXf::Zero(dimension());
  for (Eigen::Index i = 0; i < sift.places.cols(); ++i) {
    const int quarter = (sift.places(0, i) < 0.5F ? 0 : 1) + (sift.places(1, i) < 0.5F ? 0 : 2);
    const int word = words[static_cast<std::size_t>(i)];
    histogram[word] += 1.0F;
    histogram[(1 + quarter) * options_.words + word] += 1.0F;
  }
  return {root_of_shares(histogram), {}};
}

void TrainedSift::put_state(std::string& bytes) const {
  put_options(bytes, options_);
  put_matrix(bytes, words_);
}

TrainedSift Sift::train(std::span<const ObjectView> views, Rng& rng) const {
  const auto count = static_cast<Eigen::Index>(words) * samples_per_word;
  const Eigen::MatrixXf samples = sampled_columns(
      views, training_views, count, rng,
      [&](const ObjectView& view) { return dense_root_sift(view, *this).descriptors; });
  if (samples.cols() == 0) {
    throw InputError("feature sift: no training view has a grid point on its object");
  }
  return {*this, learn_words(samples, words, iterations, rng)};
}

TrainedSift Sift::take_state(ByteReader& reader) {
  const auto options = take_options<Sift>(reader);
  Eigen::MatrixXf words = take_matrix(reader, kSiftBins, -1);
  if (words.cols() < 1 || words.cols() > options.words) reader.fail("holds too few or many words");
  return {options, std::move(words)};
}

}  // namespace vantage
