#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace vantage {

/// The sum T of terms that are never negative, estimated: each is s + e, with all s known, and e of
/// a sample alone. The sum of all s and of the sampled e times their weight has no bias, but near
/// T = 0 it may be negative. A zero in its place, or T itself, would keep those estimates that
/// chance put too high and lose those it put too low: a bias of up to 0.4 standard errors.
///
/// So no part of a sample decides about itself. Its halves A and B are estimates of T from terms of
/// their own. T takes the place of A where B is not clear of zero, and that of B where A is not.
/// Whether it does has nothing to do with what it replaces, so that
///   E[A or T] = P(B clear) E[A] + P(B not clear) T = T,
/// and the mean of the two has no bias either. Where both are clear it is the estimate as it was.
struct SampledSum {
  struct Half {
    double estimate = 0.0;
    double variance = 0.0;

    [[nodiscard]] bool clear_of_zero() const {
      constexpr double kStandardErrors = 4.0;
      return estimate >= kStandardErrors * std::sqrt(variance);
    }
  };
  double estimate = 0.0;
  std::array<Half, 2> halves;

  /// Of all terms.
  static SampledSum exact(double sum) { return {sum, {{{sum, 0.0}, {sum, 0.0}}}}; }

  SampledSum& operator+=(const SampledSum& other) {
    estimate += other.estimate;
    for (std::size_t i = 0; i < halves.size(); ++i) {
      halves[i].estimate += other.halves[i].estimate;
      halves[i].variance += other.halves[i].variance;
    }
    return *this;
  }

  [[nodiscard]] bool is_exact() const {
    return halves[0].variance == 0.0 && halves[1].variance == 0.0;
  }
  /// Whether the estimate stands without the exact sum.
  [[nodiscard]] bool is_settled() const {
    return is_exact() || (halves[0].clear_of_zero() && halves[1].clear_of_zero());
  }
  /// What takes the place of an estimate that is not settled. Below zero only where one half is
  /// clear of it by chance alone.
  [[nodiscard]] double settled_by(double exact_sum) const {
    const bool first_clear = halves[0].clear_of_zero();
    if (first_clear == halves[1].clear_of_zero()) return exact_sum;
    return 0.5 * (exact_sum + halves[first_clear ? 1 : 0].estimate);
  }
};

}  // namespace vantage
