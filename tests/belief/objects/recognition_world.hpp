/// Small databases of objects for the tests of recognition, and transitions written out in full.
#pragma once

#include <Eigen/Core>
#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "vantage/belief/objects/transition.hpp"
#include "vantage/core/rng.hpp"

namespace vantage::test {

/// Object k is of category `category_of[k]`.
inline ObjectStates make_states(const std::vector<int>& category_of, int bins) {
  ObjectStates states;
  states.bins = bins;
  states.category_of = category_of;
  for (std::size_t k = 0; k < category_of.size(); ++k) {
    states.objects.push_back("object_" + std::to_string(k));
    while (static_cast<int>(states.categories.size()) <= category_of[k]) {
      states.categories.push_back("category_" + std::to_string(states.categories.size()));
    }
  }
  return states;
}

inline ObjectStates random_states() {
  const auto objects = *rc::gen::inRange<std::size_t>(1, 6);
  const auto category_of = *rc::gen::container<std::vector<int>>(objects, rc::gen::inRange(0, 3));
  return make_states(category_of, *rc::gen::inRange(1, 6));
}

inline Rng random_generator() { return Rng(*rc::gen::arbitrary<std::uint64_t>()); }

/// Log weights over many orders of magnitude, one in five of them -inf.
inline Eigen::VectorXd random_logs(int size, Rng& rng) {
  return Eigen::VectorXd::NullaryExpr(size, [&] {
    return rng.uniform() < 0.2 ? -std::numeric_limits<double>::infinity() : rng.normal(0.0, 3.0);
  });
}

/// A random distribution; entries may be zero.
inline Eigen::VectorXd random_masses(int size, Rng& rng) {
  Eigen::VectorXd masses = Eigen::VectorXd::NullaryExpr(
      size, [&] { return rng.uniform() < 0.2 ? 0.0 : rng.uniform(0.01, 1.0); });
  masses[0] += 0.01;
  return masses / masses.sum();
}

inline TransitionKernel random_kernel(int bins, Rng& rng) {
  const Eigen::VectorXd outcomes = random_masses(3, rng);
  return {.bin_change = random_masses(bins, rng),
          .same_object = outcomes[0],
          .other_instance = outcomes[1],
          .other_category = outcomes[2]};
}

/// A_ij by its definition, from state i (row) to state j (column).
inline Eigen::MatrixXd dense(const ObjectStates& states, const TransitionKernel& kernel) {
  const auto category = [&](int object) {
    return states.category_of[static_cast<std::size_t>(object)];
  };
  Eigen::MatrixXd a(states.size(), states.size());
  for (int i = 0; i < states.size(); ++i) {
    const int from = states.object_of(i);
    int instances = 0;
    int others = 0;
    for (int k = 0; k < states.object_count(); ++k) {
      if (k != from) ++(category(k) == category(from) ? instances : others);
    }
    const double same = kernel.same_object + (instances == 0 ? kernel.other_instance : 0.0) +
                        (others == 0 ? kernel.other_category : 0.0);
    for (int j = 0; j < states.size(); ++j) {
      const int to = states.object_of(j);
      const int change = (states.bin_of(j) - states.bin_of(i) + states.bins) % states.bins;
      a(i, j) = to == from                       ? same * kernel.bin_change[change]
                : category(to) == category(from) ? kernel.other_instance / (instances * states.bins)
                                                 : kernel.other_category / (others * states.bins);
    }
  }
  return a;
}

/// exp, with zero for -inf.
inline Eigen::VectorXd exp_of(const Eigen::VectorXd& logs) {
  return logs.unaryExpr([](double log) { return std::exp(log); });
}

}  // namespace vantage::test
