/// Slurm by its own commands: sbatch, squeue, scancel.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vantage {

/// A task of an array, or a job that has none.
struct SlurmTask {
  std::string job;
  std::string task;   ///< empty if the job is no array
  std::string state;  ///< PENDING, RUNNING, NODE_FAIL, ...
  std::string reason;
  int restart = 0;
  std::string node;
};

/// A process of it may be at work.
bool is_at_work(const SlurmTask& task);
/// At work, or it will be.
bool is_open(const SlurmTask& task);
/// It ended otherwise than well.
bool is_lost(const SlurmTask& task);

/// What Slurm knows of some jobs; what ended some minutes ago it has forgotten.
struct SlurmQueue {
  std::vector<std::string> jobs;  ///< asked for
  std::vector<SlurmTask> tasks;
  std::string silence;  ///< why Slurm did not answer; empty if it did
};

/// Asks squeue; of no jobs, nobody is asked.
SlurmQueue ask_slurm(std::vector<std::string> jobs);

/// Lines of squeue in the format that ask_slurm() wants.
std::vector<SlurmTask> parse_slurm_tasks(const std::string& text);

/// @throws ConfigError if there is no sbatch on PATH, saying what to install
void require_slurm();

/// Calls sbatch with `--parsable` and these arguments. @returns the job's id
/// @throws ConfigError if there is no sbatch, saying what to install; if it refuses, why
std::string submit_batch(std::vector<std::string> arguments);

/// @throws ConfigError likewise
void cancel_jobs(const std::vector<std::string>& jobs);

}  // namespace vantage
