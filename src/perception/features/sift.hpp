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
/// L1-normalised, square-rooted. [Potthast2016, 4.5.3]
struct Sift {
  static constexpr std::string_view name = "sift";
  static constexpr StrategyText text{
      .summary =
          "Bag of dense SIFT words over the object's box and its four quarters: texture, and "
          "roughly where it is.",
      .formula = "sqrt of the shares of words in the box and its quarters, 5 x words",
      .source = "Potthast2016, 4.5.3; Lowe2004; ArandjelovicZisserman2012; LazebnikEtAl2006"};
  int step_px = 8;
  double size_px = 4.0;
  int min_side_px = 96;
  int max_side_px = 160;
  int words = 200;
  int training_views = 2000;
  int samples_per_word = 100;
  int iterations = 20;
  void fields(auto&& f) {
    f("step_px", step_px, "spacing of the grid of keypoints; higher is faster and coarser",
      at_least(1));
    f("size_px", size_px,
      "diameter of a keypoint, whose patch is 6 times as wide; higher blurs more",
      between(1.0, 32.0));
    f("min_side_px", min_side_px,
      "length that the longer side of smaller crops is enlarged to; higher finds finer texture",
      at_least(16));
    f("max_side_px", max_side_px,
      "length that the longer side of larger crops is shrunk to; higher keeps finer texture and is "
      "slower",
      at_least(16));
    f("words", words, "size of the vocabulary; higher distinguishes more and needs more views",
      between(1, 100000));
    f("training_views", training_views,
      "number of views, drawn at random, that words are learnt from; higher takes longer",
      at_least(1));
    f("samples_per_word", samples_per_word,
      "number of descriptors per word to learn from; higher takes longer", at_least(1));
    f("iterations", iterations, "greatest number of iterations of k-means", at_least(1));
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
