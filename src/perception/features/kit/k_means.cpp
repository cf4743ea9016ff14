#include "vantage/perception/features/kit/k_means.hpp"

#include <algorithm>
#include <numeric>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr Eigen::Index kBlock = 2048;  // samples at once, so that distances stay in the cache

struct Assignment {
  std::vector<int> word;
  Eigen::VectorXf distance2;
};

Assignment assign(const Eigen::MatrixXf& words, const Eigen::MatrixXf& samples) {
  Assignment result{std::vector<int>(static_cast<std::size_t>(samples.cols())),
                    Eigen::VectorXf(samples.cols())};
  for (Eigen::Index start = 0; start < samples.cols(); start += kBlock) {
    const Eigen::Index count = std::min(kBlock, samples.cols() - start);
    const Eigen::MatrixXf distances = squared_distances(words, samples.middleCols(start, count));
    for (Eigen::Index i = 0; i < count; ++i) {
      Eigen::Index word = 0;
      result.distance2[start + i] = distances.col(i).minCoeff(&word);
      result.word[static_cast<std::size_t>(start + i)] = static_cast<int>(word);
    }
  }
  return result;
}

Eigen::Index drawn_by(const Eigen::VectorXf& weights, Rng& rng) {
  const double total = weights.cast<double>().sum();
  double left = rng.uniform() * total;
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    left -= static_cast<double>(weights[i]);
    if (left < 0.0) return i;
  }
  return weights.size() - 1;
}

Eigen::MatrixXf seeds(const Eigen::MatrixXf& samples, Eigen::Index count, Rng& rng) {
  Eigen::MatrixXf words(samples.rows(), count);
  words.col(0) = samples.col(
      static_cast<Eigen::Index>(rng.uniform_index(static_cast<std::size_t>(samples.cols()))));
  Eigen::VectorXf nearest2 = (samples.colwise() - words.col(0)).colwise().squaredNorm();
  for (Eigen::Index k = 1; k < count; ++k) {
    words.col(k) = samples.col(drawn_by(nearest2, rng));
    const Eigen::VectorXf to_new = (samples.colwise() - words.col(k)).colwise().squaredNorm();
    nearest2 = nearest2.cwiseMin(to_new);
  }
  return words;
}

void move_to_means(Eigen::MatrixXf& words, const Eigen::MatrixXf& samples, Assignment& of) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(words.rows(), words.cols());
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(words.cols());
  for (Eigen::Index i = 0; i < samples.cols(); ++i) {
    const int word = of.word[static_cast<std::size_t>(i)];
    sums.col(word) += samples.col(i).cast<double>();
    counts[word] += 1.0;
  }
  for (Eigen::Index k = 0; k < words.cols(); ++k) {
    if (counts[k] > 0.0) {
      words.col(k) = (sums.col(k) / counts[k]).cast<float>();
      continue;
    }
    Eigen::Index farthest = 0;
    of.distance2.maxCoeff(&farthest);
    words.col(k) = samples.col(farthest);
    of.distance2[farthest] = 0.0F;
  }
}

}  // namespace

Eigen::MatrixXf squared_distances(const Eigen::MatrixXf& words, const Eigen::MatrixXf& samples) {
  Eigen::MatrixXf distances = -2.0F * (words.transpose() * samples);
  distances.colwise() += words.colwise().squaredNorm().transpose();
  distances.rowwise() += samples.colwise().squaredNorm();
  return distances.cwiseMax(0.0F);
}

std::vector<int> nearest_words(const Eigen::MatrixXf& words, const Eigen::MatrixXf& samples) {
  return assign(words, samples).word;
}

Eigen::MatrixXf learn_words(const Eigen::MatrixXf& samples, int count, int iterations, Rng& rng) {
  expects(samples.cols() > 0 && count > 0, "words are learnt from samples");
  Eigen::MatrixXf words = seeds(samples, std::min<Eigen::Index>(count, samples.cols()), rng);
  std::vector<int> before;
  for (int i = 0; i < iterations; ++i) {
    Assignment assignment = assign(words, samples);
    if (assignment.word == before) break;
    move_to_means(words, samples, assignment);
    before = std::move(assignment.word);
  }
  return words;
}

std::vector<Eigen::Index> some_indices(Eigen::Index size, Eigen::Index count, Rng& rng) {
  std::vector<Eigen::Index> indices(static_cast<std::size_t>(size));
  std::iota(indices.begin(), indices.end(), Eigen::Index{0});
  if (count >= size) return indices;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    std::swap(indices[i], indices[i + rng.uniform_index(indices.size() - i)]);
  }
  indices.resize(static_cast<std::size_t>(count));
  std::ranges::sort(indices);
  return indices;
}

Eigen::MatrixXf some_columns(const Eigen::MatrixXf& matrix, Eigen::Index count, Rng& rng) {
  return matrix(Eigen::all, some_indices(matrix.cols(), count, rng));
}

}  // namespace vantage
