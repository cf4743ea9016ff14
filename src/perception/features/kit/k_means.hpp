/// Visual words: a vocabulary learnt from samples.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "vantage/core/rng.hpp"

namespace vantage {

/// Lloyd's algorithm from seeds drawn by squared distance [ArthurVassilvitskii2007]. A word that
/// loses all its samples moves to the sample farthest from its own. Equal distances go to the
/// lower index.
/// @param samples dimensions x n, n > 0
/// @return dimensions x min(count, n)
Eigen::MatrixXf learn_words(const Eigen::MatrixXf& samples, int count, int iterations, Rng& rng);

/// Squared Euclidean distances. words x samples, never negative.
Eigen::MatrixXf squared_distances(const Eigen::MatrixXf& words, const Eigen::MatrixXf& samples);

/// Of each sample.
std::vector<int> nearest_words(const Eigen::MatrixXf& words, const Eigen::MatrixXf& samples);

/// Up to `count` columns drawn without repetition, in their order.
Eigen::MatrixXf some_columns(const Eigen::MatrixXf& matrix, Eigen::Index count, Rng& rng);
/// Up to `count` of the numbers 0 .. size - 1 drawn without repetition, ascending.
std::vector<Eigen::Index> some_indices(Eigen::Index size, Eigen::Index count, Rng& rng);

}  // namespace vantage
