// Some hundred programs that say and do anything, at the ends of real pipes: each is over in time,
// with a reason or with an answer, and nothing of any of them is left.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/mapping/external/asked_planner.hpp"
#include "tests/tasks/mapping/external/made_up_answer.hpp"
#include "vantage/runtime/episode_loop.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

constexpr int kPlanners = 400;
constexpr double kTimeout_s = 0.15;

/// Waits that no planner outlives; the number is in the command line of every one.
std::string sleeper() { return "86397." + std::to_string(::getpid()); }

/// Of the planners' own, wherever they were started from.
std::ptrdiff_t sleepers() {
  return std::ranges::count_if(fs::directory_iterator("/proc"), [](const auto& entry) {
    std::ifstream file(entry.path() / "cmdline");
    const std::string command((std::istreambuf_iterator<char>(file)), {});
    return command.find(sleeper()) != std::string::npos;
  });
}

std::ptrdiff_t open_files() {
  return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
}

/// One of the things that programs do, besides what they say.
std::string made_up_deed(Rng& rng) {
  static const std::vector<std::string> deeds{"read line",
                                              "cat $1",
                                              "cat $1 $1 >&2",
                                              "sleep " + sleeper(),
                                              "sleep " + sleeper() + " &",
                                              "(setsid sleep " + sleeper() + " &)",
                                              "trap '' TERM INT HUP PIPE",
                                              "exec <&-",
                                              "exec >&-",
                                              "exec 2>&-",
                                              "exit 3",
                                              "kill -SEGV $$",
                                              "kill -KILL 0",
                                              "yes | head -c 200000",
                                              "yes >&2 | head -c 200000 >&2",
                                              "head -c 3000 /dev/urandom",
                                              "cat >/dev/null &",
                                              "rm -f *.raw; ln -s /etc/passwd floor.raw",
                                              ": > occupancy.raw",
                                              "echo '{\"view\": 1}'",
                                              "read line; echo '{\"view\": 1}'"};
  return deeds[rng.uniform_index(deeds.size())];
}

/// Half of them begin as they should.
ExternalChoice made_up_planner(Rng& rng, const fs::path& said) {
  std::ofstream file(said, std::ios::binary);
  for (std::size_t i = rng.uniform_index(4) + 1; i > 0; --i) {
    file << support::made_up_answer(rng) << (rng.uniform() < 0.8 ? "\n" : "");
  }
  file.close();
  std::string script = rng.uniform() < 0.5 ? support::kHello : "";
  for (std::size_t i = rng.uniform_index(5) + 1; i > 0; --i) script += made_up_deed(rng) + "\n";
  ExternalChoice choice = support::sh(script, kTimeout_s);
  choice.command.insert(choice.command.end(), {"sh", said.string()});
  return choice;
}

/// @param answered counts the answers @return why it failed; empty if it did not
std::string reason_of(const ExternalChoice& choice, const DecisionRequest& request,
                      std::size_t& answered) {
  ExternalPlanner planner(choice, {.task = "tabletop"});
  try {
    for (int i = 0; i < 2; ++i, ++answered) planner.decide(request);
    return {};
  } catch (const EpisodeFailed& error) {
    return error.what();
  }
}

TEST(GarbagePlanners, LeaveNothingBehind) {
  const support::TemporaryDirectory folder;
  const support::AskedSituation situation;
  const DecisionRequest request = situation.request();
  Rng rng(24);
  const auto files_before = open_files();
  std::size_t answered = 0;
  std::vector<std::string> reasons;
  for (int i = 0; i < kPlanners; ++i) {
    const ExternalChoice choice = made_up_planner(rng, folder / "what.is.said");
    const auto start = std::chrono::steady_clock::now();
    const std::string reason = reason_of(choice, request, answered);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    EXPECT_LT(took.count(), 10.0) << choice.command.back();
    if (!reason.empty()) reasons.push_back(reason);
    for (const char c : reason) EXPECT_TRUE(c >= 0x20 && c < 0x7f) << reason;
    errno = 0;
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << choice.command.back();  // no child
    EXPECT_EQ(errno, ECHILD);
  }
  for (int i = 0; i < 200 && sleepers() > 0; ++i) {  // the last ones are on their way
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(sleepers(), 0);
  EXPECT_EQ(open_files(), files_before);
  // They come to everything that can go wrong, and to what is right.
  EXPECT_GT(answered, 0U);
  for (const char* part : {"no answer within", "it ended: exit code", "it ended: signal",
                           "closed its output", "more than one line", "expected one JSON object"}) {
    EXPECT_TRUE(std::ranges::any_of(reasons, [&](const std::string& r) {
      return r.find(part) != std::string::npos;
    })) << part;
  }
}

}  // namespace
}  // namespace vantage
