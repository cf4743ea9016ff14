// Objects rendered by processes of their own: the same files, whatever becomes of the processes.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <future>
#include <map>
#include <string>
#include <vector>

#include "tests/support/shell.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/dataset/object_renderer.hpp"
#include "vantage/dataset/object_source.hpp"
#include "vantage/dataset/render_dataset.hpp"
#include "vantage/dataset/render_worker.hpp"
#include "vantage/dataset/worker_process.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

using Program = std::vector<std::string>;
const Program kWorker{VANTAGE_BINARY, "render-worker"};
Program script(const std::string& text) { return {"/bin/sh", "-c", text}; }

/// Few and small views.
DatasetOptions few_on_a_pool(int objects) {
  return {.objects = objects, .step_deg = 120.0, .supersampling = 1};
}

class RenderPool : public testing::Test {
 protected:
  std::map<std::string, std::string> contents(const std::string& dataset) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(out_ / dataset)) {
      const std::string name = fs::relative(entry.path(), out_ / dataset).string();
      files[name] = entry.is_regular_file() ? read_file(entry.path()) : "folder";
    }
    return files;
  }
  DatasetOutcome render(const std::string& dataset, int objects, int jobs, const Program& worker) {
    return render_dataset(few_on_a_pool(objects),
                          {.root = out_ / dataset, .jobs = jobs, .worker = worker});
  }
  /// Code and text of what it throws.
  std::pair<ExitCode, std::string> error_of(const DatasetOptions& options, const Program& worker) {
    try {
      render_dataset(options, {.root = out_ / "failed", .jobs = 2, .worker = worker});
    } catch (const Error& error) {
      return {error.code(), error.what()};
    }
    return {ExitCode::done, "no error"};
  }

  support::TemporaryDirectory out_;
};

TEST_F(RenderPool, FilesDoNotDependOnTheNumberOfProcesses) {
  render("here", 5, 1, {});
  const DatasetOutcome one = render("one", 5, 1, kWorker);
  EXPECT_EQ(one.rendered, 5);
  EXPECT_EQ(one.views, 5 * 9);
  render("three", 5, 3, kWorker);
  EXPECT_TRUE(contents("here") == contents("one"));
  EXPECT_TRUE(contents("here") == contents("three"));
}

TEST_F(RenderPool, WhatAProcessDiedOfIsRenderedByAnother) {
  render("whole", 3, 1, kWorker);
  const std::string part = (out_ / "parts/mug/.mug_1.part").string();
  const Program dies_once = script(
      fmt::format("if mkdir {} 2>/dev/null; then mkdir -p {}; echo half > {}/mug_1_9_1_crop.png; "
                  "kill -SEGV $$; fi; exec {} render-worker",
                  (out_ / "died").string(), part, part, VANTAGE_BINARY));
  EXPECT_EQ(render("parts", 3, 2, dies_once).rendered, 3);
  EXPECT_TRUE(fs::exists(out_ / "died"));
  EXPECT_TRUE(contents("whole") == contents("parts"));
}

TEST_F(RenderPool, AnObjectThatEveryProcessDiesOfIsNamed) {
  const auto [code, text] = error_of(few_on_a_pool(1), script("kill -SEGV $$"));
  EXPECT_EQ(code, ExitCode::no_renderer);
  EXPECT_THAT(text, AllOf(HasSubstr("mug_1"), HasSubstr("signal 11")));
  EXPECT_THAT(error_of(few_on_a_pool(1), {"/nowhere/vantage"}).second, HasSubstr("exit code 127"));
}

TEST_F(RenderPool, WhatAProcessSaysItFailedByComesThrough) {
  DatasetOptions options = few_on_a_pool(4);
  options.distance_m = 0.3;
  options.placement_m = 0.1;
  const auto [code, text] = error_of(options, kWorker);
  EXPECT_EQ(code, ExitCode::bad_input);
  EXPECT_THAT(text, HasSubstr("too far for the image"));
}

TEST(WorkerProcess, SaysNothingWhereResultsGo) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  WorkerProcess worker(script("echo out; echo err >&2; exit 3"));
  const std::string end = worker.wait_for_end();
  const std::string err = testing::internal::GetCapturedStderr();
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(err, "out\nerr\n");
  EXPECT_EQ(end, "exit code 3");
}

TEST_F(RenderPool, StoppedItLeavesWholeObjectsAlone) {
  render("whole", 6, 2, kWorker);
  int complete = 0;
  const DatasetOutcome stopped =
      render_dataset(few_on_a_pool(6),
                     {.root = out_ / "parts",
                      .jobs = 2,
                      .worker = kWorker,
                      .stop = [&] { return complete > 0; },
                      .tell = [&](int objects, int, const std::string&) { complete = objects; }});
  EXPECT_TRUE(stopped.stopped);
  EXPECT_LT(stopped.objects, 6);
  for (const auto& [name, content] : contents("parts")) {
    EXPECT_THAT(name, testing::Not(HasSubstr(".part")));
  }
  EXPECT_LE(render("parts", 6, 3, kWorker).rendered, 6 - stopped.objects);
  EXPECT_TRUE(contents("whole") == contents("parts"));
}

TEST_F(RenderPool, NoProcessOutlivesTheOneThatStartedIt) {
  const support::ShellResult result = support::shell(
      "cd '" + out_.path().string() +
      "'; " VANTAGE_BINARY
      " dataset render d --jobs 2 -q & pid=$!;"
      "children() { cat /proc/$pid/task/*/children; };"
      "until [ $(children | wc -w) = 2 ]; do kill -0 $pid || exit 3; sleep .02; done;"
      "workers=$(children); kill -9 $pid; wait $pid;"
      "for p in $workers; do i=0; while readlink /proc/$p/exe; do sleep .1; i=$((i + 1));"
      "[ $i -lt 300 ] || exit 4; done; done");
  EXPECT_EQ(result.exit_code, 0) << result.output;
}

/// However that one ends, and whatever it does: nobody tells it.
TEST(WorkerProcess, EndsWithTheProcessThatStartedIt) {
  std::array<int, 2> held{};  // its end to write to is open as long as one of them lives
  ASSERT_EQ(::pipe(held.data()), 0);
  const pid_t starter = ::fork();
  if (starter == 0) {
    const WorkerProcess worker(script("echo >&0; exec sleep 60"));
    char begun = 0;
    const ssize_t size = ::read(worker.socket(), &begun, 1);
    ::_exit(size == 1 ? 0 : 1);
  }
  ::close(held[1]);
  int status = 0;
  ::waitpid(starter, &status, 0);
  EXPECT_EQ(status, 0);
  pollfd end{held[0], POLLIN, 0};
  EXPECT_EQ(::poll(&end, 1, 20000), 1) << "it lives on";
  ::close(held[0]);
}

/// Three processes may try it, no more.
TEST_F(RenderPool, WhatTwoProcessesDiedOfIsRenderedByTheThird) {
  const auto dies = [&](int times) {
    return script(fmt::format(
        "echo x >>{0}; [ $(wc -l <{0}) -gt {1} ] || kill -SEGV $$; exec {2} render-worker",
        (out_ / "tries").string(), times, VANTAGE_BINARY));
  };
  EXPECT_EQ(render("d", 1, 1, dies(2)).rendered, 1);
  EXPECT_EQ(read_file(out_ / "tries"), "x\nx\nx\n");
  fs::remove(out_ / "tries");
  EXPECT_EQ(error_of(few_on_a_pool(1), dies(3)).first, ExitCode::no_renderer);
  EXPECT_EQ(read_file(out_ / "tries"), "x\nx\nx\n");
}

TEST_F(RenderPool, AProcessRendersOneObjectAfterTheOther) {
  const Program counted = script(fmt::format("echo x >>{}; exec {} render-worker",
                                             (out_ / "starts").string(), VANTAGE_BINARY));
  EXPECT_EQ(render("d", 3, 1, counted).rendered, 3);
  EXPECT_EQ(read_file(out_ / "starts"), "x\n");
}

TEST(WorkerProcess, DrawsInOneThreadAndKnowsTheRestOfTheEnvironment) {
  const char* set = std::getenv("LP_NUM_THREADS");
  const std::string before = set != nullptr ? set : "";
  ::setenv("LP_NUM_THREADS", "7", 1);
  ::setenv("VANTAGE_TEST_TOLD", "yes", 1);
  testing::internal::CaptureStderr();
  WorkerProcess worker(script("echo $LP_NUM_THREADS $VANTAGE_TEST_TOLD; kill -TERM $$"));
  const std::string end = worker.wait_for_end();
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "0 yes\n");
  EXPECT_EQ(end, "signal 15 (Terminated)");
  ::unsetenv("VANTAGE_TEST_TOLD");
  if (set == nullptr) ::unsetenv("LP_NUM_THREADS");
  if (set != nullptr) ::setenv("LP_NUM_THREADS", before.c_str(), 1);
}

TEST(RenderServer, GoesByTheFolderAndTheOptionsOfEachRequest) {
  const support::TemporaryDirectory out;
  std::array<int, 2> ends{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
  auto served = std::async(std::launch::async, [&] { return serve_rendering(ends[1]); });
  DatasetOptions one_video = few_on_a_pool(2);
  one_video.step_deg = 360.0;
  one_video.videos = {1};
  DatasetOptions two_videos = one_video;
  two_videos.videos = {1, 2};
  const std::vector<ObjectName> mugs = object_names(one_video);
  const auto views = [&](const DatasetOptions& options, const char* folder, const ObjectName& mug) {
    const std::string root = (out / folder).string();
    send_message(ends[0],
                 to_message(RenderRequestMessage{to_yaml(write_node(options)), root, mug}));
    std::string received;
    std::array<char, 512> buffer{};
    while (true) {
      const ssize_t size = ::recv(ends[0], buffer.data(), buffer.size(), 0);
      if (size <= 0) return -1;
      received.append(buffer.data(), static_cast<std::size_t>(size));
      if (const auto message = take_message(received)) {
        EXPECT_EQ(parse_answer(*message).error, "");
        return parse_answer(*message).views;
      }
    }
  };
  EXPECT_EQ(views(one_video, "a", mugs[0]), 1);
  EXPECT_EQ(views(one_video, "b", mugs[0]), 1);
  EXPECT_EQ(views(two_videos, "b", mugs[1]), 2);
  ::shutdown(ends[0], SHUT_WR);
  EXPECT_EQ(served.get(), ExitCode::done);
  for (const int end : ends) ::close(end);
  EXPECT_TRUE(fs::exists(object_folder(out / "a", mugs[0])));
  EXPECT_TRUE(fs::exists(object_folder(out / "b", mugs[0])));
  EXPECT_TRUE(fs::exists(object_folder(out / "b", mugs[1])));
}

}  // namespace
}  // namespace vantage
