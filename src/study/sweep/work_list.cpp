#include "vantage/study/sweep/work_list.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>

#include "vantage/core/log.hpp"

namespace vantage {
namespace {

constexpr double kLookEvery_s = 5.0;

std::size_t number_from_environment(const char* name) {
  const char* text = std::getenv(name);
  std::size_t number = 0;
  if (text != nullptr) std::from_chars(text, text + std::strlen(text), number);
  return number;
}

/// Tasks of an array that begin at one end all ask for the same episodes.
std::size_t first_of_task(std::size_t episodes) {
  const std::size_t count = number_from_environment("SLURM_ARRAY_TASK_COUNT");
  if (count == 0) return 0;
  const std::size_t task = number_from_environment("SLURM_ARRAY_TASK_ID") -
                           number_from_environment("SLURM_ARRAY_TASK_MIN");
  return task % count * episodes / count;
}

}  // namespace

WorkList::WorkList(const std::vector<PlannedEpisode>& plan, const StudySweepOptions& options,
                   std::vector<EpisodeState>& states)
    : plan_(plan), options_(options), states_(states), lost_(plan.size(), 0) {
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (!is_result(states[i])) open_.push_back(i);
  }
  const auto first = static_cast<std::ptrdiff_t>(first_of_task(open_.size()));
  std::rotate(open_.begin(), open_.begin() + first, open_.end());
}

std::optional<Claim> WorkList::claim_on(std::size_t episode) const {
  return claim_in_force(claims_folder(options_.directory, plan_[episode]));
}

std::optional<WorkList::Taken> WorkList::take() {
  for (int round = 0; round < 2; ++round) {
    while (!open_.empty()) {
      const std::size_t episode = open_.front();
      open_.pop_front();
      if (auto taken = try_take(episode)) return taken;
    }
    if (held_.empty() || (looked_s_ && wall_s() - *looked_s_ < kLookEvery_s)) break;
    look_at_held();
  }
  return std::nullopt;
}

void WorkList::close() {
  open_.clear();
  held_.clear();
}

std::optional<WorkList::Taken> WorkList::try_take(std::size_t episode) {
  const auto claim = claim_on(episode);
  const int number = claim ? claim->number : 0;
  EpisodeState& state = states_[episode];
  state = check_(options_.directory, plan_[episode]);
  if (stands(state, claim)) return std::nullopt;
  if (claim && !claim->released && lost_[episode] != number) {
    held_.push_back(episode);
    return std::nullopt;
  }
  auto attempt = Attempt::begin(options_.directory, plan_[episode], number + 1, self_);
  if (!attempt) {
    held_.push_back(episode);
    return std::nullopt;
  }
  state = check_(options_.directory, plan_[episode]);  // may have come just before the claim
  if (!is_result(state)) return Taken{episode, std::move(*attempt)};
  attempt->drop();
  return std::nullopt;
}

bool WorkList::stands(EpisodeState state, const std::optional<Claim>& claim) const {
  if (is_result(state)) return true;
  if (state != EpisodeState::crashed) return false;
  const bool in_this_array = claim && claim->released && claim->worker.slurm && self_.slurm &&
                             claim->worker.slurm->cluster == self_.slurm->cluster &&
                             claim->worker.slurm->job == self_.slurm->job;
  return in_this_array || !options_.retry_crashed;
}

void WorkList::look_at_held() {
  looked_s_ = wall_s();
  std::vector<std::string> jobs;
  std::vector<std::optional<Claim>> claims;
  for (const std::size_t episode : held_) {
    claims.push_back(claim_on(episode));
    const auto& slurm = claims.back() ? claims.back()->worker.slurm : std::nullopt;
    // Of another cluster the ids mean nothing here.
    if (slurm && self_.slurm && slurm->cluster == self_.slurm->cluster) jobs.push_back(slurm->job);
  }
  const SlurmQueue queue = ask_slurm(std::move(jobs));
  std::vector<std::size_t> still_held;
  for (std::size_t h = 0; h < held_.size(); ++h) {
    const std::size_t episode = held_[h];
    if (claims[h] && holder_lives(*claims[h], self_, queue)) {
      still_held.push_back(episode);
      continue;
    }
    if (claims[h]) lost_[episode] = claims[h]->number;
    open_.push_back(episode);
  }
  held_ = std::move(still_held);
}

}  // namespace vantage
