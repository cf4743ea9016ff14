/// Who works on a study: a process on some machine, maybe of a Slurm job.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

namespace vantage {

/// A task of a Slurm job; a requeued task is the same with one more restart.
struct SlurmPlace {
  std::string cluster;
  std::string job;   ///< of the array, if it is one
  std::string task;  ///< index in the array; empty if the job is none
  int restart = 0;
  /// "12_3", or "12" where there is no array.
  [[nodiscard]] std::string id() const { return task.empty() ? job : job + "_" + task; }
  [[nodiscard]] bool same_task(const SlurmPlace& other) const {
    return cluster == other.cluster && job == other.job && task == other.task;
  }
};

struct Worker {
  std::string host;  ///< name of the machine, or of the Slurm node
  /// Equal for two workers exactly if each sees the other's process; empty if that is not known.
  std::string machine;
  long pid = 0;
  std::string started;  ///< of the process, in ticks since boot: tells it from a later one
  std::optional<SlurmPlace> slurm;
};

/// This process, by the environment and /proc.
Worker this_worker();

/// Whether the worker's process is there. @param worker of this machine
bool process_lives(const Worker& worker);

nlohmann::ordered_json worker_json(const Worker& worker);
/// A field that is missing stays empty.
Worker worker_of(const nlohmann::ordered_json& json);

}  // namespace vantage
