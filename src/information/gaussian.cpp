#include "vantage/information/gaussian.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace vantage {
namespace {

void require_gaussian(const DiagonalGaussian& g, std::string_view function, std::string_view name) {
  if (g.mean.size() == 0 || g.mean.size() != g.variance.size()) {
    throw DistributionError(fmt::format("{}: {} has {} means and {} variances", function, name,
                                        g.mean.size(), g.variance.size()));
  }
  for (Eigen::Index i = 0; i < g.mean.size(); ++i) {
    if (!std::isfinite(g.mean[i])) {
      throw DistributionError(
          fmt::format("{}: {}.mean[{}] = {} is not finite", function, name, i, g.mean[i]));
    }
    if (!(g.variance[i] > 0.0 && std::isfinite(g.variance[i]))) {
      throw DistributionError(fmt::format("{}: {}.variance[{}] = {} must be above 0", function,
                                          name, i, g.variance[i]));
    }
  }
}

void require_pair(const DiagonalGaussian& p, const DiagonalGaussian& q, std::string_view function) {
  require_gaussian(p, function, "p");
  require_gaussian(q, function, "q");
  if (p.mean.size() != q.mean.size()) {
    throw DistributionError(
        fmt::format("{}: p has {} dimensions, q has {}", function, p.mean.size(), q.mean.size()));
  }
}

}  // namespace

double gaussian_kl_divergence_nats(const DiagonalGaussian& p, const DiagonalGaussian& q) {
  require_pair(p, q, "gaussian_kl_divergence_nats");
  const Eigen::ArrayXd ratio = p.variance.array() / q.variance.array();
  const Eigen::ArrayXd offset = (p.mean - q.mean).array().square() / q.variance.array();
  return std::max(0.5 * (ratio + offset - 1.0 - ratio.log()).sum(), 0.0);
}

double gaussian_kl_divergence_bits(const DiagonalGaussian& p, const DiagonalGaussian& q) {
  return bits_from_nats(gaussian_kl_divergence_nats(p, q));
}

double gaussian_jeffreys_divergence_nats(const DiagonalGaussian& p, const DiagonalGaussian& q) {
  require_pair(p, q, "gaussian_jeffreys_divergence_nats");
  const Eigen::ArrayXd vp = p.variance.array();
  const Eigen::ArrayXd vq = q.variance.array();
  const Eigen::ArrayXd offset = (p.mean - q.mean).array().square() * (1.0 / vp + 1.0 / vq);
  return std::max(0.5 * (vp / vq + vq / vp - 2.0 + offset).sum(), 0.0);
}

double gaussian_jeffreys_divergence_bits(const DiagonalGaussian& p, const DiagonalGaussian& q) {
  return bits_from_nats(gaussian_jeffreys_divergence_nats(p, q));
}

double gaussian_bhattacharyya_distance_nats(const DiagonalGaussian& p, const DiagonalGaussian& q) {
  require_pair(p, q, "gaussian_bhattacharyya_distance_nats");
  const Eigen::ArrayXd vp = p.variance.array();
  const Eigen::ArrayXd vq = q.variance.array();
  const Eigen::ArrayXd offset = 0.25 * (p.mean - q.mean).array().square() / (vp + vq);
  const Eigen::ArrayXd spread = 0.5 * ((vp / vq).sqrt() + (vq / vp).sqrt());
  return std::max((offset + 0.5 * spread.log()).sum(), 0.0);
}

double gaussian_bhattacharyya_distance_bits(const DiagonalGaussian& p, const DiagonalGaussian& q) {
  return bits_from_nats(gaussian_bhattacharyya_distance_nats(p, q));
}

}  // namespace vantage
