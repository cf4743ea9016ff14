#include "vantage/perception/features/patches/image_patches.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace vantage {
namespace {

constexpr int kMinOnObject_px = 64;
constexpr float kContrast = 0.8F;

/// The basis' terms, split into a product of attribute functions and the functions of x and y.
struct SplitTerms {
  std::vector<std::vector<int>> attribute;  ///< the distinct products: function of each axis
  std::vector<Eigen::Index> product_of;     ///< of each term
  Eigen::Index x_functions = 0;
  Eigen::Index y_functions = 0;

  explicit SplitTerms(const ProductBasis& basis) {
    const Eigen::Index attribute_axes = basis.terms.rows() - 2;
    std::map<std::vector<int>, Eigen::Index> known;
    for (Eigen::Index t = 0; t < basis.terms.cols(); ++t) {
      const auto column = basis.terms.col(t);
      std::vector<int> functions(column.begin(), column.begin() + attribute_axes);
      const auto [at, is_new] = known.try_emplace(functions, std::ssize(attribute));
      if (is_new) attribute.push_back(std::move(functions));
      product_of.push_back(at->second);
    }
    x_functions = basis.axes[basis.axes.size() - 2].functions();
    y_functions = basis.axes.back().functions();
  }
  [[nodiscard]] Eigen::Index products() const { return std::ssize(attribute); }
};

/// Weighted attribute products of every pixel: (products * height) x width, so that a column of the
/// image is contiguous.
Eigen::MatrixXf weighted_products(const AttributeImage& image, const ProductBasis& basis,
                                  const SplitTerms& terms) {
  const Eigen::Index products = terms.products();
  Eigen::MatrixXf all = Eigen::MatrixXf::Zero(products * image.height_px, image.width_px);
  std::vector<const float*> functions(static_cast<std::size_t>(image.attributes.rows()));
  for (int row = 0; row < image.height_px; ++row) {
    for (int column = 0; column < image.width_px; ++column) {
      const Eigen::Index i = Eigen::Index{row} * image.width_px + column;
      const float weight = image.weights[i];
      if (!(weight > 0.0F)) continue;
      for (std::size_t a = 0; a < functions.size(); ++a) {
        const double value = image.attributes(static_cast<Eigen::Index>(a), i);
        functions[a] = basis.axes[a].at(value).data();
      }
      float* out = all.data() + column * all.rows() + row * products;
      for (const auto& product : terms.attribute) {
        float value = weight;
        for (std::size_t a = 0; a < functions.size(); ++a) value *= functions[a][product[a]];
        *out++ = value;
      }
    }
  }
  return all;
}

/// The functions of a position axis at the pixels of a patch. 16 x functions.
Eigen::MatrixXf position_functions(const ProductBasis::Axis& axis) {
  Eigen::MatrixXf functions(kPatchSide_px, axis.functions());
  for (int k = 0; k < kPatchSide_px; ++k) {
    functions.row(k) = axis.at(static_cast<double>(k) / kPatchSide_px).transpose();
  }
  return functions;
}

struct Grid {
  std::vector<Eigen::Vector2i> corners;  ///< x, y of each patch, sorted by x
};

/// Patches with enough of the object.
Grid patches_on(const ObjectPixels& pixels) {
  const auto first = [](int side_px) { return (side_px - kPatchSide_px) % kPatchStep_px / 2; };
  Grid grid;
  if (std::min(pixels.width_px, pixels.height_px) < kPatchSide_px) return grid;
  for (int x = first(pixels.width_px); x + kPatchSide_px <= pixels.width_px; x += kPatchStep_px) {
    for (int y = first(pixels.height_px); y + kPatchSide_px <= pixels.height_px;
         y += kPatchStep_px) {
      int on_object = 0;
      for (int row = y; row < y + kPatchSide_px; ++row) {
        const auto start = pixels.colour.begin() + std::ptrdiff_t{row} * pixels.width_px + x;
        on_object += static_cast<int>(std::count(start, start + kPatchSide_px, 1));
      }
      if (on_object >= kMinOnObject_px) grid.corners.emplace_back(x, y);
    }
  }
  return grid;
}

float norm_of_weights(const AttributeImage& image, const Eigen::Vector2i& corner) {
  float sum2 = 0.0F;
  for (int row = corner.y(); row < corner.y() + kPatchSide_px; ++row) {
    sum2 += image.weights.segment(Eigen::Index{row} * image.width_px + corner.x(), kPatchSide_px)
                .squaredNorm();
  }
  return std::sqrt(sum2);
}

}  // namespace

PatchSet describe_patches(const AttributeImage& image, const ObjectPixels& pixels,
                          const ProductBasis& basis) {
  const SplitTerms terms(basis);
  const Grid grid = patches_on(pixels);
  const auto patches = static_cast<Eigen::Index>(grid.corners.size());
  const Eigen::MatrixXf weighted = weighted_products(image, basis, terms);
  const Eigen::MatrixXf of_x = position_functions(basis.axes[basis.axes.size() - 2]);
  const Eigen::MatrixXf of_y = position_functions(basis.axes.back());
  const Eigen::Index products = terms.products();
  const Eigen::Index x_axis = basis.terms.rows() - 2;
  Eigen::MatrixXf rows;  // (products * height) x x functions
  Eigen::MatrixXf sums(products * terms.y_functions, terms.x_functions);
  Eigen::MatrixXf tensor(basis.terms.cols(), patches);
  PatchSet set{{}, Eigen::Matrix2Xf(2, patches)};
  for (Eigen::Index p = 0; p < patches; ++p) {
    const Eigen::Vector2i corner = grid.corners[static_cast<std::size_t>(p)];
    const bool same_column =
        p > 0 && grid.corners[static_cast<std::size_t>(p - 1)].x() == corner.x();
    if (!same_column) rows.noalias() = weighted.middleCols(corner.x(), kPatchSide_px) * of_x;
    for (Eigen::Index j = 0; j < terms.x_functions; ++j) {
      const Eigen::Map<const Eigen::MatrixXf> below(rows.col(j).data() + corner.y() * products,
                                                    products, kPatchSide_px);
      Eigen::Map<Eigen::MatrixXf>(sums.col(j).data(), products, terms.y_functions).noalias() =
          below * of_y;
    }
    const float scale = 1.0F / std::max(norm_of_weights(image, corner), kContrast);
    for (Eigen::Index t = 0; t < basis.terms.cols(); ++t) {
      tensor(t, p) = scale * sums(basis.terms(x_axis + 1, t) * products +
                                      terms.product_of[static_cast<std::size_t>(t)],
                                  basis.terms(x_axis, t));
    }
    const auto place =
        place_in_box(pixels, corner.x() + 0.5 * kPatchSide_px, corner.y() + 0.5 * kPatchSide_px);
    set.places.col(p) = Eigen::Vector2f(place[0], place[1]);
  }
  set.descriptors.noalias() = basis.projection * tensor;
  return set;
}

}  // namespace vantage
