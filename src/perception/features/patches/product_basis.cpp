#include "vantage/perception/features/patches/product_basis.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <bit>
#include <cmath>

#include "vantage/perception/features/kit/pca.hpp"

namespace vantage {
namespace {

constexpr double kRounding = 1e-7;

/// Eigenvectors of one axis' Gram matrix, greatest eigenvalue first.
struct AxisModes {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
  Eigen::VectorXd ones;  ///< inner products of the eigenvectors with (1, .., 1)
};

AxisModes modes_of(const BasisAxis& axis) {
  const Eigen::Index n = axis.points.size();
  Eigen::MatrixXd gram(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) gram(i, j) = axis.kernel(axis.points[i], axis.points[j]);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
  AxisModes modes{solver.eigenvalues().reverse(), solver.eigenvectors().rowwise().reverse(), {}};
  fix_signs(modes.vectors);
  modes.ones = modes.vectors.colwise().sum();
  return modes;
}

/// A product of one eigenvector of each axis.
struct Product {
  std::vector<int> modes;
  double value = 1.0;  ///< eigenvalue
  double ones = 1.0;   ///< inner product with (1, .., 1)
};

std::vector<Product> leading_products(const std::vector<AxisModes>& axes, std::size_t count) {
  std::vector<Product> products(1);
  for (const AxisModes& axis : axes) {
    std::vector<Product> longer;
    for (const Product& product : products) {
      for (Eigen::Index i = 0; i < axis.values.size(); ++i) {
        Product next = product;
        next.modes.push_back(static_cast<int>(i));
        next.value *= std::max(axis.values[i], 0.0);
        next.ones *= axis.ones[i];
        longer.push_back(std::move(next));
      }
    }
    products = std::move(longer);
  }
  std::ranges::stable_sort(products, std::ranges::greater{}, &Product::value);
  const double smallest = kRounding * products.front().value;
  std::erase_if(products, [&](const Product& p) { return p.value < smallest; });
  if (products.size() > count) products.resize(count);
  return products;
}

/// (I - 11'/n) K (I - 11'/n) among the products, of which K is diagonal.
Eigen::MatrixXd centred_gram(const std::vector<Product>& products,
                             const std::vector<AxisModes>& axes) {
  double n = 1.0;
  double total = 1.0;  // 1' K 1, over all products
  for (const AxisModes& axis : axes) {
    n *= static_cast<double>(axis.values.size());
    total *= axis.values.dot(axis.ones.cwiseAbs2());
  }
  const auto size = static_cast<Eigen::Index>(products.size());
  Eigen::VectorXd value(size);
  Eigen::VectorXd ones(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    value[i] = products[static_cast<std::size_t>(i)].value;
    ones[i] = products[static_cast<std::size_t>(i)].ones;
  }
  const Eigen::VectorXd sums = value.cwiseProduct(ones);
  Eigen::MatrixXd gram = value.asDiagonal();
  gram -= (sums * ones.transpose() + ones * sums.transpose()) / n;
  gram += ones * ones.transpose() * (total / (n * n));
  return gram;
}

ProductBasis::Axis tabulated(const BasisAxis& axis, const AxisModes& modes, int functions) {
  ProductBasis::Axis table;
  table.low = axis.low;
  table.per_unit = (axis.samples - 1) / (axis.high - axis.low);
  Eigen::MatrixXd kernels(axis.points.size(), axis.samples);
  for (int s = 0; s < axis.samples; ++s) {
    const double x = axis.kind == BasisAxis::Kind::bits ? s : axis.low + s / table.per_unit;
    for (Eigen::Index b = 0; b < axis.points.size(); ++b) {
      kernels(b, s) = axis.kernel(x, axis.points[b]);
    }
  }
  table.values = (modes.vectors.leftCols(functions).transpose() * kernels).cast<float>();
  return table;
}

}  // namespace

double BasisAxis::kernel(double a, double b) const {
  double distance2 = (a - b) * (a - b);
  if (kind == Kind::angle) distance2 = 2.0 - 2.0 * std::cos(a - b);
  if (kind == Kind::bits) {
    distance2 = std::popcount(static_cast<unsigned>(a) ^ static_cast<unsigned>(b));
  }
  return std::exp(-gamma * distance2);
}

BasisAxis even_axis(int count, double low, double high, double gamma) {
  return {.points = Eigen::VectorXd::LinSpaced(count, low, high),
          .gamma = gamma,
          .low = low,
          .high = high};
}

BasisAxis bits_axis(int bits, double gamma) {
  const int patterns = 1 << bits;
  BasisAxis axis = even_axis(patterns, 0.0, patterns - 1.0, gamma);
  for (int i = 0; i < patterns; ++i) axis.points[i] = i;
  axis.kind = BasisAxis::Kind::bits;
  axis.samples = patterns;
  return axis;
}

Eigen::VectorXf ProductBasis::describe(std::span<const double> values) const {
  Eigen::VectorXf products = Eigen::VectorXf::Ones(terms.cols());
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const Eigen::VectorXf functions = axes[a].at(values[a]);
    for (Eigen::Index t = 0; t < terms.cols(); ++t) {
      products[t] *= functions[terms(static_cast<Eigen::Index>(a), t)];
    }
  }
  return projection * products;
}

ProductBasis make_product_basis(std::span<const BasisAxis> axes, int rows) {
  std::vector<AxisModes> modes;
  for (const BasisAxis& axis : axes) modes.push_back(modes_of(axis));
  const auto products = leading_products(modes, static_cast<std::size_t>(rows) * 3 / 2);
  ProductBasis basis;
  basis.terms.resize(static_cast<Eigen::Index>(axes.size()),
                     static_cast<Eigen::Index>(products.size()));
  for (std::size_t t = 0; t < products.size(); ++t) {
    basis.terms.col(static_cast<Eigen::Index>(t)) = Eigen::Map<const Eigen::VectorXi>(
        products[t].modes.data(), static_cast<Eigen::Index>(axes.size()));
  }
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const int functions = basis.terms.row(static_cast<Eigen::Index>(a)).maxCoeff() + 1;
    basis.axes.push_back(tabulated(axes[a], modes[a], functions));
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(centred_gram(products, modes));
  const Eigen::VectorXd values = solver.eigenvalues().reverse();
  const auto kept = std::min<Eigen::Index>(rows, (values.array() > kRounding * values[0]).count());
  Eigen::MatrixXd vectors = solver.eigenvectors().rightCols(kept).rowwise().reverse();
  fix_signs(vectors);
  basis.projection = vectors.transpose().cast<float>();
  basis.eigenvalues = values.head(kept).cast<float>();
  return basis;
}

void put_basis(std::string& bytes, const ProductBasis& basis) {
  put(bytes, static_cast<std::uint32_t>(basis.axes.size()));
  for (const auto& axis : basis.axes) {
    put(bytes, axis.low);
    put(bytes, axis.per_unit);
    put_matrix(bytes, axis.values);
  }
  put_matrix(bytes, basis.terms.cast<float>());
  put_matrix(bytes, basis.projection);
  put_matrix(bytes, basis.eigenvalues);
}

ProductBasis take_basis(ByteReader& reader) {
  ProductBasis basis;
  const auto axes = reader.number<std::uint32_t>("a basis");
  if (axes < 1 || axes > 16) reader.fail("holds a basis without axes, or of too many");
  for (std::uint32_t a = 0; a < axes; ++a) {
    ProductBasis::Axis axis;
    axis.low = reader.number<double>("a basis");
    axis.per_unit = reader.number<double>("a basis");
    axis.values = take_matrix(reader);
    if (axis.values.size() == 0 || !std::isfinite(axis.low) || !(axis.per_unit > 0.0)) {
      reader.fail("holds a basis with an empty axis");
    }
    basis.axes.push_back(std::move(axis));
  }
  const Eigen::MatrixXf terms = take_matrix(reader, axes, -1);
  for (std::uint32_t a = 0; a < axes; ++a) {
    const auto functions = static_cast<float>(basis.axes[a].functions());
    if (terms.cols() == 0 ||
        !((terms.row(a).array() >= 0.0F) && (terms.row(a).array() < functions)).all()) {
      reader.fail("holds a basis with a term out of range");
    }
  }
  basis.terms = terms.cast<int>();
  basis.projection = take_matrix(reader, -1, terms.cols());
  basis.eigenvalues = take_vector(reader, basis.projection.rows());
  return basis;
}

}  // namespace vantage
