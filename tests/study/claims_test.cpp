// Claims on a shared folder: one holder at a time, and what is lost is taken over.
#include "vantage/study/cluster/claims.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

Worker elsewhere(const std::string& task, int restart) {
  Worker worker{.host = "n7", .machine = "n7 another boot", .pid = 1, .started = "1", .slurm = {}};
  worker.slurm = SlurmPlace{"c", "12", task, restart};
  return worker;
}

Claim claim_of(const Worker& worker, double age_s = 0.0) {
  return {.number = 1, .worker = worker, .released = false, .age_s = age_s};
}

SlurmQueue queue_of(const std::string& state, int restart) {
  return {{"12"}, {{"12", "3", state, "", restart, "n7"}}, {}};
}

class Claims : public testing::Test {
 protected:
  /// Everybody may read it and its owner write it, as far as the umask lets them.
  void expect_readable(const fs::path& file) {
    std::ofstream(directory_ / "plain") << "x";
    EXPECT_EQ(fs::status(file).permissions(),
              fs::status(directory_ / "plain").permissions() & static_cast<fs::perms>(0644));
  }
  support::TemporaryDirectory directory_;
  fs::path folder_ = directory_ / "attempts/a/b";
};

TEST_F(Claims, OneOfManyProcessesTakesIt) {
  constexpr int kProcesses = 4;
  fs::create_directories(folder_);
  void* shared = ::mmap(nullptr, sizeof(std::atomic<int>), PROT_READ | PROT_WRITE,
                        MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(shared, MAP_FAILED);
  for (int number = 1; number <= 20; ++number) {
    auto* ready = new (shared) std::atomic<int>(0);
    std::vector<pid_t> children;
    for (int i = 0; i < kProcesses; ++i) {
      const pid_t child = ::fork();
      if (child == 0) {
        const Worker self = this_worker();
        ++*ready;
        while (*ready < kProcesses) ::sched_yield();
        ::_exit(take_claim(folder_, number, self) ? 1 : 0);
      }
      children.push_back(child);
    }
    int taken = 0;
    for (const pid_t child : children) {
      int status = 0;
      ::waitpid(child, &status, 0);
      taken += WEXITSTATUS(status);
    }
    EXPECT_EQ(taken, 1) << number;
  }
  ::munmap(shared, sizeof(std::atomic<int>));
  EXPECT_EQ(claim_in_force(folder_)->number, 20);
  for (const auto& entry : fs::directory_iterator(folder_)) {
    EXPECT_EQ(entry.path().extension(), ".json") << entry.path();
  }
}

TEST_F(Claims, HoldWhileTheirProcessLives) {
  const Worker self = this_worker();
  EXPECT_FALSE(claim_in_force(folder_));
  const auto held = take_claim(folder_, 1, self);
  ASSERT_TRUE(held);
  EXPECT_TRUE(held->in_force());
  expect_readable(folder_ / "1.json");
  EXPECT_THAT(read_file(folder_ / "1.json"), testing::StartsWith("{\n  \"host\": \""));
  auto claim = claim_in_force(folder_);
  ASSERT_TRUE(claim);
  EXPECT_EQ(claim->worker.pid, ::getpid());
  EXPECT_TRUE(holder_lives(*claim, self, {}));
  claim->worker.started = "0";  // an earlier process had this number
  EXPECT_FALSE(holder_lives(*claim, self, {}));
  held->release();
  EXPECT_TRUE(claim_in_force(folder_)->released);
  EXPECT_FALSE(holder_lives(*claim_in_force(folder_), self, {}));
  EXPECT_FALSE(take_claim(folder_, 1, self));
  EXPECT_TRUE(take_claim(folder_, 2, self));
  EXPECT_FALSE(held->in_force());
}

/// By its name this worker writes first on another file system, from which there is no link.
TEST_F(Claims, WithoutHardLinksAreOfWhoMakesTheFile) {
  struct stat here {};
  struct stat there {};
  if (::stat(directory_.path().c_str(), &here) != 0 || ::stat("/dev/shm", &there) != 0 ||
      here.st_dev == there.st_dev || ::access("/dev/shm", W_OK) != 0) {
    GTEST_SKIP() << "/dev/shm is no other file system";
  }
  Worker worker = this_worker();
  worker.host = "/dev/shm/" + directory_.path().filename().string();
  const auto held = take_claim(folder_, 1, worker);
  ASSERT_TRUE(held);
  EXPECT_TRUE(held->in_force());
  expect_readable(folder_ / "1.json");
  EXPECT_EQ(claim_in_force(folder_)->worker.host, worker.host);
  EXPECT_TRUE(holder_lives(*claim_in_force(folder_), this_worker(), {}));
  EXPECT_FALSE(take_claim(folder_, 1, worker));
  EXPECT_FALSE(fs::exists(worker.host + "-" + std::to_string(worker.pid) + ".new"));
}

TEST_F(Claims, OfAKilledProcessAreLost) {
  const pid_t child = ::fork();
  if (child == 0) {
    take_claim(folder_, 1, this_worker());
    ::pause();
  }
  while (!claim_in_force(folder_)) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_TRUE(holder_lives(*claim_in_force(folder_), this_worker(), {}));
  ::kill(child, SIGKILL);
  siginfo_t info{};
  ::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT);  // a zombie for now
  EXPECT_FALSE(holder_lives(*claim_in_force(folder_), this_worker(), {}));
  ::waitpid(child, nullptr, 0);
  EXPECT_FALSE(holder_lives(*claim_in_force(folder_), this_worker(), {}));
}

TEST_F(Claims, OfAnotherMachineHoldByTheirHeartbeat) {
  Worker other = elsewhere("", 0);
  other.slurm.reset();
  const auto held = take_claim(folder_, 1, other);
  ASSERT_TRUE(held);
  EXPECT_TRUE(holder_lives(*claim_in_force(folder_), this_worker(), {}));
  const auto ago = std::chrono::seconds(static_cast<int>(kSilence_s) + 5);
  fs::last_write_time(folder_ / "1.json", fs::file_time_type::clock::now() - ago);
  EXPECT_GT(claim_in_force(folder_)->age_s, kSilence_s);
  EXPECT_FALSE(holder_lives(*claim_in_force(folder_), this_worker(), {}));
  held->heartbeat();
  EXPECT_LT(claim_in_force(folder_)->age_s, kHeartbeat_s);
  EXPECT_TRUE(holder_lives(*claim_in_force(folder_), this_worker(), {}));
}

TEST_F(Claims, ThatCannotBeReadHoldByTheirHeartbeat) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "3.json") << "{\"host\": 7, \"slurm\": [";
  std::ofstream(folder_ / "notes.json") << "{}";
  ASSERT_TRUE(claim_in_force(folder_));
  EXPECT_EQ(claim_in_force(folder_)->number, 3);
  EXPECT_TRUE(holder_lives(*claim_in_force(folder_), this_worker(), {}));
}

TEST_F(Claims, OfASlurmTaskHoldWhileSlurmRunsIt) {
  const Worker self = this_worker();
  const Claim claim = claim_of(elsewhere("3", 1), 2 * kSilence_s);
  EXPECT_TRUE(holder_lives(claim, self, queue_of("RUNNING", 1)));
  EXPECT_TRUE(holder_lives(claim, self, queue_of("SUSPENDED", 1)));
  for (const char* state : {"PENDING", "NODE_FAIL", "COMPLETED", "TIMEOUT"}) {
    EXPECT_FALSE(holder_lives(claim, self, queue_of(state, 1))) << state;
  }
  EXPECT_FALSE(holder_lives(claim, self, queue_of("RUNNING", 2))) << "it runs again";
  EXPECT_FALSE(holder_lives(claim, self, {{"12"}, {}, {}})) << "Slurm has forgotten it";
}

TEST_F(Claims, OfASlurmTaskHoldByTheirHeartbeatIfSlurmIsSilent) {
  const SlurmQueue silent{{"12"}, {}, "Unable to contact slurm controller"};
  EXPECT_TRUE(holder_lives(claim_of(elsewhere("3", 1), 1.0), this_worker(), silent));
  EXPECT_FALSE(holder_lives(claim_of(elsewhere("3", 1), 2 * kSilence_s), this_worker(), silent));
  EXPECT_TRUE(holder_lives(claim_of(elsewhere("3", 1), 1.0), this_worker(), {})) << "not asked";
}

TEST_F(Claims, OfARequeuedTaskAreLostToItself) {
  Worker self = this_worker();
  self.slurm = SlurmPlace{"c", "12", "3", 2};
  EXPECT_FALSE(holder_lives(claim_of(elsewhere("3", 1)), self, {}));
  EXPECT_FALSE(holder_lives(claim_of(elsewhere("3", 1)), self, queue_of("RUNNING", 1)));
  EXPECT_TRUE(holder_lives(claim_of(elsewhere("3", 2)), self, {})) << "of its run now";
  EXPECT_TRUE(holder_lives(claim_of(elsewhere("4", 1)), self, {})) << "of another task";
  self.slurm->cluster = "d";
  EXPECT_TRUE(holder_lives(claim_of(elsewhere("3", 1)), self, {})) << "of another cluster";
}

TEST_F(Claims, ThatCannotBeMadeOrReleasedAreErrors) {
  const auto held = take_claim(folder_, 1, this_worker());
  ASSERT_TRUE(held);
  fs::remove_all(directory_ / "attempts");
  EXPECT_FALSE(held->in_force());
  EXPECT_NO_THROW(held->heartbeat());
  EXPECT_THROW(held->release(), OutputError);
  std::ofstream(directory_ / "attempts") << "no folder";
  EXPECT_THROW(take_claim(folder_, 1, this_worker()), OutputError);
}

TEST_F(Claims, LeaveNoFileOpen) {
  const auto open_files = [] {
    return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
  };
  const auto before = open_files();
  const auto held = take_claim(folder_, 1, this_worker());
  ASSERT_TRUE(held);
  ASSERT_TRUE(claim_in_force(folder_));
  held->release();
  EXPECT_FALSE(take_claim(folder_, 1, this_worker()));
  EXPECT_EQ(open_files(), before);
}

/// Of a worker on another machine, of which Slurm knows nothing.
TEST_F(Claims, AreLostAfterFiveMinutesOfSilence) {
  EXPECT_EQ(kHeartbeat_s, 15.0);
  const auto lives = [](double age_s) {
    Worker other = elsewhere("", 0);
    other.slurm.reset();
    return holder_lives(claim_of(other, age_s), this_worker(), {});
  };
  EXPECT_TRUE(lives(299.0));
  EXPECT_FALSE(lives(300.0));
}

TEST_F(Claims, AreFilesCalledByANumber) {
  fs::create_directories(folder_ / "8");
  for (const char* other :
       {"9.txt", "7x.json", "notes.json", "0.json", "-4.json", "99999999999.json"}) {
    std::ofstream(folder_ / other) << "{}";
  }
  EXPECT_FALSE(claim_in_force(folder_));
  ASSERT_TRUE(take_claim(folder_, 1, this_worker()));
  EXPECT_EQ(claim_in_force(folder_)->number, 1);
}

TEST_F(Claims, WhoseFileIsGoneAreOfNobodyAndNew) {
  fs::create_directories(folder_);
  fs::create_symlink("nowhere", folder_ / "3.json");
  const auto claim = claim_in_force(folder_);
  ASSERT_TRUE(claim);
  EXPECT_EQ(claim->number, 3);
  EXPECT_EQ(claim->worker.host, "");
  EXPECT_EQ(claim->worker.pid, 0);
  EXPECT_FALSE(claim->released);
  EXPECT_EQ(claim->age_s, 0.0);
  EXPECT_EQ(Claim{}.number, 0);
  EXPECT_EQ(Claim{}.age_s, 0.0);
}

TEST_F(Claims, OnAFullFileSystemAreErrors) {
  if (::access("/dev/full", W_OK) != 0) GTEST_SKIP() << "there is no /dev/full";
  const Worker self = this_worker();
  fs::create_directories(folder_);
  fs::create_symlink("/dev/full", folder_ / (self.host + "-" + std::to_string(self.pid) + ".new"));
  EXPECT_THROW(take_claim(folder_, 1, self), OutputError);
}

TEST_F(Claims, ThatCannotBeMadeSayWhy) {
  const auto why = [&](const Worker& worker) {
    try {
      take_claim(folder_, 1, worker);
    } catch (const OutputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  std::ofstream(directory_ / "attempts") << "no folder";
  EXPECT_THAT(why(this_worker()), testing::HasSubstr("Not a directory"));
  if (::access("/dev/shm", W_OK) != 0) return;
  Worker worker = this_worker();  // that writes elsewhere first, as if there were no hard links
  worker.host = "/dev/shm/" + directory_.path().filename().string();
  EXPECT_THAT(why(worker), testing::HasSubstr("Not a directory"));
  fs::remove(worker.host + "-" + std::to_string(worker.pid) + ".new");
}

/// Its time is that of the file system, which is a little behind.
TEST_F(Claims, AgeSinceTheirLastSignOfLife) {
  using Clock = fs::file_time_type::clock;
  using namespace std::chrono_literals;
  ASSERT_TRUE(take_claim(folder_, 1, this_worker()));
  const auto expect_age = [&](std::chrono::milliseconds before) {
    const auto then = Clock::now() - before;
    fs::last_write_time(folder_ / "1.json", then);
    const auto since = [&](Clock::time_point when) {
      return std::chrono::duration<double>(when - then).count();
    };
    const double least_s = since(Clock::now());
    const double age_s = claim_in_force(folder_)->age_s;
    EXPECT_GE(age_s, least_s - 0.1);
    EXPECT_LE(age_s, since(Clock::now()) + 0.1);
  };
  expect_age(400500ms);
  expect_age(400250ms);
  const Worker self = this_worker();
  fs::create_directory(folder_ / (self.host + "-" + std::to_string(self.pid) + ".now"));
  expect_age(400750ms);  // by the clock of the machine
}

TEST_F(Claims, NeedNoStandardInput) {
  const auto expect_unused = [] { EXPECT_EQ(::fcntl(STDIN_FILENO, F_GETFD), -1); };
  const int before = ::dup(STDIN_FILENO);
  ::close(STDIN_FILENO);
  const Worker self = this_worker();
  EXPECT_NO_THROW(EXPECT_TRUE(take_claim(folder_, 1, self)));
  expect_unused();
  std::error_code error;
  fs::last_write_time(folder_ / "1.json", fs::file_time_type::clock::now() - std::chrono::hours(1),
                      error);
  const auto claim = claim_in_force(folder_);
  EXPECT_TRUE(claim && claim->age_s > kSilence_s);
  expect_unused();
  Worker elsewhere_first = self;
  elsewhere_first.host = "/dev/shm/" + directory_.path().filename().string();
  if (::access("/dev/shm", W_OK) == 0) {
    EXPECT_NO_THROW(EXPECT_TRUE(take_claim(folder_, 2, elsewhere_first)));
    expect_unused();
  }
  if (before >= 0) {
    ::dup2(before, STDIN_FILENO);
    ::close(before);
  }
}

TEST(Workers, KnowTheirPlaceInSlurm) {
  for (const auto& [name, value] :
       {std::pair("SLURM_JOB_ID", "17"), std::pair("SLURM_ARRAY_JOB_ID", "12"),
        std::pair("SLURM_ARRAY_TASK_ID", "3"), std::pair("SLURM_RESTART_COUNT", "2"),
        std::pair("SLURM_CLUSTER_NAME", "c"), std::pair("SLURMD_NODENAME", "n7")}) {
    ::setenv(name, value, 1);
  }
  const Worker worker = this_worker();
  ::unsetenv("SLURM_ARRAY_JOB_ID");
  ::unsetenv("SLURM_RESTART_COUNT");
  const Worker single = this_worker();
  for (const char* name :
       {"SLURM_JOB_ID", "SLURM_ARRAY_TASK_ID", "SLURM_CLUSTER_NAME", "SLURMD_NODENAME"}) {
    ::unsetenv(name);
  }
  EXPECT_EQ(worker.host, "n7");
  ASSERT_TRUE(worker.slurm);
  EXPECT_EQ(worker.slurm->id(), "12_3");
  EXPECT_EQ(worker.slurm->restart, 2);
  EXPECT_EQ(worker.slurm->cluster, "c");
  EXPECT_THAT(worker.machine, testing::StartsWith("n7 ")) << "a machine may be several nodes";
  ASSERT_TRUE(single.slurm);
  EXPECT_EQ(single.slurm->id(), "17");
  EXPECT_EQ(single.slurm->restart, 0);
  EXPECT_FALSE(this_worker().slurm);
}

}  // namespace
}  // namespace vantage
