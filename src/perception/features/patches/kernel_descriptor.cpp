#include "vantage/perception/features/patches/kernel_descriptor.hpp"

#include <fmt/format.h>

#include <numbers>
#include <vector>

#include "vantage/perception/features/kit/k_means.hpp"
#include "vantage/perception/features/kit/training_views.hpp"
#include "vantage/perception/features/patches/attribute_image.hpp"
#include "vantage/perception/features/patches/cloud_patches.hpp"
#include "vantage/perception/features/patches/image_patches.hpp"

namespace vantage {
namespace {

constexpr int kMinPixels = 32;
constexpr double kNormalRadius_m = 0.01;

/// `points` on low .. high, tabulated over `reach` more at either end.
BasisAxis wider(BasisAxis axis, double reach) {
  axis.low -= reach;
  axis.high += reach;
  return axis;
}

std::vector<BasisAxis> with_position(std::vector<BasisAxis> axes) {
  const BasisAxis position = even_axis(5, 0.0, 1.0, 3.0);
  axes.insert(axes.end(), 2, position);
  return axes;
}

PatchResult patches_or(PatchSet patches, const char* otherwise) {
  if (patches.size() == 0) return {{}, otherwise};
  return {std::move(patches), {}};
}

PatchResult image_patches(PatchKind kind, const ObjectView& given, const ProductBasis& basis) {
  const ObjectView view = at_kernel_size(given);
  const ObjectPixels pixels = resized(object_pixels(given), view.width_px, view.height_px);
  if (auto why = lacks_colour(pixels, kMinPixels); !why.empty()) return {{}, why};
  const bool of_depth = kind == PatchKind::depth_gradient || kind == PatchKind::depth_lbp;
  if (of_depth) {
    if (auto why = lacks_depth(pixels, kMinPixels); !why.empty()) return {{}, why};
  }
  const auto attributes = [&] {
    switch (kind) {
      case PatchKind::rgb_gradient: return rgb_gradient_image(view, pixels);
      case PatchKind::lbp: return lbp_image(view, pixels);
      case PatchKind::normalised_rgb: return normalised_rgb_image(view, pixels);
      case PatchKind::depth_gradient: return depth_gradient_image(view, pixels);
      default: return depth_lbp_image(view, pixels);
    }
  };
  return patches_or(describe_patches(attributes(), pixels, basis),
                    "no patch of 16 x 16 px has enough of the object");
}

PatchResult surface_patches(PatchKind kind, const ObjectView& view, const ProductBasis& basis) {
  const ObjectPixels pixels = object_pixels(view);
  if (auto why = lacks_depth(pixels, kMinPixels); !why.empty()) return {{}, why};
  if (auto why = lacks_geometry(view); !why.empty()) return {{}, why};
  const ObjectSurface surface = object_surface(view, pixels, kNormalRadius_m);
  return patches_or(kind == PatchKind::size ? describe_sizes(pixels, surface, basis)
                                            : describe_spins(view, pixels, surface, basis),
                    "no grid point is on a surface large enough");
}

}  // namespace

std::vector<BasisAxis> basis_axes(PatchKind kind) {
  switch (kind) {
    case PatchKind::rgb_gradient:
    case PatchKind::depth_gradient: {
      const BasisAxis component = even_axis(10, -1.0, 1.0, 5.0);
      return with_position({component, component});
    }
    case PatchKind::lbp:
    case PatchKind::depth_lbp: return with_position({bits_axis(8, 3.0)});
    case PatchKind::normalised_rgb: {
      const BasisAxis channel = wider(even_axis(5, 0.0, 1.0, 5.0), 1.25);
      return with_position({channel, channel, channel});
    }
    case PatchKind::normal_spin: {
      BasisAxis angle = even_axis(50, 0.0, std::numbers::pi, 3.0);
      angle.kind = BasisAxis::Kind::angle;
      return {angle, even_axis(10, -0.05, 0.05, 300.0), even_axis(5, 0.0, 0.05, 300.0)};
    }
    case PatchKind::size: return {even_axis(100, 0.0, 1.0, 30.0)};
  }
  assertion_failed("a patch kind has a basis");
}

PatchResult extract_patches(PatchKind kind, const ObjectView& view, const ProductBasis& basis) {
  const bool of_surface = kind == PatchKind::normal_spin || kind == PatchKind::size;
  return of_surface ? surface_patches(kind, view, basis) : image_patches(kind, view, basis);
}

FeatureResult TrainedKernelDescriptor::extract(const ObjectView& view) const {
  const PatchResult result = extract_patches(kind_, view, basis_);
  if (!result.skipped.empty()) return FeatureResult::skip(result.skipped);
  return {match_.extract(result.patches), {}};
}

void TrainedKernelDescriptor::put_state(std::string& bytes) const {
  put_basis(bytes, basis_);
  match_.put_state(bytes);
}

TrainedKernelDescriptor train_kernel_descriptor(PatchKind kind, int rows, const MatchOptions& match,
                                                const LearningOptions& learning,
                                                std::span<const ObjectView> views, Rng& rng) {
  ProductBasis basis = make_product_basis(basis_axes(kind), rows);
  std::string why = "there are no views";
  const auto descriptors = [&](const ObjectView& view) {
    PatchResult result = extract_patches(kind, view, basis);
    if (!result.skipped.empty()) why = result.skipped;
    return std::move(result.patches.descriptors);
  };
  const auto wanted = static_cast<Eigen::Index>(match.words) * learning.samples_per_word;
  const Eigen::MatrixXf samples =
      sampled_columns(views, learning.training_views, wanted, rng, descriptors);
  if (samples.cols() == 0) {
    throw InputError(
        fmt::format("feature {}: no training view can be used: {}", row_of(kind).name, why));
  }
  Eigen::MatrixXf words = learn_words(samples, match.words, learning.iterations, rng);
  const auto chosen =
      some_indices(static_cast<Eigen::Index>(views.size()), learning.training_views, rng);
  Eigen::MatrixXf pooled(match.cells() * words.cols(), static_cast<Eigen::Index>(chosen.size()));
  Eigen::Index used = 0;
  for (const Eigen::Index view : chosen) {
    const PatchResult result = extract_patches(kind, views[static_cast<std::size_t>(view)], basis);
    if (result.skipped.empty()) pooled.col(used++) = pooled_kernels(result.patches, words, match);
  }
  if (used < 2) {
    throw InputError(fmt::format("feature {}: {} training view can be used, fewer than 2: {}",
                                 row_of(kind).name, used, why));
  }
  return {kind, std::move(basis),
          MatchKernel::learn(match, std::move(words), pooled.leftCols(used))};
}

TrainedKernelDescriptor take_kernel_descriptor(PatchKind kind, ByteReader& reader) {
  ProductBasis basis = take_basis(reader);
  if (basis.axes.size() != basis_axes(kind).size())
    reader.fail("holds the basis of another feature");
  MatchKernel match = MatchKernel::take_state(reader);
  if (match.words().rows() != basis.rows()) reader.fail("holds words of another basis");
  return {kind, std::move(basis), std::move(match)};
}

}  // namespace vantage
