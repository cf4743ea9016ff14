#include "vantage/study/cluster/worker.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <array>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace vantage {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string() : value;
}

int whole_or_zero(const std::string& text) {
  int number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

std::string host_name() {
  if (const std::string node = environment("SLURMD_NODENAME"); !node.empty()) return node;
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

/// Since this boot and in this namespace of process ids, and on this node: a machine may be
/// several.
std::string machine_name(const std::string& host) {
  std::string boot;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;
  std::error_code error;
  const std::string processes = fs::read_symlink("/proc/self/ns/pid", error).string();
  if (boot.empty() || processes.empty()) return {};
  return fmt::format("{} {} {}", host, boot, processes);
}

/// Field 22 of /proc/PID/stat; empty if there is no such process, or it has ended.
std::string start_of(long pid) {
  std::ifstream stream(fmt::format("/proc/{}/stat", pid));
  std::string line;
  std::getline(stream, line);
  const auto name_end = line.rfind(')');  // the name may hold blanks and brackets
  if (name_end == std::string::npos) return {};
  std::istringstream fields(line.substr(name_end + 1));
  std::string field;
  for (int number = 3; number <= 22 && fields >> field; ++number) {
    if (number == 3 && (field == "Z" || field == "X")) return {};
  }
  return field;
}

std::optional<SlurmPlace> slurm_place() {
  SlurmPlace place;
  place.job = environment("SLURM_ARRAY_JOB_ID");
  place.task = environment("SLURM_ARRAY_TASK_ID");
  if (place.job.empty()) {
    place.job = environment("SLURM_JOB_ID");
    place.task.clear();
  }
  if (place.job.empty()) return std::nullopt;
  place.cluster = environment("SLURM_CLUSTER_NAME");
  place.restart = whole_or_zero(environment("SLURM_RESTART_COUNT"));  // not set in a first run
  return place;
}

template <class T>
T value_or_empty(const Json& json, const char* key) {
  try {
    return json.is_object() ? json.value(key, T{}) : T{};
  } catch (const Json::exception&) {
    return T{};
  }
}

}  // namespace

Worker this_worker() {
  Worker worker;
  worker.host = host_name();
  worker.machine = machine_name(worker.host);
  worker.pid = ::getpid();
  worker.started = start_of(worker.pid);
  worker.slurm = slurm_place();
  return worker;
}

bool process_lives(const Worker& worker) {
  return !worker.started.empty() && start_of(worker.pid) == worker.started;
}

Json worker_json(const Worker& worker) {
  Json json = {{"host", worker.host},
               {"machine", worker.machine},
               {"pid", worker.pid},
               {"started", worker.started}};
  if (const auto& slurm = worker.slurm) {
    json["slurm"] = {{"cluster", slurm->cluster},
                     {"job", slurm->job},
                     {"task", slurm->task},
                     {"restart", slurm->restart}};
  }
  return json;
}

Worker worker_of(const Json& json) {
  Worker worker;
  worker.host = value_or_empty<std::string>(json, "host");
  worker.machine = value_or_empty<std::string>(json, "machine");
  worker.pid = value_or_empty<long>(json, "pid");
  worker.started = value_or_empty<std::string>(json, "started");
  if (!json.is_object() || !json.contains("slurm")) return worker;
  const Json& slurm = json["slurm"];
  worker.slurm = SlurmPlace{
      value_or_empty<std::string>(slurm, "cluster"), value_or_empty<std::string>(slurm, "job"),
      value_or_empty<std::string>(slurm, "task"), value_or_empty<int>(slurm, "restart")};
  return worker;
}

}  // namespace vantage
