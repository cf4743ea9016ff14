#include "vantage/perception/features/patches/product_basis.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "vantage/perception/features/patches/kernel_descriptor.hpp"

namespace vantage {
namespace {

/// The doubly centred Gram matrix of all combinations of basis points, without any structure.
Eigen::MatrixXd centred_gram(const std::vector<BasisAxis>& axes) {
  Eigen::MatrixXd gram = Eigen::MatrixXd::Ones(1, 1);
  for (const BasisAxis& axis : axes) {
    const Eigen::Index n = axis.points.size();
    Eigen::MatrixXd longer(gram.rows() * n, gram.cols() * n);
    for (Eigen::Index i = 0; i < longer.rows(); ++i) {
      for (Eigen::Index j = 0; j < longer.cols(); ++j) {
        longer(i, j) = gram(i / n, j / n) * axis.kernel(axis.points[i % n], axis.points[j % n]);
      }
    }
    gram = std::move(longer);
  }
  const Eigen::MatrixXd centring =
      Eigen::MatrixXd::Identity(gram.rows(), gram.cols()).array() - 1.0 / gram.rows();
  return centring * gram * centring;
}

/// Kernels of `values` with all combinations of basis points.
Eigen::VectorXd joint_kernels(const std::vector<BasisAxis>& axes, std::span<const double> values) {
  Eigen::VectorXd joint = Eigen::VectorXd::Ones(1);
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const Eigen::Index n = axes[a].points.size();
    Eigen::VectorXd longer(joint.size() * n);
    for (Eigen::Index i = 0; i < longer.size(); ++i) {
      longer[i] = joint[i / n] * axes[a].kernel(values[a], axes[a].points[i % n]);
    }
    joint = std::move(longer);
  }
  return joint;
}

const std::vector<BasisAxis> kSmall{even_axis(4, -1.0, 1.0, 5.0), bits_axis(3, 0.7),
                                    even_axis(3, 0.0, 1.0, 3.0)};

TEST(ProductBasis, EigenvaluesAreThoseOfTheWholeGramMatrix) {
  const ProductBasis basis = make_product_basis(kSmall, 20);
  const Eigen::VectorXd expected =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(centred_gram(kSmall)).eigenvalues().reverse();
  ASSERT_EQ(basis.rows(), 20);
  for (Eigen::Index i = 0; i < 20; ++i) {
    EXPECT_NEAR(basis.eigenvalues[i], expected[i], 1e-2 * expected[0]) << i;
  }
}

// With all products among the candidates, inner products of descriptors are those that the leading
// eigenvectors of the whole matrix give; they do not depend on a choice of eigenvectors.
TEST(ProductBasis, DescriptorsAreThoseOfTheWholeGramMatrix) {
  const ProductBasis basis = make_product_basis(kSmall, 96);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(centred_gram(kSmall));
  const Eigen::MatrixXd e = solver.eigenvectors().rightCols(basis.rows());
  const std::array<std::array<double, 3>, 3> elements{
      {{-0.7, 5.0, 0.2}, {0.4, 1.0, 0.9}, {0.4, 6.0, 0.25}}};
  for (const auto& a : elements) {
    for (const auto& b : elements) {
      const double expected =
          (e.transpose() * joint_kernels(kSmall, a)).dot(e.transpose() * joint_kernels(kSmall, b));
      EXPECT_NEAR(basis.describe(a).dot(basis.describe(b)), expected, 2e-3 * std::abs(expected));
    }
  }
}

TEST(ProductBasis, ValuesBeyondAnAxisCountAsItsEnds) {
  const ProductBasis basis = make_product_basis(kSmall, 20);
  EXPECT_EQ(basis.describe(std::array{-9.0, 0.0, 9.0}), basis.describe(std::array{-1.0, 0.0, 1.0}));
}

TEST(ProductBasis, ComesBackFromBytesAndDamageIsNoticed) {
  const ProductBasis basis = make_product_basis(kSmall, 20);
  std::string bytes;
  put_basis(bytes, basis);
  ByteReader reader(bytes, "x");
  const ProductBasis back = take_basis(reader);
  reader.finish();
  const std::array<double, 3> element{0.3, 2.0, 0.6};
  EXPECT_EQ(basis.describe(element), back.describe(element));
  for (std::size_t size = 0; size < bytes.size(); size += 997) {
    ByteReader shorter(std::string_view(bytes).substr(0, size), "x");
    EXPECT_THROW(take_basis(shorter), InputError) << size;
  }
}

class BasisOfKind : public testing::TestWithParam<PatchKind> {};

TEST_P(BasisOfKind, RowsAreOrthonormalAndEigenvaluesDescend) {
  const int rows = row_of(GetParam()).rows;
  const ProductBasis basis = make_product_basis(basis_axes(GetParam()), rows);
  ASSERT_LE(basis.rows(), rows);
  const Eigen::MatrixXf products = basis.projection * basis.projection.transpose();
  EXPECT_TRUE(products.isIdentity(1e-4F));
  for (Eigen::Index i = 1; i < basis.rows(); ++i) {
    EXPECT_LE(basis.eigenvalues[i], basis.eigenvalues[i - 1]);
  }
  EXPECT_GT(basis.eigenvalues[basis.rows() - 1], 0.0F);
  for (const auto& row : basis.projection.rowwise()) {
    EXPECT_GE(row.maxCoeff(), -row.minCoeff() - 1e-5F) << "a sign is no matter of luck";
  }
}
INSTANTIATE_TEST_SUITE_P(All, BasisOfKind,
                         testing::Values(PatchKind::rgb_gradient, PatchKind::lbp,
                                         PatchKind::normalised_rgb, PatchKind::normal_spin,
                                         PatchKind::size),
                         [](const auto& info) { return std::string(row_of(info.param).name); });

TEST(ProductBasis, IsSolvedForAmongHalfMoreProductsThanRows) {
  const ProductBasis basis = make_product_basis(kSmall, 20);
  EXPECT_EQ(basis.terms.cols(), 30);
  ASSERT_EQ(basis.terms.rows(), 3);
  ASSERT_EQ(basis.axes.size(), 3U);
  for (std::size_t a = 0; a < 3; ++a) {
    EXPECT_EQ(basis.axes[a].functions(),
              basis.terms.row(static_cast<Eigen::Index>(a)).maxCoeff() + 1)
        << "no function that no product has";
  }
}

/// Two axes of two points. The eigenvalues of the first are as 3 to 1, so that of the four products
/// one has that share of the greatest, one a third of it.
TEST(ProductBasis, ProductsBelowATenMillionthOfTheGreatestAreLeftOut) {
  const auto products = [](double share) {
    const std::vector<BasisAxis> axes{even_axis(2, 0.0, 1.0, std::log(2.0)),
                                      even_axis(2, 0.0, 1.0, 2.0 * share)};
    return make_product_basis(axes, 4).terms.cols();
  };
  EXPECT_EQ(products(0.75e-7), 2);
  EXPECT_EQ(products(1.25e-7), 3);
}

/// Bytes of a basis with so many axes alike, of two functions each.
struct BasisInBytes {
  std::uint32_t axes = 2;
  double low = -1.0;
  double per_unit = 4.0;
  Eigen::Index samples = 5;
  float term = 1.0F;
  Eigen::Index terms = 3;

  [[nodiscard]] std::string why_not() const {
    std::string bytes;
    put(bytes, axes);
    for (std::uint32_t a = 0; a < axes; ++a) {
      put(bytes, low);
      put(bytes, per_unit);
      put_matrix(bytes, Eigen::MatrixXf::Ones(2, samples));
    }
    put_matrix(bytes, Eigen::MatrixXf::Constant(axes, terms, term));
    put_matrix(bytes, Eigen::MatrixXf::Ones(1, terms));
    put_matrix(bytes, Eigen::MatrixXf::Ones(1, 1));
    ByteReader reader(bytes, "x");
    try {
      (void)take_basis(reader);
      reader.finish();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
};

TEST(ProductBasis, BytesOfNoBasisAreRefused) {
  const auto refuses = [](const BasisInBytes& basis, const std::string& why) {
    EXPECT_NE(basis.why_not().find(why), std::string::npos) << why << ": " << basis.why_not();
  };
  EXPECT_EQ(BasisInBytes{}.why_not(), "");
  EXPECT_EQ(BasisInBytes{.axes = 1}.why_not(), "");
  EXPECT_EQ(BasisInBytes{.axes = 16}.why_not(), "");
  EXPECT_EQ(BasisInBytes{.term = 0.0F}.why_not(), "");
  refuses({.axes = 0}, "without axes, or of too many");
  refuses({.axes = 17}, "without axes, or of too many");
  refuses({.low = std::numeric_limits<double>::infinity()}, "an empty axis");
  refuses({.per_unit = 0.0}, "an empty axis");
  refuses({.samples = 0}, "an empty axis");
  refuses({.term = -1.0F}, "a term out of range");
  refuses({.term = 2.0F}, "a term out of range");
  refuses({.terms = 0}, "a term out of range");
}

TEST(KernelDescriptor, BytesOfAnotherDescriptorAreRefused) {
  const ProductBasis basis = make_product_basis(basis_axes(PatchKind::size), 5);
  const auto why_not = [&](PatchKind kind, Eigen::Index rows) -> std::string {
    std::string bytes;
    put_basis(bytes, basis);
    put_options(bytes, MatchOptions{.levels = 1});
    put_matrix(bytes, Eigen::MatrixXf::Ones(rows, 4));  // words
    put_matrix(bytes, Eigen::MatrixXf::Ones(2, 4));     // components
    put_matrix(bytes, Eigen::MatrixXf::Ones(4, 1));     // their mean
    ByteReader reader(bytes, "x");
    try {
      (void)take_kernel_descriptor(kind, reader);
      reader.finish();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(why_not(PatchKind::size, basis.rows()), "");
  EXPECT_EQ(why_not(PatchKind::size, basis.rows() + 1), "x: holds words of another basis");
  EXPECT_EQ(why_not(PatchKind::size, 0), "x: holds a vocabulary without words");
  EXPECT_EQ(why_not(PatchKind::lbp, basis.rows()), "x: holds the basis of another feature");
}

}  // namespace
}  // namespace vantage
