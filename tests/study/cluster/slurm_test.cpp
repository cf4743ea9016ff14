// What is read of Slurm and said of it, without Slurm.
#include "vantage/study/cluster/slurm.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>

#include "tests/support/shell.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/study/cluster/program.hpp"
#include "vantage/study/cluster/worker.hpp"
#include "vantage/study/sweep/attempt.hpp"
#include "vantage/study/sweep/submission.hpp"

namespace vantage {
namespace {
using testing::HasSubstr;

SlurmTask task_in(const std::string& state) { return {"12", "3", state, "", 0, "n7"}; }

TEST(SlurmTasks, AreReadOfTheLinesOfSqueue) {
  const std::vector<SlurmTask> tasks =
      parse_slurm_tasks("12|3|RUNNING|None|2|n7|\nnothing\n\n13|N/A|PENDING|Priority|0||\n");
  ASSERT_EQ(tasks.size(), 2U);
  EXPECT_EQ(tasks[0].job, "12");
  EXPECT_EQ(tasks[0].task, "3");
  EXPECT_EQ(tasks[0].state, "RUNNING");
  EXPECT_EQ(tasks[0].reason, "");
  EXPECT_EQ(tasks[0].restart, 2);
  EXPECT_EQ(tasks[0].node, "n7");
  EXPECT_EQ(tasks[1].job, "13");
  EXPECT_EQ(tasks[1].task, "");
  EXPECT_EQ(tasks[1].state, "PENDING");
  EXPECT_EQ(tasks[1].reason, "Priority");
  EXPECT_EQ(tasks[1].restart, 0);
  EXPECT_EQ(tasks[1].node, "");
  const std::vector<SlurmTask> bare = parse_slurm_tasks("14||COMPLETED||N/A||\n");
  ASSERT_EQ(bare.size(), 1U) << "its state is enough";
  EXPECT_EQ(bare[0].restart, 0);
  EXPECT_EQ(SlurmTask{}.restart, 0);
}

TEST(SlurmTasks, AreAtWorkOrWaitOrAreLost) {
  for (const char* state : {"RUNNING", "COMPLETING", "CONFIGURING", "SUSPENDED", "STOPPED",
                            "SIGNALING", "STAGE_OUT", "RESIZING"}) {
    EXPECT_TRUE(is_at_work(task_in(state))) << state;
    EXPECT_TRUE(is_open(task_in(state))) << state;
    EXPECT_FALSE(is_lost(task_in(state))) << state;
  }
  for (const char* state : {"PENDING", "REQUEUED", "REQUEUE_FED", "REQUEUE_HOLD", "SPECIAL_EXIT"}) {
    EXPECT_FALSE(is_at_work(task_in(state))) << state;
    EXPECT_TRUE(is_open(task_in(state))) << state;
    EXPECT_FALSE(is_lost(task_in(state))) << state;
  }
  for (const char* state : {"FAILED", "TIMEOUT", "NODE_FAIL"}) {
    EXPECT_FALSE(is_open(task_in(state))) << state;
    EXPECT_TRUE(is_lost(task_in(state))) << state;
  }
  EXPECT_FALSE(is_open(task_in("COMPLETED")));
  EXPECT_FALSE(is_lost(task_in("COMPLETED")));
}

TEST(SlurmPlaces, AreOfOneTaskWhateverItsRestarts) {
  const SlurmPlace place{"c", "12", "3", 1};
  EXPECT_EQ(place.id(), "12_3");
  EXPECT_EQ((SlurmPlace{"c", "12", "", 1}.id()), "12");
  EXPECT_TRUE(place.same_task({"c", "12", "3", 5}));
  EXPECT_FALSE(place.same_task({"d", "12", "3", 1}));
  EXPECT_FALSE(place.same_task({"c", "13", "3", 1}));
  EXPECT_FALSE(place.same_task({"c", "12", "4", 1}));
}

TEST(Workers, AreReadBackAsTheyWereWritten) {
  Worker worker{.host = "n7", .machine = "n7 boot", .pid = 4711, .started = "99", .slurm = {}};
  const Worker bare = worker_of(worker_json(worker));
  EXPECT_EQ(bare.host, "n7");
  EXPECT_EQ(bare.machine, "n7 boot");
  EXPECT_EQ(bare.pid, 4711);
  EXPECT_EQ(bare.started, "99");
  EXPECT_FALSE(bare.slurm);
  worker.slurm = SlurmPlace{"c", "12", "3", 2};
  const Worker in_slurm = worker_of(worker_json(worker));
  ASSERT_TRUE(in_slurm.slurm);
  EXPECT_TRUE(in_slurm.slurm->same_task(*worker.slurm));
  EXPECT_EQ(in_slurm.slurm->restart, 2);
  const Worker odd = worker_of({{"host", 5}, {"pid", "many"}, {"slurm", "no"}});
  EXPECT_EQ(odd.host, "");
  EXPECT_EQ(odd.pid, 0);
  ASSERT_TRUE(odd.slurm);
  EXPECT_EQ(odd.slurm->job, "");
  EXPECT_FALSE(worker_of(nullptr).slurm);
}

TEST(Programs, EndWithTheirCodeAndWhatTheySaid) {
  const auto end = run_program({"sh", "-c", "echo out; echo err >&2; exit 3"});
  ASSERT_TRUE(end);
  EXPECT_EQ(end->exit_code, 3);
  EXPECT_EQ(end->output, "out\n");
  EXPECT_EQ(end->errors, "err\n");
  EXPECT_EQ(run_program({"sh", "-c", "kill -KILL $$"})->exit_code, 128 + 9);
  EXPECT_EQ(run_program({"printf", "x"})->output, "x");
  EXPECT_EQ(run_program({"sh", "-c", "head -c 10000 /dev/zero"})->output, std::string(10000, '\0'));
  EXPECT_FALSE(run_program({"no_such_program_zz"}));
}

TEST(Programs, HaveAnEmptyInput) {
  const support::TemporaryDirectory folder;
  write_file(folder / "input", "of this program alone");
  const int before = ::dup(STDIN_FILENO);
  const int file = ::open((folder / "input").c_str(), O_RDONLY);
  ::dup2(file, STDIN_FILENO);
  ::close(file);
  EXPECT_EQ(run_program({"cat"})->output, "");
  ::close(STDIN_FILENO);
  if (before >= 0) {
    ::dup2(before, STDIN_FILENO);
    ::close(before);
  }
}

/// What is said is kept in files that are deleted, of which a program has its own two beside those
/// that every program has which is started from here.
TEST(Programs, HaveNoFileBesideTheirOwn) {
  const auto deleted = [](const std::string& files) {
    std::size_t count = 0;
    for (auto at = files.find("(deleted)"); at != std::string::npos;
         at = files.find("(deleted)", at + 1)) {
      ++count;
    }
    return count;
  };
  const auto end = run_program({"ls", "-l", "/proc/self/fd"});
  ASSERT_TRUE(end);
  const std::string any = support::shell("ls -l /proc/self/fd < /dev/null").output;
  EXPECT_EQ(deleted(end->output), 2U + deleted(any)) << end->output;
}

/// Memory that was used before is taken again, with what is left in it.
TEST(Programs, HaveNoArgumentBeyondTheirLast) {
  std::vector<std::string> arguments{"sh", "-c", "echo $#", "sh"};
  arguments.resize(39, "x");
  for (int i = 0; i < 8; ++i) {
    const auto used = std::make_unique<volatile std::uintptr_t[]>(arguments.size() + 1);
    for (std::size_t k = 0; k <= arguments.size(); ++k) used[k] = UINTPTR_MAX;
  }
  EXPECT_EQ(run_program(arguments)->output, "35\n");
}

/// The signal comes while the program is waited for.
TEST(Programs, AreWaitedForThroughSignals) {
  struct sigaction ignore {};
  struct sigaction before {};
  ignore.sa_handler = [](int) {};  // without SA_RESTART
  ::sigaction(SIGUSR1, &ignore, &before);
  const auto end = run_program({"sh", "-c", "kill -USR1 $PPID; kill -USR1 $PPID; exit 3"});
  ::sigaction(SIGUSR1, &before, nullptr);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->exit_code, 3);
}

TEST(Programs, NeedAFileForWhatTheySay) {
  struct rlimit before {};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  struct rlimit none = before;
  none.rlim_cur = 0;
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
  std::string why;
  try {
    static_cast<void>(run_program({"true"}));
  } catch (const OutputError& error) {
    why = error.what();
  }
  ::setrlimit(RLIMIT_NOFILE, &before);
  EXPECT_THAT(why, testing::StartsWith("no temporary file: "));
  EXPECT_EQ(ProgramEnd{}.exit_code, 0);
}

/// The 22nd field is the time when a process began; the second, in brackets, is its name.
TEST(Workers, AreProcessesOfAMachine) {
  const Worker self = this_worker();
  std::array<char, 256> name{};
  ASSERT_EQ(::gethostname(name.data(), name.size() - 1), 0);
  const char* node = std::getenv("SLURMD_NODENAME");
  EXPECT_EQ(self.host, node == nullptr ? name.data() : node);
  std::string boot;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;
  EXPECT_EQ(self.machine, self.host + " " + boot + " " +
                              std::filesystem::read_symlink("/proc/self/ns/pid").string());
  EXPECT_EQ(self.pid, ::getpid());
  std::ifstream file("/proc/self/stat");
  std::string line;
  std::getline(file, line);
  std::istringstream fields(line.substr(line.rfind(')') + 1));
  const std::vector<std::string> found{std::istream_iterator<std::string>(fields), {}};
  EXPECT_EQ(self.started, found.at(22 - 3));
  EXPECT_EQ(Worker{}.pid, 0);
}

/// Of an array of five tasks, of its collection, and of an array that Slurm has forgotten.
const std::vector<Submission> kSubmitted{{"12", "13", 5}, {"20", "", 2}};

SlurmQueue queue_of_submitted() {
  SlurmQueue queue;
  queue.tasks = {{"12", "0", "RUNNING", "", 1, "n1"},
                 {"12", "1", "PENDING", "Priority", 0, ""},
                 {"12", "2", "PENDING", "BeginTime", 0, ""},
                 {"12", "3", "TIMEOUT", "", 0, "n2"},
                 {"99", "0", "RUNNING", "", 0, "n3"}};
  return queue;
}

TEST(Submissions, AreToldALineAJob) {
  EXPECT_EQ(submissions_text(kSubmitted, queue_of_submitted()),
            "array 12: 1 running, 2 queued (1 BeginTime, 1 Priority), 1 timeout, 1 ended, "
            "1 requeued before\ncollect 13: 1 ended\narray 20: 2 ended\n");
  EXPECT_EQ(submissions_text({}, queue_of_submitted()), "");
  SlurmQueue silent = queue_of_submitted();
  silent.silence = "no route";
  EXPECT_EQ(submissions_text(kSubmitted, silent), "Slurm does not answer: no route\n");
  EXPECT_EQ(submissions_text({}, silent), "");
  EXPECT_EQ(submissions_text({{"20", "", 2}, {"13", "21", 1}}, queue_of_submitted()),
            "array 20: 2 ended\narray 13: 1 ended\ncollect 21: 1 ended\n");
}

TEST(Submissions, AreToldAsJson) {
  const auto json = submissions_json(kSubmitted, queue_of_submitted());
  EXPECT_EQ(json["answers"], true);
  ASSERT_EQ(json["submissions"].size(), 2U);
  const auto& array = json["submissions"][0]["array"];
  EXPECT_EQ(array["job"], "12");
  EXPECT_EQ(array["tasks"], 5);
  EXPECT_EQ(array["running"], 1);
  EXPECT_EQ(array["queued"], 2);
  EXPECT_EQ(array["ended"], 1);
  EXPECT_EQ(array["lost"]["timeout"], 1);
  EXPECT_EQ(array["requeued"], 1);
  EXPECT_EQ(json["submissions"][0]["collect"]["ended"], 1);
  EXPECT_FALSE(json["submissions"][1].contains("collect"));
  SlurmQueue silent;
  silent.silence = "no route";
  EXPECT_EQ(submissions_json(kSubmitted, silent)["answers"], false);
}

TEST(Submissions, AreOpenWhileAJobOfThemIs) {
  const auto open_with = [](const std::string& job, const std::string& state) {
    SlurmQueue queue;
    queue.tasks = {{job, "", state, "", 0, ""}};
    return open_submissions(kSubmitted, queue).size();
  };
  EXPECT_EQ(open_with("12", "RUNNING"), 1U);
  EXPECT_EQ(open_with("13", "PENDING"), 1U);
  EXPECT_EQ(open_with("13", "COMPLETED"), 0U);
  EXPECT_EQ(open_with("14", "RUNNING"), 0U);
}

TEST(Submissions, AreReadOldestFirst) {
  const support::TemporaryDirectory study;
  std::filesystem::create_directories(study / "slurm");
  EXPECT_TRUE(read_submissions(study.path()).empty());
  write_file(study / "slurm/10.json", R"({"array": "10", "collect": "11", "tasks": 3})");
  write_file(study / "slurm/9.json", R"({"array": "9", "collect": "", "tasks": 4})");
  for (const char* other : {"0", "1", "2", "3", "4", "5", "6", "7", "8", "9"}) {
    write_file(study / "slurm" / (std::string(other) + ".sh"), "no record");
  }
  const std::vector<Submission> found = read_submissions(study.path());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].array, "9");
  EXPECT_EQ(found[0].collect, "");
  EXPECT_EQ(found[0].tasks, 4);
  EXPECT_EQ(found[1].array, "10");
  EXPECT_EQ(found[1].collect, "11");
  for (const char* wrong :
       {"[]", R"({"array": 9, "collect": "", "tasks": 4})", R"({"array": "9", "tasks": 4})",
        R"({"array": "9", "collect": "", "tasks": 1.5})"}) {
    write_file(study / "slurm/9.json", wrong);
    EXPECT_THROW((void)read_submissions(study.path()), InputError) << wrong;
  }
}

TEST(Submissions, ArgumentsOfSbatchAreOptionsThatSubmitDoesNotSet) {
  for (const char* good : {"--mem=2G", "-Aus", "-A", "--array-name=x", "-p"}) {
    EXPECT_NO_THROW(check_sbatch_arguments({good})) << good;
  }
  for (const char* wrong :
       {"mem", "--array=3", "-a", "-a3", "-a=3", "-d1", "--wait", "-W", "-o", "-ox.txt",
        "--output=x", "--wrap", "--parsable", "--open-mode=append"}) {
    EXPECT_THROW(check_sbatch_arguments({"--mem=2G", wrong}), ConfigError) << wrong;
  }
  const auto refusal = [](const char* argument) {
    try {
      check_sbatch_arguments({argument});
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(refusal("--dependency=afterany:1"),
            "--sbatch-arg --dependency=afterany:1: submit sets --dependency itself");
  for (const std::string array : {"--array", "-a"}) {
    const std::string argument = array + "=3";
    EXPECT_EQ(refusal(argument.c_str()), "--sbatch-arg " + argument + ": submit sets " + array +
                                             " itself; --array N is the number of tasks");
  }
}

TEST(Submissions, KeepNoStatesUnlessToldTo) {
  EXPECT_FALSE(SubmitOptions{}.keep_states);
  EXPECT_EQ(SubmitOptions{}.tasks, 1);
  EXPECT_EQ(Submission{}.tasks, 0);
}

/// Programs that stand in for Slurm's are all there are on PATH; they write down what they are
/// asked.
class AskedSlurm : public testing::Test {
 protected:
  AskedSlurm() {
    if (const char* path = std::getenv("PATH"); path != nullptr) path_before_ = path;
    ::setenv("PATH", folder_.path().c_str(), 1);
  }
  ~AskedSlurm() override { ::setenv("PATH", path_before_.c_str(), 1); }
  void program(const std::string& name, const std::string& does) {
    write_file(folder_ / name,
               "#!/bin/sh\nprintf '%s\\n' \"$@\" > " + asked().string() + "\n" + does + "\n");
    std::filesystem::permissions(folder_ / name, std::filesystem::perms::owner_all);
  }
  [[nodiscard]] std::filesystem::path asked() const { return folder_ / "asked"; }
  static std::string refusal_of(const auto& call) {
    try {
      call();
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "no error";
  }

  support::TemporaryDirectory folder_;
  std::string path_before_;
};

TEST_F(AskedSlurm, TellsOfEachJobOnce) {
  program("squeue", "echo '12|3|RUNNING|None|2|n7|'");
  EXPECT_TRUE(ask_slurm({}).jobs.empty());
  EXPECT_FALSE(std::filesystem::exists(asked())) << "of no jobs";
  const SlurmQueue queue = ask_slurm({"13", "12", "13"});
  EXPECT_THAT(queue.jobs, testing::ElementsAre("12", "13"));
  EXPECT_EQ(read_file(asked()),
            "--noheader\n--array\n--states=all\n--jobs=12,13\n--Format=ArrayJobID:|,ArrayTaskID:|,"
            "State:|,Reason:|,RestartCnt:|,NodeList:|\n");
  ASSERT_EQ(queue.tasks.size(), 1U);
  EXPECT_EQ(queue.tasks[0].restart, 2);
  EXPECT_EQ(queue.silence, "");
}

TEST_F(AskedSlurm, IsSilentForAReason) {
  EXPECT_EQ(ask_slurm({"12"}).silence, "there is no squeue on PATH");
  program("squeue", "exit 5");
  EXPECT_EQ(ask_slurm({"12"}).silence, "exit code 5");
  program("squeue", "echo '12|3|RUNNING|None|2|n7|'; echo down >&2; echo again >&2; exit 1");
  EXPECT_EQ(ask_slurm({"12"}).silence, "down;again");
  EXPECT_TRUE(ask_slurm({"12"}).tasks.empty());
  program("squeue", "echo 'slurm_load_jobs error: Invalid job id specified' >&2; exit 1");
  EXPECT_EQ(ask_slurm({"12"}).silence, "") << "it has forgotten all of them";
}

TEST_F(AskedSlurm, NamesTheJobThatItTakesOrSaysWhyNot) {
  const auto refusal = [] { return refusal_of([] { static_cast<void>(submit_batch({"a.sh"})); }); };
  EXPECT_THAT(refusal(), HasSubstr("sbatch: no such program"));
  EXPECT_THAT(refusal_of(require_slurm), HasSubstr("sbatch: no such program"));
  program("sbatch", "echo '12;cluster'");
  EXPECT_NO_THROW(require_slurm());
  EXPECT_EQ(submit_batch({"--wait", "a.sh"}), "12");
  EXPECT_EQ(read_file(asked()), "--parsable\n--wait\na.sh\n");
  program("sbatch", "echo 9051");
  EXPECT_EQ(submit_batch({"a.sh"}), "9051");
  program("sbatch", "echo maybe");
  EXPECT_EQ(refusal(), "sbatch --parsable a.sh: no job id but 'maybe'");
  program("sbatch", "");
  EXPECT_EQ(refusal(), "sbatch --parsable a.sh: no job id but ''");
  program("sbatch", "exit 3");
  EXPECT_EQ(refusal(), "sbatch --parsable a.sh: exit code 3");
  program("scancel", "echo unknown >&2; exit 1");
  EXPECT_EQ(refusal_of([] { cancel_jobs({"12", "13"}); }), "scancel 12 13: unknown");
}

TEST(EpisodeActivities, SayWhereAndHowOftenTheyBegan) {
  const support::TemporaryDirectory study;
  const std::vector<PlannedEpisode> plan{
      {"a", {}, {}}, {"b", {}, {}}, {"c", {}, {}}, {"d", {}, {}}, {"e", {}, {}}};
  SlurmQueue queue{{"12"}, {}, {}};
  for (int restart = 0; restart < 3; ++restart) {
    const std::string task = std::to_string(restart);
    Worker other{.host = "n7", .machine = "n7 x", .pid = 1, .started = "1", .slurm = {}};
    other.slurm = SlurmPlace{"c", "12", task, restart};
    const auto& episode = plan[static_cast<std::size_t>(restart)];
    ASSERT_TRUE(take_claim(claims_folder(study.path(), episode), 1, other));
    queue.tasks.push_back({"12", task, "RUNNING", "", restart, "n7"});
  }
  const Worker self = this_worker();
  ASSERT_TRUE(take_claim(claims_folder(study.path(), plan[3]), 1, self));
  const auto activities = [&](const std::vector<Submission>& submissions) {
    const std::vector<EpisodeState> states(5, EpisodeState::missing);
    return episode_activities(study.path(), plan, states, submissions, queue);
  };
  const std::vector<EpisodeActivity> found = activities({{"12", "", 3}});
  const std::string reasons[] = {"on n7, task 12_0", "on n7, task 12_1, requeued once",
                                 "on n7, task 12_2, requeued 2 times", "on " + self.host};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(found[i].state, "running") << i;
    EXPECT_EQ(found[i].reason, reasons[i]);
  }
  EXPECT_EQ(found[4].state, "queued");
  EXPECT_EQ(found[4].reason, "");
  EXPECT_EQ(activities({{"11", "12", 3}})[4].state, "") << "what collects runs no episode";
}

/// Those of others that began are told all the same.
TEST(EpisodeActivities, AreNoneOfWhatHasAResult) {
  const support::TemporaryDirectory study;
  const std::vector<PlannedEpisode> plan{{"a", {}, {}}, {"b", {}, {}}, {"c", {}, {}}};
  const Worker self = this_worker();
  for (const PlannedEpisode& episode : plan) {
    ASSERT_TRUE(take_claim(claims_folder(study.path(), episode), 1, self));
  }
  const SlurmQueue queue{{"12"}, {{"12", "0", "PENDING", "", 0, ""}}, {}};
  const std::vector<EpisodeActivity> found = episode_activities(
      study.path(), plan, {EpisodeState::completed, EpisodeState::failed, EpisodeState::missing},
      {{"12", "", 1}}, queue);
  EXPECT_EQ(found.at(0).state, "");
  EXPECT_EQ(found.at(1).state, "");
  EXPECT_EQ(found.at(2).state, "running");
}

}  // namespace
}  // namespace vantage
