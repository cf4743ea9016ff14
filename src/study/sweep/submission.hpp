/// A study on a Slurm cluster: an array of tasks that claim its episodes, and a job that collects
/// when they have ended.
///
///   DIR/slurm/<array>.json          a submission: ids of its jobs
///   DIR/slurm/work.sh, collect.sh   what its jobs run
///   DIR/slurm/<array>_<task>.txt    what they said; <job>_collect.txt
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

#include "vantage/study/cluster/slurm.hpp"
#include "vantage/study/results.hpp"

namespace vantage {

struct SubmitOptions {
  std::filesystem::path directory;
  int tasks = 1;
  std::string partition;
  std::string time;  ///< limit of a task
  std::vector<std::string> sbatch_arguments;
  bool keep_states = false;
};

struct Submission {
  std::string array;    ///< job id
  std::string collect;  ///< job id; empty if it was refused
  int tasks = 0;
};

/// Submits both jobs and records them.
/// @throws ConfigError if there is no sbatch or it refuses, OutputError
Submission submit(const SubmitOptions& options);

/// @throws ConfigError naming an argument that submit() needs for itself
void check_sbatch_arguments(const std::vector<std::string>& arguments);

/// Everything that was submitted from a folder, oldest first.
std::vector<Submission> read_submissions(const std::filesystem::path& study_dir);

/// What Slurm knows of them.
SlurmQueue ask_slurm_of(const std::vector<Submission>& submissions);

/// Those of which something is queued or running.
std::vector<Submission> open_submissions(const std::vector<Submission>& submissions,
                                         const SlurmQueue& queue);

/// "array 12: 2 running, 1 queued (BeginTime), 5 ended", a line a job.
std::string submissions_text(const std::vector<Submission>& submissions, const SlurmQueue& queue);
nlohmann::ordered_json submissions_json(const std::vector<Submission>& submissions,
                                        const SlurmQueue& queue);

/// Which episodes are running, by the claims on them, and which are queued, by Slurm.
std::vector<EpisodeActivity> episode_activities(const std::filesystem::path& study_dir,
                                                const std::vector<PlannedEpisode>& plan,
                                                const std::vector<EpisodeState>& states,
                                                const std::vector<Submission>& submissions,
                                                const SlurmQueue& queue);

}  // namespace vantage
