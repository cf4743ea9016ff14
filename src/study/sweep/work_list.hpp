/// Which episode a worker takes next.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "vantage/study/sweep/attempt.hpp"
#include "vantage/study/sweep/sweep.hpp"

namespace vantage {

class WorkList {
 public:
  /// Of what has no result yet. The states of what others finish meanwhile are kept up to date.
  WorkList(const std::vector<PlannedEpisode>& plan, const StudySweepOptions& options,
           std::vector<EpisodeState>& states);

  struct Taken {
    std::size_t episode;  ///< index into the plan
    Attempt attempt;
  };
  /// The next episode that nobody else is at, claimed; nothing if there is none for now.
  std::optional<Taken> take();

  /// Takes no more.
  void close();
  /// Nobody is known to be at these.
  [[nodiscard]] std::size_t open() const { return open_.size(); }
  /// Others are at these.
  [[nodiscard]] const std::vector<std::size_t>& held() const { return held_; }

  ResultCheck& check() { return check_; }

 private:
  std::optional<Taken> try_take(std::size_t episode);
  /// Those whose holder is gone are open again.
  void look_at_held();
  [[nodiscard]] bool stands(EpisodeState state, const std::optional<Claim>& claim) const;
  [[nodiscard]] std::optional<Claim> claim_on(std::size_t episode) const;

  const std::vector<PlannedEpisode>& plan_;
  const StudySweepOptions& options_;
  std::vector<EpisodeState>& states_;
  Worker self_ = this_worker();
  ResultCheck check_;
  std::deque<std::size_t> open_;
  std::vector<std::size_t> held_;
  std::optional<double> looked_s_;
  std::vector<int> lost_;  ///< of each episode, the claim whose holder is gone; 0: none
};

}  // namespace vantage
