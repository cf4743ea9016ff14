/// Of two levels of a study, who gets somewhere in more episodes, and who sooner where both do.
#pragma once

#include <optional>
#include <string>

#include "bench/tables/paired_difference.hpp"
#include "bench/tables/study_tables.hpp"

namespace vantage::bench {

struct Race {
  std::size_t arrived = 0;
  std::size_t other_arrived = 0;
  std::size_t episodes = 0;         ///< of each
  std::optional<Difference> pairs;  ///< of those that both got there in; none: no such
  double arrival_p = 1.0;  ///< that it gets there in more of them or in fewer, sign-flip test

  /// It gets there no less often, and in at most `limit` times what the other takes.
  [[nodiscard]] bool is_won_by(double limit) const;
  /// p below kSignificant: that of the pairs, or of the arrivals where only one of them arrives.
  [[nodiscard]] bool is_significant() const;
  /// It gets there no less often, and either sooner, beyond the interval and with p below
  /// kSignificant, or more often with such a p.
  [[nodiscard]] bool is_ahead() const;
  /// "0.54 [0.42, 0.66], 5 pairs, p 0.031; 5 and 6 of 10 get there"
  [[nodiscard]] std::string text() const;
  /// What stands against it: arrivals, the ratio, p. Empty if it is won with p below kSignificant.
  [[nodiscard]] std::string why_lost(double limit) const;
  /// What stands against its being ahead. Empty if it is.
  [[nodiscard]] std::string why_not_ahead() const;
};

/// @throws NotRun unless every episode of both levels was run, and some got there
Race race(const StudyTables& study, const std::string& table, const std::string& panel,
          const std::string& level, const std::string& against);

}  // namespace vantage::bench
