/// Bag of dense SIFT words.
#pragma once

#include <Eigen/Core>

#include <span>
#include <string>
#include <string_view>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/perception/features/kit/feature_result.hpp"
#include "vantage/perception/features/kit/state_bytes.hpp"
#include "vantage/perception/object_view.hpp"

namespace vantage {

class TrainedSift;

/// RootSIFT [Lowe2004, ArandjelovicZisserman2012] upright on a grid, quantised to words, counted
/// over the object's box and its four quarters (a spatial pyramid [LazebnikEtAl2006]),
/// L1-normalised, square-rooted. [Potthast2016, 4.5.2]
struct Sift {
  static constexpr std::string_view name = "sift";
  int step_px = 8;
  double size_px = 4.0;
  int min_side_px = 96;
  int max_side_px = 160;
  int words = 200;
  int training_views = 2000;
  int samples_per_word = 100;
  int iterations = 20;
  void fields(auto&& f) {
    f("step_px", step_px, "of the grid; higher is faster and coarser", at_least(1));
    f("size_px", size_px, "diameter of a keypoint, its patch 6 times that; higher blurs",
      between(1.0, 32.0));
    f("min_side_px", min_side_px, "smaller crops are enlarged to it; higher finds finer grain",
      at_least(16));
    f("max_side_px", max_side_px, "larger crops are shrunk to it; higher is slower", at_least(16));
    f("words", words, "of the vocabulary; higher tells more apart and needs more views",
      between(1, 100000));
    f("training_views", training_views, "to learn words from, drawn at random; higher takes longer",
      at_least(1));
    f("samples_per_word", samples_per_word,
      "descriptors for each word to learn; higher takes longer", at_least(1));
    f("iterations", iterations, "of k-means, at most", at_least(1));
  }

  /// @throws InputError if no view has a grid point on its object.
  [[nodiscard]] TrainedSift train(std::span<const ObjectView> views, Rng& rng) const;
  static TrainedSift take_state(ByteReader& reader);
};

/// RootSIFT descriptors of a view and where they are.
struct DenseSift {
  Eigen::MatrixXf descriptors;  ///< 128 x points, unit length
  Eigen::Matrix2Xf places;      ///< x, y within the object's box, 0 .. 1
};
DenseSift dense_root_sift(const ObjectView& view, const Sift& options);

class TrainedSift {
 public:
  TrainedSift(const Sift& options, Eigen::MatrixXf words);
  [[nodiscard]] std::string_view feature_name() const { return Sift::name; }
  [[nodiscard]] int dimension() const { return 5 * options_.words; }
  [[nodiscard]] FeatureResult extract(const ObjectView& view) const;
  void put_state(std::string& bytes) const;

 private:
  Sift options_;
  Eigen::MatrixXf words_;  ///< 128 x words
};

}  // namespace vantage
