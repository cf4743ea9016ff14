#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "python/bindings.hpp"
#include "python/kit/arrays.hpp"
#include "vantage/information/discrete.hpp"
#include "vantage/information/gaussian.hpp"
#include "vantage/information/mixture_bounds.hpp"

namespace vantage::python {
namespace {

std::span<const double> span_of(const Doubles& array) {
  if (array.ndim() != 1) refuse("p", "shape " + shape_text(array) + " is not (n,)");
  return {array.data(), static_cast<std::size_t>(array.size())};
}

using Joint = Eigen::Ref<const Eigen::MatrixXd>;
using GaussianMeasure = double (*)(const DiagonalGaussian&, const DiagonalGaussian&);

void bind_gaussian(py::module_& module, const char* name, GaussianMeasure measure,
                   const char* text) {
  module.def(
      name,
      [measure](const Eigen::VectorXd& mean_p, const Eigen::VectorXd& variance_p,
                const Eigen::VectorXd& mean_q, const Eigen::VectorXd& variance_q) {
        return measure({mean_p, variance_p}, {mean_q, variance_q});
      },
      py::arg("mean_p"), py::arg("variance_p"), py::arg("mean_q"), py::arg("variance_q"), text);
}

}  // namespace

void bind_information(py::module_& module) {
  module.def(
      "entropy_bits", [](const Doubles& p) { return vantage::entropy_bits(span_of(p)); },
      py::arg("p"),
      "H(X) = -sum p log2 p of (n,). Raises DistributionError unless it sums to one.");
  module.def("binary_entropy_bits", py::vectorize(vantage::binary_entropy_bits), py::arg("p"),
             "Of one cell's occupancy; of arrays element by element.");
  module.def(
      "joint_entropy_bits", [](const Joint& p) { return vantage::joint_entropy_bits(p); },
      py::arg("p_xy"), "H(X, Y) of p(x, y), a row per x.");
  module.def(
      "conditional_entropy_bits",
      [](const Joint& p) { return vantage::conditional_entropy_bits(p); }, py::arg("p_xy"),
      "H(Y | X) of p(x, y), a row per x.");
  module.def(
      "mutual_information_bits", [](const Joint& p) { return vantage::mutual_information_bits(p); },
      py::arg("p_xy"), "I(X; Y) of p(x, y), a row per x.");
  module.def(
      "kl_divergence_bits",
      [](const Doubles& p, const Doubles& q) {
        return vantage::kl_divergence_bits(span_of(p), span_of(q));
      },
      py::arg("p"), py::arg("q"), "KL(p || q); inf where some q = 0 and p > 0.");
  module.def(
      "jeffreys_divergence_bits",
      [](const Doubles& p, const Doubles& q) {
        return vantage::jeffreys_divergence_bits(span_of(p), span_of(q));
      },
      py::arg("p"), py::arg("q"), "KL(p || q) + KL(q || p).");
  bind_gaussian(module, "gaussian_kl_divergence_bits", &vantage::gaussian_kl_divergence_bits,
                "KL(p || q) of Gaussians with diagonal covariance; means and variances (d,).");
  bind_gaussian(module, "gaussian_jeffreys_divergence_bits",
                &vantage::gaussian_jeffreys_divergence_bits,
                "KL both ways of Gaussians with diagonal covariance; means and variances (d,).");
  bind_gaussian(module, "gaussian_bhattacharyya_distance_bits",
                &vantage::gaussian_bhattacharyya_distance_bits,
                "Bhattacharyya distance of Gaussians with diagonal covariance; (d,) each.");
  module.def(
      "pairwise_information_bits",
      [](const Doubles& b, const Eigen::MatrixXf& D) {
        return vantage::pairwise_information_bits(span_of(b), D);
      },
      py::arg("b"), py::arg("D"),
      "-sum_i b_i log2 sum_j b_j exp(-D_ij): of Bhattacharyya distances D (n, n), nats, a lower "
      "bound "
      "of what an observation tells of its component, of KL divergences an upper one. "
      "[KolchinskyTracey2017]");
}

}  // namespace vantage::python
