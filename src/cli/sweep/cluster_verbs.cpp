#include "vantage/cli/sweep/cluster_verbs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>

#include "vantage/core/log.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/study/sweep/submission.hpp"
#include "vantage/study/sweep/sweep.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

/// @throws ConfigError if something submitted from there is under way, or Slurm cannot say
void require_idle(const fs::path& directory) {
  const auto submissions = read_submissions(directory);
  const SlurmQueue queue = ask_slurm_of(submissions);
  if (!queue.silence.empty()) {
    throw ConfigError(fmt::format("--out {}: was submitted before, and Slurm does not answer: {}",
                                  directory.string(), queue.silence));
  }
  const auto open = open_submissions(submissions, queue);
  if (open.empty()) return;
  std::string state = submissions_text(open, queue);
  state.pop_back();
  for (auto at = state.find('\n'); at != std::string::npos; at = state.find('\n', at)) {
    state.replace(at, 1, "; ");
  }
  throw ConfigError(
      fmt::format("--out {0}: is submitted already: {1}; vantage sweep status {0} shows it, "
                  "vantage sweep cancel {0} ends it",
                  directory.string(), state));
}

std::size_t open_episodes(const fs::path& directory, const Study& study) {
  const auto states = episode_states(directory, plan_study(study));
  return static_cast<std::size_t>(
      std::ranges::count_if(states, [](EpisodeState state) { return !is_result(state); }));
}

void print_submission(const SweepArguments& arguments, const fs::path& directory,
                      const Submission& submission, std::size_t episodes) {
  if (arguments.json) {
    fmt::print("{}", json_text({{"directory", directory.string()},
                                {"episodes", episodes},
                                {"tasks", submission.tasks},
                                {"array", submission.array},
                                {"collect", submission.collect}}));
    return;
  }
  if (submission.tasks == 0) {
    fmt::print(
        "{0}: every episode has a result; nothing is submitted. vantage sweep collect {0} merges "
        "them\n",
        directory.string());
    return;
  }
  fmt::print(
      "{0}: {1} episodes by {2} tasks, array {3}; job {4} collects\nvantage sweep status {0}\n",
      directory.string(), episodes, submission.tasks, submission.array, submission.collect);
}

/// As many as said, else as a task of Slurm was given cores.
int jobs_of(const SweepArguments& arguments) {
  if (arguments.jobs || std::getenv("SLURM_JOB_ID") == nullptr) return jobs_here(arguments);
  int jobs = 1;
  const char* text = std::getenv("SLURM_CPUS_PER_TASK");  // set if it was asked for
  if (text != nullptr) std::from_chars(text, text + std::strlen(text), jobs);
  return std::max(1, jobs);
}

}  // namespace

ExitCode submit_study(const SweepArguments& arguments) {
  check_sbatch_arguments(arguments.sbatch_arguments);
  const OpenedStudy opened = open_study(arguments);
  plan_study(opened.study);  // says what is wrong with it before anything is written
  const fs::path directory = fs::absolute(opened.directory).lexically_normal();
  require_slurm();
  require_idle(opened.directory);
  prepare_study_folder(opened.study,
                       {.directory = opened.directory, .overwrite = arguments.overwrite});
  const std::size_t episodes = open_episodes(directory, opened.study);
  SubmitOptions options{.directory = directory,
                        .tasks = std::min(arguments.tasks, static_cast<int>(episodes)),
                        .partition = arguments.partition,
                        .time = arguments.time,
                        .sbatch_arguments = arguments.sbatch_arguments,
                        .keep_states = arguments.keep_states};
  print_submission(arguments, opened.directory, options.tasks == 0 ? Submission{} : submit(options),
                   episodes);
  return ExitCode::done;
}

ExitCode work_on_study(const SweepArguments& arguments) {
  const OpenedStudy opened = open_study_folder(arguments);
  const bool in_slurm = std::getenv("SLURM_JOB_ID") != nullptr;
  const StudySweepOptions options{.directory = opened.directory,
                                  .jobs = jobs_of(arguments),
                                  .keep_states = arguments.keep_states,
                                  .retry_crashed = in_slurm,
                                  .single_thread = in_slurm};
  catch_interrupts();
  const SweepEnd end = run_sweep(plan_study(opened.study), options);
  const auto completed = std::ranges::count_if(
      end.run, [&](std::size_t episode) { return end.states[episode] == EpisodeState::completed; });
  if (arguments.json) {
    fmt::print("{}", json_text({{"run", end.run.size()}, {"completed", completed}}));
  } else {
    log_info(fmt::format("{} episodes run, {} completed", end.run.size(), completed));
  }
  if (interrupt_signal() != 0) return static_cast<ExitCode>(128 + interrupt_signal());
  return completed == std::ssize(end.run) ? ExitCode::done : ExitCode::goal_failed;
}

ExitCode cancel_study(const SweepArguments& arguments) {
  const fs::path directory = open_study_folder(arguments).directory;
  const auto submissions = read_submissions(directory);
  if (submissions.empty()) {
    throw ConfigError(fmt::format("{}: nothing was submitted from it", directory.string()));
  }
  require_slurm();
  const SlurmQueue queue = ask_slurm_of(submissions);
  if (!queue.silence.empty()) {
    throw ConfigError(
        fmt::format("{}: Slurm does not answer: {}", directory.string(), queue.silence));
  }
  std::vector<std::string> jobs;
  for (const Submission& submission : open_submissions(submissions, queue)) {
    if (!submission.collect.empty()) jobs.push_back(submission.collect);  // first, lest it starts
    jobs.push_back(submission.array);
  }
  if (!jobs.empty()) cancel_jobs(jobs);
  if (arguments.json) {
    fmt::print("{}", json_text({{"cancelled", jobs}}));
  } else if (jobs.empty()) {
    fmt::print("{}: nothing is queued or running\n", directory.string());
  } else {
    fmt::print("{}: cancelled {}; results so far are kept\n", directory.string(),
               fmt::join(jobs, " "));
  }
  return ExitCode::done;
}

}  // namespace vantage
