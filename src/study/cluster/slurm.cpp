#include "vantage/study/cluster/slurm.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <string_view>

#include "vantage/core/error.hpp"
#include "vantage/study/cluster/program.hpp"

namespace vantage {
namespace {

constexpr const char* kFormat =
    "ArrayJobID:|,ArrayTaskID:|,State:|,Reason:|,RestartCnt:|,NodeList:|";
constexpr auto kAtWork =
    std::to_array<std::string_view>({"RUNNING", "COMPLETING", "CONFIGURING", "SUSPENDED", "STOPPED",
                                     "SIGNALING", "STAGE_OUT", "RESIZING"});
constexpr auto kWaiting = std::to_array<std::string_view>(
    {"PENDING", "REQUEUED", "REQUEUE_FED", "REQUEUE_HOLD", "SPECIAL_EXIT", "RESV_DEL_HOLD"});

bool is_one_of(const auto& states, const std::string& state) {
  return std::ranges::find(states, state) != states.end();
}

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::ranges::replace(text, '\n', ';');
  return text;
}

[[noreturn]] void fail_without(const std::string& program) {
  throw ConfigError(program +
                    ": no such program: Slurm's commands are not on PATH; apt-get install "
                    "slurm-client, or use a machine of the cluster");
}

ProgramEnd call(const std::vector<std::string>& command) {
  auto end = run_program(command);
  if (!end) fail_without(command.front());
  if (end->exit_code != 0) {
    const std::string why = one_line(end->errors);
    throw ConfigError(fmt::format("{}: {}", fmt::join(command, " "),
                                  why.empty() ? fmt::format("exit code {}", end->exit_code) : why));
  }
  return *end;
}

}  // namespace

bool is_at_work(const SlurmTask& task) { return is_one_of(kAtWork, task.state); }

bool is_open(const SlurmTask& task) { return is_at_work(task) || is_one_of(kWaiting, task.state); }

bool is_lost(const SlurmTask& task) { return !is_open(task) && task.state != "COMPLETED"; }

std::vector<SlurmTask> parse_slurm_tasks(const std::string& text) {
  std::vector<SlurmTask> tasks;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::array<std::string, 6> fields;
    std::istringstream stream(line);
    for (std::string& field : fields) std::getline(stream, field, '|');
    if (fields[2].empty()) continue;
    SlurmTask task{fields[0], fields[1], fields[2], fields[3], 0, fields[5]};
    if (task.task == "N/A") task.task.clear();
    if (task.reason == "None") task.reason.clear();
    std::from_chars(fields[4].data(), fields[4].data() + fields[4].size(), task.restart);
    tasks.push_back(std::move(task));
  }
  return tasks;
}

SlurmQueue ask_slurm(std::vector<std::string> jobs) {
  std::ranges::sort(jobs);
  jobs.erase(std::unique(jobs.begin(), jobs.end()), jobs.end());
  SlurmQueue queue{std::move(jobs), {}, {}};
  if (queue.jobs.empty()) return queue;
  const auto end = run_program({"squeue", "--noheader", "--array", "--states=all",
                                fmt::format("--jobs={}", fmt::join(queue.jobs, ",")),
                                fmt::format("--Format={}", kFormat)});
  if (!end) {
    queue.silence = "there is no squeue on PATH";
  } else if (end->exit_code == 0) {
    queue.tasks = parse_slurm_tasks(end->output);
  } else if (end->errors.find("Invalid job id") == std::string::npos) {  // it has forgotten all
    queue.silence = one_line(end->errors);
    if (queue.silence.empty()) queue.silence = fmt::format("exit code {}", end->exit_code);
  }
  return queue;
}

void require_slurm() {
  if (!run_program({"sbatch", "--version"})) fail_without("sbatch");
}

std::string submit_batch(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"sbatch", "--parsable"});
  std::string job = one_line(call(arguments).output);
  job = job.substr(0, job.find(';'));  // "12;cluster"
  if (job.empty() || !std::ranges::all_of(job, [](char c) { return c >= '0' && c <= '9'; })) {
    throw ConfigError(fmt::format("{}: no job id but '{}'", fmt::join(arguments, " "), job));
  }
  return job;
}

void cancel_jobs(const std::vector<std::string>& jobs) {
  std::vector<std::string> command{"scancel"};
  command.insert(command.end(), jobs.begin(), jobs.end());
  call(command);
}

}  // namespace vantage
