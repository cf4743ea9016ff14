/// Kernel descriptors: seven features that differ in what they compare at a pixel or point.
/// [BoEtAl2010, BoEtAl2011]
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/perception/features/kit/feature_result.hpp"
#include "vantage/perception/features/kit/state_bytes.hpp"
#include "vantage/perception/features/patches/match_kernel.hpp"
#include "vantage/perception/features/patches/patch_set.hpp"
#include "vantage/perception/features/patches/product_basis.hpp"
#include "vantage/perception/object_view.hpp"

namespace vantage {

enum class PatchKind {
  rgb_gradient,
  lbp,
  normalised_rgb,
  depth_gradient,
  depth_lbp,
  normal_spin,
  size,
};

/// What is particular to each kind.
struct PatchKindRow {
  std::string_view name;
  int rows;      ///< of E, the dimension of a patch's descriptor
  double gamma;  ///< of the match kernel
  StrategyText text;
};
inline constexpr std::array<PatchKindRow, 7> kPatchKinds{{
    {"rgb_gradient",
     200,
     0.001,
     {.summary = "Kernel descriptors of the gradients of brightness: edges and texture of the "
                 "object's image.",
      .formula = "components of match kernels of E vec(A diag(m) S') per patch, attributes (gx, "
                 "gy) / norm, m by norm",
      .source = "BoEtAl2010"}},
    {"lbp",
     200,
     0.01,
     {.summary = "Kernel descriptors of local binary patterns of brightness: fine texture, "
                 "whatever the light.",
      .formula = "components of match kernels of E vec(A diag(m) S') per patch, attributes the 8 "
                 "neighbours >= the pixel, m by deviation",
      .source = "BoEtAl2010; OjalaEtAl2002"}},
    {"normalised_rgb",
     200,
     0.01,
     {.summary =
          "Kernel descriptors of locally normalised colour: colour patterns, whatever the light.",
      .formula = "components of match kernels of E vec(A diag(m) S') per patch, attributes (rgb - "
                 "mean) / deviation / 4, m by deviation",
      .source = "BoEtAl2010"}},
    {"depth_gradient",
     200,
     0.001,
     {.summary =
          "Kernel descriptors of the gradients of depth: slopes and edges of the object's surface.",
      .formula = "components of match kernels of E vec(A diag(m) S') per patch, attributes (gx, "
                 "gy) / norm of depth, m by norm",
      .source = "BoEtAl2011"}},
    {"depth_lbp",
     200,
     0.1,
     {.summary = "Kernel descriptors of local binary patterns of depth: fine relief of the "
                 "object's surface.",
      .formula = "components of match kernels of E vec(A diag(m) S') per patch, attributes the 8 "
                 "neighbours >= the depth, m by deviation",
      .source = "BoEtAl2011"}},
    {"normal_spin",
     200,
     0.1,
     {.summary = "Kernel descriptors of surface normals round a point, as in spin images: shape of "
                 "the surface.",
      .formula = "components of match kernels of E vec(A S') per patch, attributes angle between "
                 "normals, place along and off the normal",
      .source = "BoEtAl2011"}},
    {"size",
     50,
     1.0,
     {.summary =
          "Kernel descriptors of distances between the object's points: its size and proportions.",
      .formula = "components of match kernels of E vec(A) per point, attribute the distance to the "
                 "object's points",
      .source = "BoEtAl2011"}},
}};
constexpr const PatchKindRow& row_of(PatchKind kind) {
  return kPatchKinds[static_cast<std::size_t>(kind)];
}

/// Axes of a kind's joint basis: attributes first, then positions.
std::vector<BasisAxis> basis_axes(PatchKind kind);

/// Descriptors of all patches of a view; or why there are none.
struct PatchResult {
  PatchSet patches;
  std::string skipped;  ///< why; empty if there are patches
};
PatchResult extract_patches(PatchKind kind, const ObjectView& view, const ProductBasis& basis);

/// How to learn a vocabulary and principal components.
struct LearningOptions {
  int training_views = 2000;
  int samples_per_word = 20;
  int iterations = 10;
  void fields(auto&& f) {
    f("training_views", training_views,
      "number of views, drawn at random, to learn from; higher takes longer and more memory",
      at_least(2));
    f("samples_per_word", samples_per_word,
      "number of patches per word of the vocabulary to learn from; higher takes longer",
      at_least(1));
    f("iterations", iterations, "greatest number of iterations of k-means", at_least(1));
  }
};

class TrainedKernelDescriptor {
 public:
  TrainedKernelDescriptor(PatchKind kind, ProductBasis basis, MatchKernel match)
      : kind_(kind), basis_(std::move(basis)), match_(std::move(match)) {}
  [[nodiscard]] std::string_view feature_name() const { return row_of(kind_).name; }
  [[nodiscard]] int dimension() const { return match_.dimension(); }
  [[nodiscard]] FeatureResult extract(const ObjectView& view) const;
  void put_state(std::string& bytes) const;

 private:
  PatchKind kind_;
  ProductBasis basis_;
  MatchKernel match_;
};

/// @throws InputError if fewer than two views have patches, with the reason of one that has none.
TrainedKernelDescriptor train_kernel_descriptor(PatchKind kind, int rows, const MatchOptions& match,
                                                const LearningOptions& learning,
                                                std::span<const ObjectView> views, Rng& rng);
TrainedKernelDescriptor take_kernel_descriptor(PatchKind kind, ByteReader& reader);

template <PatchKind kind>
struct KernelDescriptor {
  static constexpr std::string_view name = row_of(kind).name;
  static constexpr StrategyText text = row_of(kind).text;
  int rows = row_of(kind).rows;
  MatchOptions match{.gamma = row_of(kind).gamma};
  LearningOptions learning;
  void fields(auto&& f) {
    f("rows", rows, "length of a patch's descriptor; higher keeps more of a patch and is slower",
      between(1, 1000));
    f("match", match, "match kernel: how the patches of a view become one vector");
    f("learning", learning, "how vocabulary and principal components are learnt");
  }

  [[nodiscard]] TrainedKernelDescriptor train(std::span<const ObjectView> views, Rng& rng) const {
    return train_kernel_descriptor(kind, rows, match, learning, views, rng);
  }
  static TrainedKernelDescriptor take_state(ByteReader& reader) {
    return take_kernel_descriptor(kind, reader);
  }
};

}  // namespace vantage
