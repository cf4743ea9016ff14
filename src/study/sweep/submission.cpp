#include "vantage/study/sweep/submission.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <string_view>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/log.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/study/sweep/attempt.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// What a task of the array or the dependency on it could not do without.
constexpr auto kOurs = std::to_array<std::string_view>(
    {"--array", "-a", "--dependency", "-d", "--wrap", "--parsable", "--no-requeue", "--test-only",
     "--wait", "-W", "--output", "-o", "--open-mode"});
constexpr auto kClusters = std::to_array<std::string_view>({"--clusters", "--cluster", "-M"});

/// For the shell.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// For sbatch, which replaces %j and the like.
std::string literal(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '%' ? std::string("%%") : std::string(1, c);
  return result;
}

std::string work_script(const SubmitOptions& options) {
  return fmt::format(
      "#!/bin/sh\n# Claims and runs episodes of the study until none is left.\nexec {} sweep work "
      "{}{}\n",
      quoted(fs::read_symlink("/proc/self/exe").string()), quoted(options.directory.string()),
      options.keep_states ? " --keep-states" : "");
}

/// NFS may show a folder as it was up to a minute ago.
std::string collect_script(const SubmitOptions& options) {
  const std::string directory = quoted(options.directory.string());
  return fmt::format(
      "#!/bin/sh\n# Runs when every task of the array has ended, and merges what there is.\ncase "
      "$(stat -f -c %T {0}) in *nfs*) sleep 65 ;; esac\nexec {1} sweep collect {0}\n",
      directory, quoted(fs::read_symlink("/proc/self/exe").string()));
}

/// What both jobs are called with.
std::vector<std::string> common_arguments(const SubmitOptions& options, const std::string& name,
                                          const std::string& output) {
  std::vector<std::string> arguments{
      "--job-name=" + name, "--requeue", "--open-mode=append",
      "--output=" + literal((options.directory / "slurm").string()) + "/" + output};
  if (!options.partition.empty()) arguments.push_back("--partition=" + options.partition);
  if (!options.time.empty()) arguments.push_back("--time=" + options.time);
  arguments.insert(arguments.end(), options.sbatch_arguments.begin(),
                   options.sbatch_arguments.end());
  return arguments;
}

std::string submit_array(const SubmitOptions& options) {
  auto arguments = common_arguments(options, "vantage-sweep", "%A_%a.txt");
  arguments.push_back(fmt::format("--array=0-{}", options.tasks - 1));
  arguments.push_back((options.directory / "slurm/work.sh").string());
  return submit_batch(arguments);
}

std::string submit_collect(const SubmitOptions& options, const std::string& array) {
  auto arguments = common_arguments(options, "vantage-collect", "%j_collect.txt");
  arguments.push_back("--dependency=afterany:" + array);
  arguments.push_back((options.directory / "slurm/collect.sh").string());
  return submit_batch(arguments);
}

/// Ends what is queued already. An error of Slurm is told, not thrown: another came first.
void take_back(const Submission& submission) {
  std::vector<std::string> jobs{submission.array};
  if (!submission.collect.empty()) jobs.insert(jobs.begin(), submission.collect);
  try {
    cancel_jobs(jobs);
  } catch (const Error& error) {
    log_warning(error.what());
  }
}

}  // namespace

void check_sbatch_arguments(const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    if (!argument.starts_with('-')) {
      throw ConfigError(fmt::format(
          "--sbatch-arg {0}: expected an option of sbatch in one piece, such as --mem=2G",
          argument));
    }
    const std::string_view name = std::string_view(argument).substr(0, argument.find('='));
    const bool short_form = argument.size() > 2 && argument[1] != '-';
    const auto is_one = [&](std::string_view other) {
      return name == other || (short_form && other.size() == 2 && name.starts_with(other));
    };
    if (std::ranges::any_of(kClusters, is_one)) {
      throw ConfigError(
          fmt::format("--sbatch-arg {}: jobs of another cluster cannot be followed", argument));
    }
    if (std::ranges::any_of(kOurs, is_one)) {
      throw ConfigError(fmt::format(
          "--sbatch-arg {}: submit sets {} itself{}", argument, name,
          name == "--array" || name == "-a" ? "; --array N is the number of tasks" : ""));
    }
  }
}

Submission submit(const SubmitOptions& options) {
  const fs::path folder = options.directory / "slurm";
  make_writable_directory(folder);
  write_file(folder / "work.sh", work_script(options));
  write_file(folder / "collect.sh", collect_script(options));
  Submission submission{submit_array(options), {}, options.tasks};
  const auto record = [&] {
    const Json json = {
        {"array", submission.array}, {"collect", submission.collect}, {"tasks", submission.tasks}};
    write_file(folder / (submission.array + ".json"), json_text(json));
  };
  try {
    record();  // at once: cancel can end what is queued
    submission.collect = submit_collect(options, submission.array);
    record();
  } catch (const Error&) {
    take_back(submission);
    throw;
  }
  return submission;
}

std::vector<Submission> read_submissions(const fs::path& study_dir) {
  std::vector<Submission> submissions;
  std::error_code error;
  const fs::path folder = study_dir / "slurm";
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (it->path().extension() != ".json") continue;
    const Json json = read_json_or_null(it->path());
    const auto is_text = [&](const char* key) {
      return json.contains(key) && json[key].is_string();
    };
    if (!json.is_object() || !is_text("array") || !is_text("collect") || !json.contains("tasks") ||
        !json["tasks"].is_number_integer()) {
      throw InputError(it->path().string() + ": is no record of a submission; remove it");
    }
    submissions.push_back({json["array"], json["collect"], json["tasks"]});
  }
  std::ranges::sort(submissions, {}, [](const Submission& s) {
    return std::pair(s.array.size(), s.array);  // ids rise
  });
  return submissions;
}

SlurmQueue ask_slurm_of(const std::vector<Submission>& submissions) {
  std::vector<std::string> jobs;
  for (const Submission& submission : submissions) {
    jobs.push_back(submission.array);
    if (!submission.collect.empty()) jobs.push_back(submission.collect);
  }
  return ask_slurm(std::move(jobs));
}

std::vector<Submission> open_submissions(const std::vector<Submission>& submissions,
                                         const SlurmQueue& queue) {
  std::vector<Submission> open;
  for (const Submission& submission : submissions) {
    const bool is = std::ranges::any_of(queue.tasks, [&](const SlurmTask& task) {
      return is_open(task) && (task.job == submission.array || task.job == submission.collect);
    });
    if (is) open.push_back(submission);
  }
  return open;
}

}  // namespace vantage
