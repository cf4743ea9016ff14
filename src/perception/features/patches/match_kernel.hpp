/// From the patches of a view to one vector: efficient match kernels.
#pragma once

#include <Eigen/Core>

#include <string>

#include "vantage/core/fields.hpp"
#include "vantage/perception/features/kit/state_bytes.hpp"
#include "vantage/perception/features/patches/patch_set.hpp"

namespace vantage {

struct MatchOptions {
  double gamma = 0.01;
  int words = 1000;
  int levels = 3;
  int components = 1000;
  double power = 0.3;
  void fields(auto&& f) {
    f("gamma", gamma,
      "gamma of the kernel exp(-gamma d^2) between patch descriptors; higher distinguishes more",
      above(0.0));
    f("words", words, "size of the vocabulary; higher approximates the kernel better and is slower",
      between(1, 100000));
    f("levels", levels,
      "levels of the spatial pyramid, the l-th with l x l cells; higher keeps more of where "
      "patches lie",
      between(1, 8));
    f("components", components,
      "number of principal components that are kept, n - 1 at most of n training views; higher "
      "keeps more detail",
      between(1, 100000));
    f("power", power,
      "exponent p of sign(x) |x|^p on each component; lower evens the components out",
      between(0.01, 1.0));
  }
  [[nodiscard]] int cells() const { return levels * (levels + 1) * (2 * levels + 1) / 6; }
};

/// Mean kernel vector of each pyramid cell, times the cell's weight, 1 / l^2 over the sum of those:
/// cells * words. Of the patches of a cell that have the same nearest word, only the nearest
/// counts, so that a repeated texture does not drown what is rare. Empty cells are zero.
/// [BoSminchisescu2009]
Eigen::VectorXf pooled_kernels(const PatchSet& patches, const Eigen::MatrixXf& words,
                               const MatchOptions& options);

/// L^-1 with L L' = K(words, words) + 1e-6 I: inner products of G times kernel vectors are the
/// match kernel. It is the spec's chol(K^-1) up to a rotation, without inverting K.
Eigen::MatrixXd inverse_root(const Eigen::MatrixXf& words, double gamma);

/// sign(x) |x|^power of the principal components of G times the mean kernel vectors. Both maps are
/// linear, so they are one. G is ill-conditioned: the mean goes off before it, not after.
class MatchKernel {
 public:
  /// @param words dimensions x words
  /// @param pooled pooled_kernels() of training views, one a column, 2 or more
  static MatchKernel learn(const MatchOptions& options, Eigen::MatrixXf words,
                           const Eigen::MatrixXf& pooled);
  [[nodiscard]] int dimension() const { return static_cast<int>(projection_.rows()); }
  [[nodiscard]] const Eigen::MatrixXf& words() const { return words_; }
  [[nodiscard]] Eigen::VectorXf extract(const PatchSet& patches) const;

  void put_state(std::string& bytes) const;
  static MatchKernel take_state(ByteReader& reader);

 private:
  MatchKernel() = default;
  MatchOptions options_;
  Eigen::MatrixXf words_;
  Eigen::MatrixXf projection_;  ///< components x (cells * words)
  Eigen::VectorXf mean_;        ///< of the pooled kernels in training; cells * words
};

}  // namespace vantage
