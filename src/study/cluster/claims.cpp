#include "vantage/study/cluster/claims.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <ctime>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path claim_file(const fs::path& folder, int number) {
  return folder / fmt::format("{}.json", number);
}

/// No other worker has a file of this name.
fs::path own_file(const fs::path& folder, const Worker& worker) {
  return folder / fmt::format("{}-{}.new", worker.host, worker.pid);
}

/// N of "N.json", else 0.
int number_of(const fs::path& file) {
  if (file.extension() != ".json") return 0;
  const std::string stem = file.stem().string();
  int number = 0;
  const auto end = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  return end.ptr == stem.data() + stem.size() && number > 0 ? number : 0;
}

int highest_number(const fs::path& folder) {
  int highest = 0;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    highest = std::max(highest, number_of(it->path()));
  }
  return highest;
}

std::string claim_text(const Worker& worker, bool released) {
  Json json = worker_json(worker);
  json["released"] = released;
  return json.dump(2) + "\n";
}

[[noreturn]] void fail(const fs::path& file) {
  throw OutputError(fmt::format("{}: cannot write: {}", file.string(),
                                errno != 0 ? std::strerror(errno) : "not all of it"));
}

void write_all(int descriptor, const std::string& text, const fs::path& file) {
  errno = 0;
  const bool whole =
      ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  if (::close(descriptor) != 0 || !whole) fail(file);
}

void write_new(const fs::path& file, const std::string& text) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) fail(file);
  write_all(descriptor, text, file);
}

/// For file systems without hard links.
bool create_exclusively(const fs::path& file, const std::string& text) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (descriptor < 0 && errno == EEXIST) return false;
  if (descriptor < 0) fail(file);
  write_all(descriptor, text, file);
  return true;
}

/// When a file was last changed. Opening it, NFS asks the server instead of its cache.
std::optional<timespec> changed(const fs::path& file) {
  struct stat status {};
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  const bool known = descriptor >= 0 && ::fstat(descriptor, &status) == 0;
  if (descriptor >= 0) ::close(descriptor);
  return known ? std::optional(status.st_mtim) : std::nullopt;
}

/// The time of the file system's clock, by a file written now.
timespec time_in(const fs::path& folder) {
  static const Worker self = this_worker();
  const fs::path probe = folder / fmt::format("{}-{}.now", self.host, self.pid);
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);  // holds in a folder that only the holder may write
  const int descriptor = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) return now;
  struct stat written {};
  if (::futimens(descriptor, nullptr) == 0 && ::fstat(descriptor, &written) == 0) {
    now = written.st_mtim;
  }
  ::close(descriptor);
  ::unlink(probe.c_str());
  return now;
}

double age_of(const fs::path& file) {
  const auto then = changed(file);
  if (!then) return 0.0;
  const timespec now = time_in(file.parent_path());
  return static_cast<double>(now.tv_sec - then->tv_sec) +
         1e-9 * static_cast<double>(now.tv_nsec - then->tv_nsec);
}

}  // namespace

std::optional<Claim> claim_in_force(const fs::path& folder) {
  Claim claim;
  claim.number = highest_number(folder);
  if (claim.number == 0) return std::nullopt;
  const fs::path file = claim_file(folder, claim.number);
  try {
    const Json json = Json::parse(read_file(file), nullptr, false);
    claim.worker = worker_of(json);
    claim.released = json.is_object() && json.value("released", Json()) == Json(true);
  } catch (const InputError&) {
    claim.worker = {};
  }
  if (!claim.released) claim.age_s = age_of(file);
  return claim;
}

bool holder_lives(const Claim& claim, const Worker& self, const SlurmQueue& queue) {
  if (claim.released) return false;
  if (!claim.worker.machine.empty() && claim.worker.machine == self.machine) {
    return process_lives(claim.worker);
  }
  const auto& slurm = claim.worker.slurm;
  if (slurm && self.slurm && slurm->same_task(*self.slurm) &&
      slurm->restart < self.slurm->restart) {
    return false;
  }
  if (slurm && queue.silence.empty() &&
      std::ranges::find(queue.jobs, slurm->job) != queue.jobs.end()) {
    return std::ranges::any_of(queue.tasks, [&](const SlurmTask& task) {
      return task.job == slurm->job && task.task == slurm->task && task.restart == slurm->restart &&
             is_at_work(task);
    });
  }
  return claim.age_s < kSilence_s;
}

bool HeldClaim::in_force() const { return highest_number(folder_) == number_; }

void HeldClaim::heartbeat() const {
  // The time is the server's. A claim that is gone is seen by in_force().
  ::utimensat(AT_FDCWD, claim_file(folder_, number_).c_str(), nullptr, 0);
}

void HeldClaim::release() const {
  const fs::path own = own_file(folder_, worker_);
  write_new(own, claim_text(worker_, true));
  if (::rename(own.c_str(), claim_file(folder_, number_).c_str()) != 0) fail(own);
}

std::optional<HeldClaim> take_claim(const fs::path& folder, int number, const Worker& worker) {
  std::error_code error;
  fs::create_directories(folder, error);  // if not, the next line says why
  const fs::path file = claim_file(folder, number);
  const fs::path own = own_file(folder, worker);
  const std::string text = claim_text(worker, false);
  write_new(own, text);
  const int result = ::link(own.c_str(), file.c_str());
  const int why = errno;
  // The answer of an NFS server may be lost, and the link be there all the same.
  struct stat status {};
  bool taken = result == 0 || (::stat(own.c_str(), &status) == 0 && status.st_nlink == 2);
  if (!taken && why != EEXIST) taken = create_exclusively(file, text);
  ::unlink(own.c_str());
  if (!taken) return std::nullopt;
  return HeldClaim(folder, number, worker);
}

}  // namespace vantage
