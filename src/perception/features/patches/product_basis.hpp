/// The joint basis of a kernel descriptor, factored.
///
/// Its Gaussian kernels act on each axis (a gradient's component, a position, ...) by itself, so
/// that the Gram matrix of all combinations of basis points is a Kronecker product and its
/// eigenvectors are products of those of the axes. A descriptor then needs a few eigenfunctions
/// an axis in place of hundreds of basis points.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "vantage/perception/features/kit/state_bytes.hpp"

namespace vantage {

/// Basis points of one axis, with the kernel exp(-gamma |f(x) - f(b)|^2).
struct BasisAxis {
  enum class Kind {
    line,   ///< f(x) = x
    angle,  ///< f(x) = (sin x, cos x)
    bits,   ///< f(x) = the bits of an integer
  };
  Eigen::VectorXd points;
  double gamma = 1.0;
  double low = 0.0;  ///< values below count as `low`
  double high = 1.0;
  Kind kind = Kind::line;
  int samples = 2049;  ///< of the tables over low .. high; higher is more exact

  [[nodiscard]] double kernel(double a, double b) const;
};
/// `count` points from `low` to `high`, both included.
BasisAxis even_axis(int count, double low, double high, double gamma);
/// All patterns of `bits` bits.
BasisAxis bits_axis(int bits, double gamma);

/// Leading eigenvectors E of the doubly centred Gram matrix of the joint basis, unit length
/// [BoEtAl2010, section 3], as a projection of products of eigenfunctions.
struct ProductBasis {
  struct Axis {
    double low = 0.0;
    double per_unit = 1.0;   ///< samples a unit of the axis
    Eigen::MatrixXf values;  ///< functions x samples: U' k(x), U the axis' leading eigenvectors

    [[nodiscard]] Eigen::Index sample(double x) const {
      const double at = (x - low) * per_unit + 0.5;
      if (!(at > 0.0)) return 0;
      // Clamped before it is an index: an odd view may give a size beyond every integer.
      return static_cast<Eigen::Index>(std::min(at, static_cast<double>(values.cols() - 1)));
    }
    [[nodiscard]] auto at(double x) const { return values.col(sample(x)); }
    [[nodiscard]] Eigen::Index functions() const { return values.rows(); }
  };
  std::vector<Axis> axes;
  Eigen::MatrixXi terms;        ///< axes x terms: function of each axis in each product
  Eigen::MatrixXf projection;   ///< rows x terms, orthonormal rows
  Eigen::VectorXf eigenvalues;  ///< of each row, descending

  [[nodiscard]] Eigen::Index rows() const { return projection.rows(); }
  /// The descriptor E vec(a_1 x a_2 x ...) of one element with the given axis values.
  [[nodiscard]] Eigen::VectorXf describe(std::span<const double> values) const;
};

/// At most `rows` rows; eigenvalues below 1e-7 of the greatest are rounding, and left out.
/// Centring couples products of the axes' eigenvectors; it is solved for among the half more than
/// `rows` with the greatest eigenvalues.
ProductBasis make_product_basis(std::span<const BasisAxis> axes, int rows);

void put_basis(std::string& bytes, const ProductBasis& basis);
ProductBasis take_basis(ByteReader& reader);

}  // namespace vantage
