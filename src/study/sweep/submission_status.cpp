// What Slurm and the claims say of a study.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <map>

#include "vantage/study/sweep/attempt.hpp"
#include "vantage/study/sweep/submission.hpp"

namespace vantage {
namespace {
using Json = nlohmann::ordered_json;

std::string small_letters(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// How many tasks of a job are in each state, and why.
struct JobCount {
  std::size_t running = 0;
  std::size_t queued = 0;
  std::map<std::string, std::size_t> lost;  ///< by state: failed, node_fail, timeout
  std::map<std::string, std::size_t> reasons_to_wait;
  std::size_t requeued = 0;  ///< of those above that were lost before
};

JobCount count(const std::string& job, const SlurmQueue& queue) {
  JobCount count;
  for (const SlurmTask& task : queue.tasks) {
    if (task.job != job) continue;
    if (task.restart > 0) ++count.requeued;
    if (is_at_work(task)) {
      ++count.running;
    } else if (is_open(task)) {
      ++count.queued;
      if (!task.reason.empty()) ++count.reasons_to_wait[task.reason];
    } else if (is_lost(task)) {
      ++count.lost[small_letters(task.state)];
    }
  }
  return count;
}

std::string by_name(const std::map<std::string, std::size_t>& counts) {
  std::vector<std::string> parts;
  for (const auto& [name, number] : counts) parts.push_back(fmt::format("{} {}", number, name));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string count_text(const JobCount& count, std::size_t tasks) {
  std::vector<std::string> parts;
  if (count.running > 0) parts.push_back(fmt::format("{} running", count.running));
  if (count.queued > 0) {
    const std::string why = by_name(count.reasons_to_wait);
    parts.push_back(fmt::format("{} queued{}", count.queued, why.empty() ? "" : " (" + why + ")"));
  }
  std::size_t lost = 0;
  for (const auto& [state, number] : count.lost) lost += number;
  if (lost > 0) parts.push_back(by_name(count.lost));
  const std::size_t known = count.running + count.queued + lost;
  if (tasks > known) parts.push_back(fmt::format("{} ended", tasks - known));
  if (count.requeued > 0) parts.push_back(fmt::format("{} requeued before", count.requeued));
  return fmt::format("{}", fmt::join(parts, ", "));
}

Json count_json(const std::string& job, const SlurmQueue& queue, std::size_t tasks) {
  const JobCount found = count(job, queue);
  std::size_t lost = 0;
  for (const auto& [state, number] : found.lost) lost += number;
  return {{"job", job},
          {"tasks", tasks},
          {"running", found.running},
          {"queued", found.queued},
          {"ended", tasks - std::min(tasks, found.running + found.queued + lost)},
          {"lost", found.lost},
          {"requeued", found.requeued},
          {"reasons", found.reasons_to_wait}};
}

std::string place_text(const Worker& worker) {
  if (!worker.slurm) return fmt::format("on {}", worker.host);
  const std::string again =
      worker.slurm->restart == 0 ? "" : fmt::format(", requeued {} times", worker.slurm->restart);
  return fmt::format("on {}, task {}{}", worker.host, worker.slurm->id(),
                     worker.slurm->restart == 1 ? ", requeued once" : again);
}

}  // namespace

std::string submissions_text(const std::vector<Submission>& submissions, const SlurmQueue& queue) {
  if (submissions.empty()) return {};
  if (!queue.silence.empty()) return fmt::format("Slurm does not answer: {}\n", queue.silence);
  std::string lines;
  for (const Submission& submission : submissions) {
    lines += fmt::format(
        "array {}: {}\n", submission.array,
        count_text(count(submission.array, queue), static_cast<std::size_t>(submission.tasks)));
    if (submission.collect.empty()) continue;
    lines += fmt::format("collect {}: {}\n", submission.collect,
                         count_text(count(submission.collect, queue), 1));
  }
  return lines;
}

Json submissions_json(const std::vector<Submission>& submissions, const SlurmQueue& queue) {
  Json json = {{"answers", queue.silence.empty()}, {"silence", queue.silence}};
  json["submissions"] = Json::array();
  for (const Submission& submission : submissions) {
    Json jobs = {
        {"array", count_json(submission.array, queue, static_cast<std::size_t>(submission.tasks))}};
    if (!submission.collect.empty()) jobs["collect"] = count_json(submission.collect, queue, 1);
    json["submissions"].push_back(jobs);
  }
  return json;
}

std::vector<EpisodeActivity> episode_activities(const std::filesystem::path& study_dir,
                                                const std::vector<PlannedEpisode>& plan,
                                                const std::vector<EpisodeState>& states,
                                                const std::vector<Submission>& submissions,
                                                const SlurmQueue& queue) {
  const Worker self = this_worker();
  const bool more_to_come = std::ranges::any_of(queue.tasks, [&](const SlurmTask& task) {
    return is_open(task) &&
           std::ranges::find(submissions, task.job, &Submission::array) != submissions.end();
  });
  std::vector<EpisodeActivity> activities(plan.size());
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (is_result(states[i])) continue;
    const auto claim = claim_in_force(claims_folder(study_dir, plan[i]));
    if (claim && holder_lives(*claim, self, queue)) {
      activities[i] = {"running", place_text(claim->worker)};
    } else if (more_to_come && states[i] != EpisodeState::crashed) {
      const bool lost = claim && !claim->released;
      activities[i] = {"queued", lost ? "was lost " + place_text(claim->worker) : ""};
    }
  }
  return activities;
}

}  // namespace vantage
