#include "vantage/belief/objects/transition_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using Logs = Eigen::Ref<const Eigen::VectorXd>;
using LogVector = Eigen::VectorXd;

constexpr double kImpossible = -std::numeric_limits<double>::infinity();

double log_add(double a, double b) {
  const double larger = std::max(a, b);
  return larger == kImpossible ? kImpossible
                               : larger + std::log1p(std::exp(std::min(a, b) - larger));
}

double log_sum(const Logs& logs) {
  const double largest = logs.size() > 0 ? logs.maxCoeff() : kImpossible;
  return largest == kImpossible ? kImpossible
                                : largest + std::log((logs.array() - largest).exp().sum());
}

/// ln of the sum of all entries but one, for each; nothing is subtracted, so nothing cancels.
LogVector log_sums_of_others(const Logs& logs) {
  const Eigen::Index size = logs.size();
  LogVector others = LogVector::Constant(size, kImpossible);
  double before = kImpossible;
  for (Eigen::Index i = 0; i < size; ++i) {
    others[i] = before;
    before = log_add(before, logs[i]);
  }
  double after = kImpossible;
  for (Eigen::Index i = size; i-- > 0;) {
    others[i] = log_add(others[i], after);
    after = log_add(after, logs[i]);
  }
  return others;
}

/// ln A_ij by what j is to i; they depend on the category of i alone.
struct CategoryWeights {
  LogVector same_object;     ///< times bin_change
  LogVector other_instance;  ///< to each state of the group
  LogVector other_category;
};

CategoryWeights weights_of(const ObjectStates& states, const TransitionKernel& kernel) {
  std::vector<int> members(states.categories.size(), 0);
  for (const int category : states.category_of) ++members[static_cast<std::size_t>(category)];
  const auto categories = static_cast<Eigen::Index>(members.size());
  CategoryWeights weights{.same_object = LogVector(categories),
                          .other_instance = LogVector(categories),
                          .other_category = LogVector(categories)};
  for (Eigen::Index c = 0; c < categories; ++c) {
    const int instances = members[static_cast<std::size_t>(c)] - 1;
    const int others = states.object_count() - instances - 1;
    double same = kernel.same_object;
    if (instances <= 0) same += kernel.other_instance;
    if (others <= 0) same += kernel.other_category;
    weights.same_object[c] = std::log(same);
    weights.other_instance[c] =
        instances > 0 ? std::log(kernel.other_instance / (instances * states.bins)) : kImpossible;
    weights.other_category[c] =
        others > 0 ? std::log(kernel.other_category / (others * states.bins)) : kImpossible;
  }
  return weights;
}

/// Sums over an object's states, its category's other instances, and the other categories.
struct GroupSums {
  LogVector object;           ///< of each object
  LogVector other_instances;  ///< of each object
  LogVector category;         ///< of each category
};

GroupSums group_sums(const ObjectStates& states, const Logs& logs) {
  GroupSums sums{.object = LogVector(states.object_count()),
                 .other_instances = LogVector(states.object_count()),
                 .category = LogVector(static_cast<Eigen::Index>(states.categories.size()))};
  std::vector<std::vector<int>> members(states.categories.size());
  for (int k = 0; k < states.object_count(); ++k) {
    sums.object[k] = log_sum(logs.segment(states.state(k, 0), states.bins));
    members[static_cast<std::size_t>(states.category_of[static_cast<std::size_t>(k)])].push_back(k);
  }
  for (std::size_t c = 0; c < members.size(); ++c) {
    const LogVector of_members = sums.object(members[c]);
    sums.category[static_cast<Eigen::Index>(c)] = log_sum(of_members);
    sums.other_instances(members[c]) = log_sums_of_others(of_members);
  }
  return sums;
}

int category_of(const ObjectStates& states, int object) {
  return states.category_of[static_cast<std::size_t>(object)];
}

int wrapped_once(int bin, int bins) {
  return bin < 0 ? bin + bins : bin >= bins ? bin - bins : bin;
}

/// ln sum_d bin_change[d] exp(logs[bin + direction * d]) within one object.
double log_bin_sum(const LogVector& log_change, const Logs& logs, int bin, int direction) {
  const int bins = static_cast<int>(log_change.size());
  LogVector terms(bins);
  for (int d = 0; d < bins; ++d) {
    terms[d] = log_change[d] + logs[wrapped_once(bin + direction * d, bins)];
  }
  return log_sum(terms);
}

/// ln sum_q p_q x_{q + d}, for every change of bin d.
LogVector log_pairs_by_change(const Logs& log_p, const Logs& log_x) {
  const int bins = static_cast<int>(log_p.size());
  LogVector pairs(bins);
  LogVector terms(bins);
  for (int d = 0; d < bins; ++d) {
    for (int q = 0; q < bins; ++q) terms[q] = log_p[q] + log_x[wrapped_once(q + d, bins)];
    pairs[d] = log_sum(terms);
  }
  return pairs;
}

/// Adds the moves from one object: `found` says which of three groups they ended in. What a group
/// that is empty for this object left with it was drawn as that group.
void add_outcomes(const TransitionKernel& kernel, const ExpectedMoves& found, bool no_instance,
                  bool no_category, ExpectedMoves& moves) {
  const double instance = no_instance ? kernel.other_instance : 0.0;
  const double category = no_category ? kernel.other_category : 0.0;
  const double all = kernel.same_object + instance + category;
  const double draws = all > 0.0 ? found.same_object / all : 0.0;
  moves.bin_change += found.bin_change;
  moves.same_object += draws * kernel.same_object;
  moves.other_instance += found.other_instance + draws * instance;
  moves.other_category += found.other_category + draws * category;
}

void require_sizes(const ObjectStates& states, const TransitionKernel& kernel, const Logs& logs) {
  expects(logs.size() == states.size(), "a probability for every state");
  expects(kernel.bin_change.size() == states.bins, "a kernel of as many bins");
}

}  // namespace

LogVector transition_forward(const ObjectStates& states, const TransitionKernel& kernel,
                             const Logs& log_p) {
  require_sizes(states, kernel, log_p);
  const CategoryWeights weights = weights_of(states, kernel);
  const GroupSums sums = group_sums(states, log_p);
  const LogVector from_others = log_sums_of_others(sums.category + weights.other_category);
  const LogVector log_change = kernel.bin_change.array().log();
  LogVector moved = log_p;  // what is unknown stays
  for (int k = 0; k < states.object_count(); ++k) {
    const int c = category_of(states, k);
    const double elsewhere =
        log_add(weights.other_instance[c] + sums.other_instances[k], from_others[c]);
    const auto own = log_p.segment(states.state(k, 0), states.bins);
    for (int q = 0; q < states.bins; ++q) {
      const double stays = weights.same_object[c] + log_bin_sum(log_change, own, q, -1);
      moved[states.state(k, q)] = log_add(stays, elsewhere);
    }
  }
  return moved;
}

LogVector transition_backward(const ObjectStates& states, const TransitionKernel& kernel,
                              const Logs& log_x) {
  require_sizes(states, kernel, log_x);
  const CategoryWeights weights = weights_of(states, kernel);
  const GroupSums sums = group_sums(states, log_x);
  const LogVector of_others = log_sums_of_others(sums.category);
  const LogVector log_change = kernel.bin_change.array().log();
  LogVector ahead = log_x;  // what is unknown stays
  for (int k = 0; k < states.object_count(); ++k) {
    const int c = category_of(states, k);
    const double elsewhere = log_add(weights.other_instance[c] + sums.other_instances[k],
                                     weights.other_category[c] + of_others[c]);
    const auto own = log_x.segment(states.state(k, 0), states.bins);
    for (int q = 0; q < states.bins; ++q) {
      const double stays = weights.same_object[c] + log_bin_sum(log_change, own, q, +1);
      ahead[states.state(k, q)] = log_add(stays, elsewhere);
    }
  }
  return ahead;
}

ExpectedMoves expected_moves(const ObjectStates& states, const TransitionKernel& kernel,
                             const Logs& log_p, const Logs& log_x) {
  require_sizes(states, kernel, log_p);
  expects(states.unknown_size() == 0, "moves of known objects");
  const double total = log_sum(log_p + transition_backward(states, kernel, log_x));
  expects(std::isfinite(total), "some move is possible");
  const CategoryWeights weights = weights_of(states, kernel);
  const GroupSums sums = group_sums(states, log_x);
  const LogVector of_others = log_sums_of_others(sums.category);
  const LogVector log_change = kernel.bin_change.array().log();
  ExpectedMoves moves{.bin_change = Eigen::VectorXd::Zero(states.bins)};
  for (int k = 0; k < states.object_count(); ++k) {
    const int c = category_of(states, k);
    const auto p = log_p.segment(states.state(k, 0), states.bins);
    const auto x = log_x.segment(states.state(k, 0), states.bins);
    const LogVector stays = log_pairs_by_change(p, x) + log_change;
    const double log_object = log_sum(p) - total;
    ExpectedMoves found;
    found.bin_change = (stays.array() + (weights.same_object[c] - total)).exp();
    found.same_object = found.bin_change.sum();
    found.other_instance =
        std::exp(log_object + weights.other_instance[c] + sums.other_instances[k]);
    found.other_category = std::exp(log_object + weights.other_category[c] + of_others[c]);
    add_outcomes(kernel, found, weights.other_instance[c] == kImpossible,
                 weights.other_category[c] == kImpossible, moves);
  }
  return moves;
}

}  // namespace vantage
