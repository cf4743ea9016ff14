#include "vantage/perception/features/patches/match_kernel.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <vector>

#include "vantage/perception/features/kit/k_means.hpp"
#include "vantage/perception/features/kit/pca.hpp"

namespace vantage {
namespace {

constexpr double kRidge = 1e-6;

/// Index of the cell that a place is in, among those of a level.
int cell_of(const Eigen::Vector2f& place, int level) {
  const auto part = [&](float share) {
    return std::clamp(static_cast<int>(share * static_cast<float>(level)), 0, level - 1);
  };
  return part(place.y()) * level + part(place.x());
}

/// Of the patches of a cell, for each word: the nearest to it of those whose nearest word it is.
class BestPatches {
 public:
  BestPatches(Eigen::Index cells, Eigen::Index words) : best_(cells, words) {
    best_.setConstant(-1);
  }
  void offer(Eigen::Index cell, Eigen::Index word, int patch, const Eigen::MatrixXf& kernels) {
    int& best = best_(cell, word);
    if (best < 0 || kernels(word, patch) > kernels(word, best)) best = patch;
  }
  [[nodiscard]] Eigen::VectorXf mean_of(Eigen::Index cell, const Eigen::MatrixXf& kernels) const {
    Eigen::VectorXf sum = Eigen::VectorXf::Zero(kernels.rows());
    int count = 0;
    for (const int patch : best_.row(cell)) {
      if (patch < 0) continue;
      sum += kernels.col(patch);
      ++count;
    }
    return count > 0 ? Eigen::VectorXf(sum / static_cast<float>(count)) : sum;
  }

 private:
  Eigen::MatrixXi best_;
};

}  // namespace

Eigen::VectorXf pooled_kernels(const PatchSet& patches, const Eigen::MatrixXf& words,
                               const MatchOptions& options) {
  const Eigen::MatrixXf distances = squared_distances(words, patches.descriptors);
  const Eigen::MatrixXf kernels =
      (-static_cast<float>(options.gamma) * distances.array()).exp().matrix();
  std::vector<Eigen::Index> nearest(static_cast<std::size_t>(patches.size()));
  for (std::size_t p = 0; p < nearest.size(); ++p) {
    distances.col(static_cast<Eigen::Index>(p)).minCoeff(&nearest[p]);
  }
  Eigen::VectorXf pooled(options.cells() * words.cols());
  Eigen::Index next = 0;
  double all_weights = 0.0;
  for (int level = 1; level <= options.levels; ++level) all_weights += 1.0 / (level * level);
  for (int level = 1; level <= options.levels; ++level) {
    BestPatches best(level * level, words.cols());
    for (std::size_t p = 0; p < nearest.size(); ++p) {
      const auto patch = static_cast<Eigen::Index>(p);
      best.offer(cell_of(patches.places.col(patch), level), nearest[p], static_cast<int>(p),
                 kernels);
    }
    const auto weight = static_cast<float>(1.0 / (level * level) / all_weights);
    for (int cell = 0; cell < level * level; ++cell, next += words.cols()) {
      pooled.segment(next, words.cols()) = weight * best.mean_of(cell, kernels);
    }
  }
  return pooled;
}

Eigen::MatrixXd inverse_root(const Eigen::MatrixXf& words, double gamma) {
  const Eigen::MatrixXd w = words.cast<double>();  // single precision is coarser than the ridge
  Eigen::MatrixXd kernel = -2.0 * (w.transpose() * w);
  kernel.colwise() += w.colwise().squaredNorm().transpose();
  kernel.rowwise() += w.colwise().squaredNorm();
  kernel = (-gamma * kernel.array().max(0.0)).exp().matrix();
  kernel.diagonal().setConstant(1.0 + kRidge);
  const Eigen::LLT<Eigen::MatrixXd> factor(kernel);
  expects(factor.info() == Eigen::Success, "a kernel matrix with a ridge is positive definite");
  return factor.matrixL().solve(Eigen::MatrixXd::Identity(kernel.rows(), kernel.cols()));
}

MatchKernel MatchKernel::learn(const MatchOptions& options, Eigen::MatrixXf words,
                               const Eigen::MatrixXf& pooled) {
  MatchKernel kernel;
  kernel.options_ = options;
  kernel.mean_ = pooled.rowwise().mean();
  const Eigen::MatrixXf root = inverse_root(words, options.gamma).cast<float>();
  Eigen::MatrixXf mapped = pooled.colwise() - kernel.mean_;
  for (Eigen::Index start = 0; start < mapped.rows(); start += words.cols()) {
    mapped.middleRows(start, words.cols()) = root * mapped.middleRows(start, words.cols());
  }
  const Pca pca = learn_pca(mapped, options.components);
  kernel.projection_.resize(pca.axes.cols(), pca.axes.rows());
  for (Eigen::Index start = 0; start < pca.axes.rows(); start += words.cols()) {
    kernel.projection_.middleCols(start, words.cols()).noalias() =
        pca.axes.middleRows(start, words.cols()).transpose() * root;
  }
  kernel.words_ = std::move(words);
  return kernel;
}

Eigen::VectorXf MatchKernel::extract(const PatchSet& patches) const {
  const Eigen::VectorXf components =
      projection_ * (pooled_kernels(patches, words_, options_) - mean_);
  const auto power = static_cast<float>(options_.power);
  return components.unaryExpr(
      [power](float x) { return std::copysign(std::pow(std::abs(x), power), x); });
}

void MatchKernel::put_state(std::string& bytes) const {
  put_options(bytes, options_);
  put_matrix(bytes, words_);
  put_matrix(bytes, projection_);
  put_matrix(bytes, mean_);
}

MatchKernel MatchKernel::take_state(ByteReader& reader) {
  MatchKernel kernel;
  kernel.options_ = take_options<MatchOptions>(reader);
  kernel.words_ = take_matrix(reader);
  if (kernel.words_.size() == 0) reader.fail("holds a vocabulary without words");
  kernel.projection_ = take_matrix(reader, -1, kernel.options_.cells() * kernel.words_.cols());
  kernel.mean_ = take_vector(reader, kernel.projection_.cols());
  return kernel;
}

}  // namespace vantage
