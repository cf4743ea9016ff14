// Whatever a program of a user's does, the episode goes on with its answer or ends with the reason,
// in time, and nothing of the program is left.
#include "vantage/tasks/mapping/external/external_planner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <signal.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/mapping/external/asked_planner.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/core/names.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/runtime/episode_loop.hpp"
#include "vantage/tasks/episode_planner.hpp"
#include "vantage/tasks/mapping/external/planner_files.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;
using support::kHello;
using support::sh;
using testing::EndsWith;
using testing::HasSubstr;

/// Which the tests below leave no time to reach.
constexpr double kLong_s = 30.0;

OutsideDecision first_decision(const ExternalChoice& choice) {
  const support::AskedSituation situation;
  ExternalPlanner planner(choice, {.task = "tabletop"});
  return planner.decide(situation.request());
}

std::string failure(const ExternalChoice& choice) {
  try {
    first_decision(choice);
  } catch (const EpisodeFailed& error) {
    EXPECT_EQ(error.code(), ExitCode::goal_failed);
    return error.what();
  }
  return "none";
}

/// Of a program that never ends by itself, which waits as long as `sleeper`.
bool runs(const std::string& sleeper) {
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::ifstream file(entry.path() / "cmdline");
    std::string command((std::istreambuf_iterator<char>(file)), {});
    if (command.find(sleeper) != std::string::npos) return true;
  }
  return false;
}

/// What is killed is gone from the list of processes a moment later.
bool is_gone(const std::string& sleeper) {
  for (int i = 0; i < 200 && runs(sleeper); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return !runs(sleeper);
}

std::string answering(const std::string& answer) {
  return kHello + "read request; echo '" + answer + "'; read end";
}

TEST(ExternalPlanner, AnswersWithAViewOrAPose) {
  EXPECT_EQ(std::get<std::size_t>(first_decision(sh(answering(R"({"view": 1})")))), 1U);
  const auto pose =
      std::get<Pose2>(first_decision(sh(answering(R"({"pose": [0.3, -0.2, 1.5], "why": "x"})"))));
  EXPECT_EQ(pose.x_m, 0.3);
  EXPECT_EQ(pose.y_m, -0.2);
  EXPECT_EQ(pose.yaw_rad, 1.5);
}

TEST(ExternalPlanner, IsAskedAgainAndAgainByOneProcess) {
  const support::AskedSituation situation;
  ExternalPlanner planner(
      sh(kHello + R"(n=0; while read request; do echo "{\"view\": $n}"; n=$((1 - n)); done)"),
      {.task = "tabletop"});
  for (const std::size_t view : {0U, 1U, 0U}) {
    EXPECT_EQ(std::get<std::size_t>(planner.decide(situation.request())), view);
  }
  planner.part();
}

TEST(ExternalPlanner, FailsTheEpisodeByWhatItSays) {
  EXPECT_THAT(failure(sh("echo hello; read end", kLong_s)), HasSubstr("expected one JSON object"));
  EXPECT_THAT(failure(sh("echo '{}'; read end", kLong_s)), HasSubstr("its first line is not"));
  EXPECT_THAT(failure(sh(R"(echo '{"protocol": "vantage-planner", "version": 2}'; read end)")),
              HasSubstr("speaks version 2 of the protocol, this is version 1"));
  EXPECT_THAT(failure(sh(answering("garbage \x01\xff"))), HasSubstr("garbage \\x01\\xff"));
  EXPECT_THAT(failure(sh(answering(R"({"view": 7})"))),
              HasSubstr("view 7 was chosen, there are 3"));
  EXPECT_THAT(failure(sh(answering(R"({"view": -1})"))), HasSubstr("no whole number"));
  EXPECT_THAT(failure(sh(answering(R"({"view": 1.0})"))), HasSubstr("no whole number"));
  EXPECT_THAT(failure(sh(answering(R"({"view": 2})"))), HasSubstr("exhausted"));
  EXPECT_THAT(failure(sh(answering(R"({"pose": [1.1, 0, 0]})"))),
              HasSubstr("not on known free floor"));
  EXPECT_THAT(failure(sh(answering(R"({"pose": [1.7, 0, 0]})"))),
              HasSubstr("not on known free floor"));  // beyond the wall
  EXPECT_THAT(failure(sh(answering(R"({"pose": [1, 0]})"))), HasSubstr("not [x, y, yaw]"));
  EXPECT_THAT(failure(sh(answering(R"({"view": 0, "pose": [0, 0, 0]})"))),
              HasSubstr("expected either"));
  EXPECT_THAT(failure(sh(answering("{\"view\": 0}\n{\"view\": 0}"))),
              HasSubstr("more than one line"));
}

TEST(ExternalPlanner, FailsTheEpisodeByWhatItDoes) {
  EXPECT_THAT(failure(sh("exit 3", kLong_s)), HasSubstr("it ended: exit code 3"));
  EXPECT_THAT(failure(sh("exit 255", kLong_s)), HasSubstr("it ended: exit code 255"));
  EXPECT_THAT(failure(sh(kHello + "kill -9 $$", kLong_s)), HasSubstr("it ended: signal 9"));
  EXPECT_THAT(failure(sh(kHello + "read request; printf '{\"view\": 0'", kLong_s)),
              HasSubstr("it ended in the middle of a line: exit code 0"));
  EXPECT_THAT(failure(sh(kHello + "read request; exec >&-; sleep 100", kLong_s)),
              HasSubstr("it closed its output"));
  EXPECT_THAT(failure(sh(kHello + "read request; yes | tr -d '\\n'", kLong_s)),
              HasSubstr("it floods its output: more than 65536 bytes"));
  EXPECT_THAT(failure(sh(kHello + "read request; yes", kLong_s)), HasSubstr("more than one line"));
  EXPECT_THAT(failure(sh("python3=none; exec /no/such/program", kLong_s)), HasSubstr("it ended"));
}

TEST(ExternalPlanner, FailsTheEpisodeByWhatItDoesToItsFolder) {
  EXPECT_THAT(failure(sh("ln -s /etc/passwd floor.raw; " + answering(R"({"view": 1})"))),
              HasSubstr("floor.raw: cannot write"));
  EXPECT_THAT(failure(sh("mkdir floor.raw; " + answering(R"({"view": 1})"))),
              HasSubstr("floor.raw: cannot write"));
}

TEST(ExternalPlanner, HasNoPartInAFullDisk) {
  // A file size limit fails the write as a full disk does.
  const auto before = ::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  const rlimit small{16, limit.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  EXPECT_THROW(first_decision(sh(answering(R"({"view": 1})"))), OutputError);
  ::setrlimit(RLIMIT_FSIZE, &limit);
  ::signal(SIGXFSZ, before);
}

TEST(ExternalPlanner, IsQuotedWhenItEnds) {
  // As programs end that cannot go on: the reason is what they said last.
  EXPECT_THAT(failure(sh("echo first >&2; echo 'no module named \xc3\xa4' >&2; echo >&2; exit 3")),
              EndsWith("it ended: exit code 3, after it said: no module named \\xc3\\xa4"));
  EXPECT_THAT(failure(sh("printf 'no end' >&2; kill -9 $$")),
              EndsWith("it ended: signal 9 (Killed), after it said: no end"));
  EXPECT_THAT(failure(sh("echo gone >&2; exec >&-; sleep 100")),
              EndsWith("it closed its output, after it said: gone"));
  // However much that was, and of a folder of its own, which is another one each time, no name.
  EXPECT_THAT(
      failure(sh("yes | head -c 300000 >&2; echo \"$PWD/x and $PWD/y\" >&2; exit 1", kLong_s)),
      EndsWith("after it said: ./x and ./y"));
  EXPECT_THAT(failure(sh("exit 3")), EndsWith("it ended: exit code 3"));
  EXPECT_LT(failure(sh("yes | head -c 3000 | tr -d '\\n' >&2; exit 3")).size(), 400U);
}

TEST(ExternalPlanner, MayBeGreetedAlone) {
  const support::TemporaryDirectory folder;
  const std::string file = (folder / "starts").string();
  const support::AskedSituation situation;
  ExternalPlanner planner(sh("echo x >> " + file + "; " + answering(R"({"view": 1})")), {});
  planner.greet();
  EXPECT_EQ(planner.facts().back(), (std::pair<std::string, std::string>{"name", "test"}));
  EXPECT_EQ(std::get<std::size_t>(planner.decide(situation.request())), 1U);
  EXPECT_EQ(fs::file_size(file), 2U);  // one process, of all
  ExternalPlanner broken(sh("exit 3"), {});
  try {
    broken.greet();
    FAIL() << "no error";
  } catch (const EpisodeFailed& error) {
    EXPECT_THAT(error.what(), HasSubstr("planner sh -c exit 3: it ended: exit code 3"));
  }
}

TEST(ExternalPlanner, MaySayItsFirstLineAtOnce) {
  const std::string hello = kHello.substr(kHello.find("echo"));
  const std::string late = "read hello; read request; echo '{\"view\": 1}'; read end";
  for (int i = 0; i < 10; ++i) {  // before it is asked or after
    EXPECT_EQ(std::get<std::size_t>(first_decision(sh(hello + late))), 1U);
  }
}

TEST(ExternalPlanner, IsGivenNoMoreTimeThanItHas) {
  EXPECT_THAT(failure(sh("sleep 100", 0.1)), HasSubstr("no answer within 0.1 s"));
  EXPECT_THAT(failure(sh(kHello + "read request; sleep 100", 0.3)),
              HasSubstr("no answer within 0.3 s"));
  EXPECT_THAT(failure(sh(kHello + "read request; printf '{\"view\": 0}'; sleep 100", 0.3)),
              HasSubstr("no answer within 0.3 s"));
}

TEST(ExternalPlanner, MayLeaveWhatItIsAskedUnread) {
  support::AskedSituation situation;
  situation.candidates.resize(5000, situation.candidates[0]);  // more than a pipe holds
  DecisionRequest request = situation.request();
  request.travel_s.resize(5000);
  ExternalPlanner planner(sh(kHello + "sleep 100", 0.3), {.task = "tabletop"});
  try {
    planner.decide(request);
    FAIL() << "no error";
  } catch (const EpisodeFailed& error) {
    EXPECT_THAT(error.what(), HasSubstr("it does not read what it is asked"));
  }
  ExternalPlanner deaf(sh(kHello + "exec <&-; sleep 100", 0.3), {.task = "tabletop"});
  EXPECT_THROW(deaf.decide(request), EpisodeFailed);
}

TEST(ExternalPlanner, LeavesNoProcessBehind) {
  // In the background, in a session of its own, deaf to what can be ignored.
  const std::string sleeper = "86399.25";
  const std::string start =
      "trap '' TERM INT HUP; (setsid sleep " + sleeper + " &) ; sleep " + sleeper + " & ";
  EXPECT_THAT(failure(sh(kHello + start + "exit 1", kLong_s)), HasSubstr("exit code 1"));
  EXPECT_TRUE(is_gone(sleeper));
  EXPECT_THAT(failure(sh(kHello + start + "read request; sleep " + sleeper, 0.3)),
              HasSubstr("no answer"));
  EXPECT_TRUE(is_gone(sleeper));
  {
    const support::AskedSituation situation;
    ExternalPlanner planner(
        sh(kHello + start + "read request; echo '{\"view\": 0}'; while :; do sleep 1; done"),
        {.task = "tabletop"});
    planner.decide(situation.request());
    EXPECT_TRUE(runs(sleeper));
  }
  EXPECT_TRUE(is_gone(sleeper));
}

TEST(ExternalPlanner, MayEndByItself) {
  const support::TemporaryDirectory folder;
  const std::string file = (folder / "ended").string();
  const support::AskedSituation situation;
  ExternalPlanner planner(
      sh(kHello + "read request; echo '{\"view\": 0}'; read end; echo \"$end\" > " + file),
      {.task = "tabletop"});
  planner.decide(situation.request());
  planner.part();
  std::ifstream written(file);
  std::string line;
  std::getline(written, line);
  EXPECT_EQ(line, R"({"type":"end"})");
}

TEST(ExternalPlanner, RunsApartFromUs) {
  const support::TemporaryDirectory folder;
  const std::string file = (folder / "told").string();
  ::setenv("VANTAGE_TEST_SECRET", "secret", 1);
  first_decision(sh(kHello +
                    "read request; { pwd; env; ls /proc/self/fd; ls; cat /proc/net/dev; } > " +
                    file + "; echo '{\"view\": 0}'; read end"));
  ::unsetenv("VANTAGE_TEST_SECRET");
  std::ifstream stream(file);
  const std::string told((std::istreambuf_iterator<char>(stream)), {});
  EXPECT_THAT(told, HasSubstr("vantage-"));  // a folder of its own
  EXPECT_THAT(told, Not(HasSubstr("secret")));
  EXPECT_THAT(told, HasSubstr("\noccupancy.raw\n"));
  EXPECT_THAT(told, HasSubstr("TMPDIR=" + told.substr(0, told.find('\n'))));
  EXPECT_FALSE(fs::exists(told.substr(0, told.find('\n'))));  // gone with it
}

TEST(ExternalPlanner, HasNoNetworkWhereTheSystemAllowsThat) {
  const support::TemporaryDirectory folder;
  const std::string file = (folder / "interfaces").string();
  const support::AskedSituation situation;
  ExternalPlanner planner(sh(kHello + "read request; grep -c : /proc/self/net/dev > " + file +
                             "; echo '{\"view\": 0}'; read end"),
                          {.task = "tabletop"});
  planner.decide(situation.request());
  const PlannerFacts facts = planner.facts();
  ASSERT_EQ(facts.size(), 3U);
  EXPECT_EQ(facts[1].first, "isolation");
  EXPECT_EQ(facts[2], (std::pair<std::string, std::string>{"name", "test"}));
  if (facts[1].second.starts_with("none")) GTEST_SKIP() << "SKIPPED: " << facts[1].second;
  int interfaces = 0;
  std::ifstream(file) >> interfaces;
  EXPECT_EQ(interfaces, 1);  // the loopback
}

TEST(ExternalPlanner, MayTalkToItsErrorsAtLength) {
  EXPECT_EQ(std::get<std::size_t>(first_decision(
                sh(kHello + "read request; yes | head -c 3000000 >&2; echo '{\"view\": 0}'"
                            "; read end",
                   kLong_s))),
            0U);
}

TEST(ExternalPlanner, OfAnEpisodeIsThatOfItsChoice) {
  ResolvedEpisode resolved;
  Tabletop task;
  EXPECT_EQ(external_planner(resolved), nullptr) << "it chooses itself";
  task.choice = ExternalChoice{.command = {"sh"}};
  resolved.task = task;
  EXPECT_NE(external_planner(resolved), nullptr);
  task.choice = ExternalChoice{};
  resolved.task = task;
  try {
    external_planner(resolved);
    FAIL() << "no error";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("choice.command: names no program"));
  }
}

TEST(ExternalPlanner, OfAnEpisodeIsToldWhatItChoosesFor) {
  const support::TemporaryDirectory folder;
  const fs::path told = folder / "hello.json";
  ResolvedEpisode resolved;
  resolved.setup.options.seed = 7;
  Tabletop task;
  task.scans = 6;
  task.gain = SimpleGain{};
  task.budget.time_s = 75.0;
  task.budget.energy_j = 900.0;
  task.choice = sh("read -r hello; printf '%s' \"$hello\" > '" + told.string() +
                   R"('; echo '{"protocol": "vantage-planner", "version": 1, "name": "test"}'; )" +
                   "read end");
  resolved.task = task;
  const auto planner = external_planner(resolved);
  ASSERT_NE(planner, nullptr);
  planner->greet();
  const auto hello = nlohmann::json::parse(read_file(told));
  EXPECT_EQ(hello["task"], "tabletop");
  EXPECT_EQ(hello["seed"], Rng::stream(7, "external planner").next() >> 32U);
  EXPECT_EQ(hello["scans"], 6);
  EXPECT_EQ(hello["gain"], strategy_label(task.gain));
  EXPECT_EQ(hello["gain_unit"], std::string(unit_of(task.gain)));
  EXPECT_EQ(hello["time_s"], 75.0);
  EXPECT_EQ(hello["energy_j"], 900.0);
}

TEST(ExternalPlanner, ThatIsNoProgramIsAnErrorOfTheConfiguration) {
  EXPECT_THROW(ExternalPlanner({.command = {"no_such_program_zz"}}, {}), ConfigError);
  EXPECT_THROW(ExternalPlanner({.command = {"/etc/passwd"}}, {}), ConfigError);
}

TEST(ExternalPlanner, HasTwoSecondsToEndByItself) {
  const support::TemporaryDirectory folder;
  const fs::path soon = folder / "soon";
  const fs::path late = folder / "late";
  const support::AskedSituation situation;
  ExternalPlanner planner(
      sh(kHello + "read request; echo '{\"view\": 0}'; read end; sleep 1; : > " + soon.string() +
         "; sleep 2; : > " + late.string()),
      {.task = "tabletop"});
  planner.decide(situation.request());
  planner.part();
  EXPECT_TRUE(fs::exists(soon));
  EXPECT_FALSE(fs::exists(late));
}

TEST(ExternalPlanner, ThatCannotBeStartedFailsTheEpisode) {
  const support::TemporaryDirectory folder;
  std::ofstream(folder / "planner") << "#!/no/such/interpreter\n";
  fs::permissions(folder / "planner", fs::perms::owner_all);
  EXPECT_THAT(failure({.command = {(folder / "planner").string()}}), HasSubstr("cannot run"));
}

TEST(ExternalPlanner, SaysAtWhichDecisionItFails) {
  const support::AskedSituation situation;
  ExternalPlanner planner(
      sh(kHello + "read request; echo '{\"view\": 1}'; read request; echo garbage; read end"),
      {.task = "tabletop"});
  planner.decide(situation.request());
  try {
    planner.decide(situation.request());
    FAIL() << "no error";
  } catch (const EpisodeFailed& error) {
    EXPECT_THAT(error.what(), HasSubstr(", decision 2: expected one JSON object"));
  }
}

TEST(ExternalPlanner, IsGivenWhatProgramsAreFoundBy) {
  const support::TemporaryDirectory folder;
  const std::string file = (folder / "told").string();
  const std::vector<std::string> names{"PYENV_ROOT", "NODE_PATH", "JAVA_HOME", "JULIA_DEPOT_PATH"};
  for (const std::string& name : names) ::setenv(name.c_str(), ("/of/" + name).c_str(), 1);
  first_decision(sh(kHello + "read request; env > " + file + "; echo '{\"view\": 0}'; read end"));
  for (const std::string& name : names) ::unsetenv(name.c_str());
  std::ifstream stream(file);
  const std::string told = "\n" + std::string((std::istreambuf_iterator<char>(stream)), {});
  for (const std::string& name : names) {
    EXPECT_THAT(told, HasSubstr("\n" + name + "=/of/" + name + "\n"));
  }
  EXPECT_THAT(told, HasSubstr(std::string("\nPATH=") + ::getenv("PATH") + "\n"));
  EXPECT_THAT(told, HasSubstr("\nPYTHONHASHSEED=0\n"));
  EXPECT_THAT(told, HasSubstr("\nPYTHONDONTWRITEBYTECODE=1\n"));
}

TEST(ExternalPlanner, StandsInThePlaceOfAChoice) {
  const support::TemporaryDirectory folder;
  const std::string file = (folder / "ended").string();
  const support::AskedSituation situation;
  const DecisionRequest request = situation.request();
  ExternalPlanner planner(
      sh(kHello + "read request; echo '{\"view\": 1}'; read end; echo \"$end\" > " + file),
      {.task = "tabletop"});
  const OutsideChoice choice = planner.as_outside_choice("mine of simple");
  EXPECT_EQ(choice.name, "mine of simple");
  EXPECT_FALSE(choice.blind);
  EXPECT_EQ(choice.facts().size(), 1U);
  EXPECT_EQ(std::get<std::size_t>(choice.decide(request)), 1U);
  EXPECT_EQ(choice.facts().size(), 3U);
  EXPECT_EQ(choice.facts()[0].first, "command");
  EXPECT_TRUE(choice.facts()[0].second.starts_with("sh -c read hello;"));
  choice.ended(request.situation, true);
  std::ifstream written(file);
  std::string line;
  std::getline(written, line);
  EXPECT_EQ(line, R"({"type":"end"})");
  planner.part();  // nobody is there any more
}

TEST(ExternalPlanner, HasOneTimeToStartAndAnotherToAnswer) {
  EXPECT_THAT(
      failure(
          {.command = {"sh", "-c", "sleep 100"}, .timeout_s = kLong_s, .startup_timeout_s = 0.15}),
      HasSubstr("no answer within 0.15 s"));
  EXPECT_THAT(failure({.command = {"sh", "-c", kHello + "read request; sleep 100"},
                       .timeout_s = 0.2,
                       .startup_timeout_s = kLong_s}),
              HasSubstr("no answer within 0.2 s"));
}

TEST(ExternalPlanner, IsNamedInTwoHundredLetters) {
  const std::string beginning = "sh -c exit 3 # ";
  const std::string shown = beginning + std::string(200 - beginning.size(), 'x');
  EXPECT_THAT(failure(sh("exit 3 # " + std::string(300, 'x'))),
              HasSubstr("planner " + shown + " ..., decision 1: it ended"));
}

/// The program and its second argument; the episode is elsewhere.
TEST(PlannerFiles, AreThoseThatTheCommandNames) {
  const support::TemporaryDirectory folder;
  for (const char* name : {"planner", "weights"}) std::ofstream(folder / name) << "x";
  ViewChoice choice = ExternalChoice{.command = {"./planner", "-q", "weights", "seven"}};
  find_planner(choice, folder.path());
  const std::vector<InputFile> files = planner_files(choice);
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(files[0].key, "choice.command[0]");
  EXPECT_TRUE(fs::equivalent(files[0].path, folder / "planner"));
  EXPECT_EQ(files[1].key, "choice.command[2]");
  EXPECT_TRUE(fs::equivalent(files[1].path, folder / "weights"));
  EXPECT_EQ(std::get<ExternalChoice>(choice).command[1], "-q");
  EXPECT_EQ(std::get<ExternalChoice>(choice).command[3], "seven");
  EXPECT_THROW(require_planner(choice), ConfigError) << "it cannot be run";
  fs::permissions(folder / "planner", fs::perms::owner_all);
  EXPECT_NO_THROW(require_planner(choice));
}

TEST(PlannerFiles, OfOtherChoicesAreNone) {
  ViewChoice greedy = GreedyGain{};
  find_planner(greedy, {});
  EXPECT_TRUE(planner_files(greedy).empty());
  EXPECT_NO_THROW(require_planner(greedy));
  try {
    require_planner(ExternalChoice{});
    FAIL() << "no error";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("choice.command: names no program"));
  }
}

}  // namespace
}  // namespace vantage
