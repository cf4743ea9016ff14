#include "vantage/planners/objects/state_divergence.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "vantage/core/error.hpp"
#include "vantage/core/parallel_for.hpp"

namespace vantage {
namespace {

using Lanes = Eigen::Array<float, 8, 1>;
constexpr Eigen::Index kLanes = 8;
constexpr Eigen::Index kFactors = 8;  ///< multiplied before their logarithm is taken
constexpr Eigen::Index kPadding = kLanes * kFactors;
constexpr std::size_t kBlock = 16;  ///< states whose columns stay in cache

/// A feature's model at the states in question, a column each, padded by dimensions in which all
/// states are alike.
struct Columns {
  Eigen::ArrayXXf mean;
  Eigen::ArrayXXf variance;
  Eigen::ArrayXXf precision;
  Eigen::ArrayXXf root_precision;
  Eigen::ArrayXd log_variance;  ///< of each state, summed over dimensions
  double psi = 1.0;
};

Columns columns_of(const ObservationModel& model, std::span<const int> states) {
  const Eigen::Index padded = (model.dimensions() + kPadding - 1) / kPadding * kPadding;
  const auto count = static_cast<Eigen::Index>(states.size());
  Columns columns{.mean = Eigen::ArrayXXf::Zero(padded, count),
                  .variance = Eigen::ArrayXXf::Ones(padded, count),
                  .precision = {},
                  .root_precision = {},
                  .log_variance = Eigen::ArrayXd(count),
                  .psi = model.psi};
  for (Eigen::Index i = 0; i < count; ++i) {
    const int state = states[static_cast<std::size_t>(i)];
    expects(state >= 0 && state < model.states(), "a state the observation model has not");
    columns.mean.col(i).head(model.dimensions()) = model.mean.col(state);
    columns.variance.col(i).head(model.dimensions()) = model.variance.col(state);
    columns.log_variance[i] = columns.variance.col(i).log().cast<double>().sum();
  }
  columns.precision = columns.variance.inverse();
  columns.root_precision = columns.precision.sqrt();
  return columns;
}

struct BhattacharyyaTerm {
  static constexpr bool symmetric = true;
  double operator()(const Columns& c, Eigen::Index i, Eigen::Index j) const {
    Lanes offset = Lanes::Zero();
    Lanes log_spread = Lanes::Zero();
    for (Eigen::Index begin = 0; begin < c.mean.rows(); begin += kPadding) {
      Lanes spread = Lanes::Ones();
      for (Eigen::Index d = begin; d < begin + kPadding; d += kLanes) {
        const Lanes sum =
            c.variance.col(i).segment<kLanes>(d) + c.variance.col(j).segment<kLanes>(d);
        const Lanes apart = c.mean.col(i).segment<kLanes>(d) - c.mean.col(j).segment<kLanes>(d);
        offset += apart.square() / sum;
        spread *= 0.5F * sum * c.root_precision.col(i).segment<kLanes>(d) *
                  c.root_precision.col(j).segment<kLanes>(d);
      }
      log_spread += spread.log();
    }
    return static_cast<double>(0.25F * offset.sum() + 0.5F * log_spread.sum());
  }
};

struct KullbackLeiblerTerm {
  static constexpr bool symmetric = false;
  double operator()(const Columns& c, Eigen::Index i, Eigen::Index j) const {
    Lanes sum = Lanes::Zero();
    for (Eigen::Index d = 0; d < c.mean.rows(); d += kLanes) {
      const Lanes apart = c.mean.col(i).segment<kLanes>(d) - c.mean.col(j).segment<kLanes>(d);
      sum += (c.variance.col(i).segment<kLanes>(d) - c.variance.col(j).segment<kLanes>(d) +
              apart.square()) *
             c.precision.col(j).segment<kLanes>(d);
    }
    return 0.5 * (static_cast<double>(sum.sum()) + c.log_variance[j] - c.log_variance[i]);
  }
};

/// -ln N(mean_i; mean_j, variance_j) up to a constant.
struct SurpriseAtMeanTerm {
  static constexpr bool symmetric = false;
  double operator()(const Columns& c, Eigen::Index i, Eigen::Index j) const {
    Lanes sum = Lanes::Zero();
    for (Eigen::Index d = 0; d < c.mean.rows(); d += kLanes) {
      const Lanes apart = c.mean.col(i).segment<kLanes>(d) - c.mean.col(j).segment<kLanes>(d);
      sum += apart.square() * c.precision.col(j).segment<kLanes>(d);
    }
    return 0.5 * (static_cast<double>(sum.sum()) + c.log_variance[j]);
  }
};

/// Adds psi times the term of every pair, block by block. A symmetric term of itself is 0.
template <class Term>
void add_pairs(const Term& term, const Columns& columns, int threads, Eigen::MatrixXf& sum) {
  const auto count = static_cast<std::size_t>(sum.cols());
  const std::size_t blocks = (count + kBlock - 1) / kBlock;
  const auto add = [&](std::size_t i, std::size_t j) {
    const auto row = static_cast<Eigen::Index>(i);
    const auto column = static_cast<Eigen::Index>(j);
    const auto nats = static_cast<float>(columns.psi * term(columns, row, column));
    sum(row, column) += nats;
    if constexpr (Term::symmetric) {
      if (i != j) sum(column, row) += nats;
    }
  };
  parallel_for(blocks, threads, [&](std::size_t block) {
    const std::size_t last = std::min(count, (block + 1) * kBlock);
    for (std::size_t other = Term::symmetric ? block : 0; other < blocks; ++other) {
      const std::size_t end = std::min(count, (other + 1) * kBlock);
      for (std::size_t i = block * kBlock; i < last; ++i) {
        const std::size_t begin = other * kBlock;
        for (std::size_t j = Term::symmetric ? std::max(i, begin) : begin; j < end; ++j) add(i, j);
      }
    }
  });
}

template <class Term>
Eigen::MatrixXf summed(const Term& term, FeatureModels features, std::span<const int> states,
                       int threads) {
  const auto count = static_cast<Eigen::Index>(states.size());
  Eigen::MatrixXf sum = Eigen::MatrixXf::Zero(count, count);
  for (const ObservationModel* model : features) {
    if (model->psi > 0.0) add_pairs(term, columns_of(*model, states), threads, sum);
  }
  return sum;
}

}  // namespace

Eigen::MatrixXf state_divergences(Divergence divergence, FeatureModels features,
                                  std::span<const int> states, int threads) {
  Eigen::MatrixXf nats = divergence == Divergence::bhattacharyya
                             ? summed(BhattacharyyaTerm{}, features, states, threads)
                             : summed(KullbackLeiblerTerm{}, features, states, threads);
  nats = nats.cwiseMax(0.0F);
  nats.diagonal().setZero();
  return nats;
}

Eigen::MatrixXf divergence_table(Divergence divergence, const ObservationModel& model,
                                 int threads) {
  std::vector<int> all(static_cast<std::size_t>(model.states()));
  std::iota(all.begin(), all.end(), 0);
  const ObservationModel* const feature = &model;
  return state_divergences(divergence, {&feature, 1}, all, threads);
}

Eigen::MatrixXf rows_and_columns(const Eigen::MatrixXf& table, std::span<const int> states) {
  return table(states, states);
}

Eigen::MatrixXf log_likelihoods_at_means(FeatureModels features, std::span<const int> states) {
  Eigen::MatrixXf log_p = -summed(SurpriseAtMeanTerm{}, features, states, 1);
  for (const ObservationModel* model : features) {
    if (model->psi == 0.0 || model->log_factor.size() == 0) continue;
    const Eigen::VectorXd factor = model->psi * model->log_factor(states);
    log_p.rowwise() += factor.transpose().cast<float>();
  }
  return log_p;
}

}  // namespace vantage
