// Lines there and back, and how a program fails that does not answer.
#include "vantage/runtime/process/conversation.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {

/// Which no test leaves to be reached.
constexpr double kAnswersWithin_s = 30.0;

class Conversations : public testing::Test {
 protected:
  Conversation with(const std::string& script) {
    return {{.command = {"/bin/sh", "-c", script},
             .working_directory = folder_.path(),
             .environment = {"PATH=/usr/bin:/bin"}},
            [this](std::string_view line) { told_.emplace_back(line); },
            [this] {
              ++waits_;
              if (stop_waiting_) throw std::runtime_error("no more");
            }};
  }
  std::string talk_failure(const std::string& script, double timeout_s = kAnswersWithin_s,
                           const std::string& line = "question") {
    Conversation conversation = with(script);
    try {
      return "answered " + conversation.ask(line, timeout_s);
    } catch (const ConversationFailed& error) {
      EXPECT_EQ(error.code(), ExitCode::goal_failed);
      return error.what();
    }
  }
  support::TemporaryDirectory folder_;
  std::vector<std::string> told_;
  int waits_ = 0;
  bool stop_waiting_ = false;
};

TEST_F(Conversations, GoLineByLine) {
  Conversation conversation = with("while read line; do echo \"<$line>\"; done");
  for (const char* line : {"one", "", "three and four"}) {
    EXPECT_EQ(conversation.ask(line, kAnswersWithin_s), "<" + std::string(line) + ">");
  }
  const std::string long_line(30000, 'x');
  EXPECT_EQ(conversation.ask(long_line, kAnswersWithin_s), "<" + long_line + ">");
}

TEST_F(Conversations, FailWhereTheProgramEnds) {
  EXPECT_EQ(talk_failure("read q; exit 3"), "it ended: exit code 3");
  EXPECT_EQ(talk_failure("read q; printf abc"), "it ended in the middle of a line: exit code 0");
  EXPECT_EQ(talk_failure("read q; kill -KILL $$; sleep 100"), "it ended: signal 9 (Killed)");
  EXPECT_EQ(talk_failure("read q; exec >&-; sleep 100"), "it closed its output");
  EXPECT_EQ(talk_failure("read q; printf a; exec >&-; sleep 100"),
            "it closed its output in the middle of a line");
}

TEST_F(Conversations, FailByWhatTheProgramSaidLast) {
  EXPECT_EQ(talk_failure("echo first >&2; printf ' b\\303\\244d \\n\\n' >&2; exit 3"),
            "it ended: exit code 3, after it said:  b\\xc3\\xa4d");
  EXPECT_EQ(talk_failure("echo \"$PWD/x and $PWD/y\" >&2; exit 1"),
            "it ended: exit code 1, after it said: ./x and ./y");
  EXPECT_EQ(talk_failure("echo \"$PWD$PWD\" >&2; exit 1"),
            "it ended: exit code 1, after it said: ..");
  EXPECT_EQ(talk_failure("printf '\\n  ' >&2; exit 3"), "it ended: exit code 3");
  EXPECT_EQ(talk_failure("head -c 300 /dev/zero | tr '\\000' x >&2; exit 1"),
            "it ended: exit code 1, after it said: " + std::string(200, 'x') + " ...");
  EXPECT_EQ(talk_failure("echo gone >&2; exec >&-; sleep 100"),
            "it closed its output, after it said: gone");
}

TEST_F(Conversations, FailByMoreThanOneLine) {
  EXPECT_EQ(talk_failure("read q; printf 'a\\nb\\n'; read q"),
            "it said more than one line to one question");
  Conversation conversation = with("read q; echo a; sleep 0.2; echo b; read q; echo c");
  EXPECT_EQ(conversation.ask("q", kAnswersWithin_s), "a");
  std::this_thread::sleep_for(std::chrono::milliseconds(1000));
  EXPECT_THROW(conversation.ask("q", kAnswersWithin_s), ConversationFailed);
}

TEST_F(Conversations, MayBeginWithALineThatNobodyAskedFor) {
  Conversation conversation = with("echo hello; read q; read q; echo $q; read q");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(conversation.ask("one", kAnswersWithin_s), "hello");
  EXPECT_EQ(conversation.ask("two", kAnswersWithin_s), "two");
}

TEST_F(Conversations, FailByTheirTime) {
  EXPECT_EQ(talk_failure("sleep 100", 1.0), "no answer within 1 s");
  EXPECT_GE(waits_, 3) << "asked whether to go on several times a second";
  EXPECT_EQ(talk_failure("sleep 100", 0.5, std::string(300000, 'x')),
            "no answer within 0.5 s, it does not read what it is asked");
}

TEST_F(Conversations, EndAsSoonAsNobodyWaits) {
  stop_waiting_ = true;
  Conversation conversation = with("sleep 100");
  EXPECT_THROW(conversation.ask("q", kAnswersWithin_s), std::runtime_error);
}

TEST_F(Conversations, FailByAFloodWithoutAnEnd) {
  EXPECT_EQ(talk_failure("read q; yes | tr -d '\\n'"),
            "it floods its output: more than 65536 bytes without an answer");
}

TEST_F(Conversations, PassOnWhatIsSaidBesideTheAnswer) {
  Conversation conversation = with("read q; echo one >&2; echo two >&2; echo done; read q");
  EXPECT_EQ(conversation.ask("q", kAnswersWithin_s), "done");
  EXPECT_EQ(told_, (std::vector<std::string>{"one", "two"}));
}

/// Lines of 100 bytes with their ends: 655 of them are 65500 bytes.
TEST_F(Conversations, PassOnNoMoreThanABound) {
  const std::string line(99, 'x');
  Conversation conversation = with("read q; i=0; while [ $i -lt 700 ]; do echo " + line +
                                   "; i=$((i + 1)); done >&2; echo done; read q");
  EXPECT_EQ(conversation.ask("q", kAnswersWithin_s), "done");
  ASSERT_EQ(told_.size(), 656U);
  EXPECT_EQ(told_[654], line);
  EXPECT_EQ(told_[655], "(more than 65536 bytes: the rest is left out)");
}

TEST_F(Conversations, EndWithALastLineAndTheEndOfTheInput) {
  Conversation conversation = with("read q; echo a; cat > last; echo over > end");
  EXPECT_EQ(conversation.ask("q", kAnswersWithin_s), "a");
  conversation.part("bye", 10.0);
  EXPECT_EQ(read_file(folder_ / "last"), "bye\n");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "end")) << "it saw the end of its input";
}

/// Who writes to it is told by an error, not by a signal.
TEST_F(Conversations, OutliveAProgramThatListensNoMore) {
  Conversation conversation = with("read q; exec <&-; echo hello; sleep 100");
  EXPECT_EQ(conversation.ask("one", kAnswersWithin_s), "hello");
  try {
    conversation.ask(std::string(300000, 'x'), 0.5);
    ADD_FAILURE() << "nobody heard it";
  } catch (const ConversationFailed& error) {
    EXPECT_STREQ(error.what(), "no answer within 0.5 s") << "what is lost is not left to be read";
  }
  sigset_t blocked;
  ::pthread_sigmask(SIG_BLOCK, nullptr, &blocked);
  EXPECT_EQ(::sigismember(&blocked, SIGPIPE), 0) << "as it was before";
}

/// The last 4096 bytes of 5000 in one line, and of these the first 200.
TEST_F(Conversations, FailByTheEndOfWhatTheProgramSaid) {
  std::string said;
  for (int i = 0; said.size() < 5000; ++i) said += std::to_string(i) + ".";
  said.resize(5000);
  EXPECT_EQ(talk_failure("printf %s " + said + " >&2; exit 1"),
            "it ended: exit code 1, after it said: " + said.substr(5000 - 4096, 200) + " ...");
}

TEST_F(Conversations, PassOnALastLineThatHasNoEnd) {
  talk_failure("echo one >&2; exit 3");
  EXPECT_EQ(told_, std::vector<std::string>{"one"});
  told_.clear();
  talk_failure("echo one >&2; printf x >&2; exit 3");
  EXPECT_EQ(told_, (std::vector<std::string>{"one", "x"}));
}

/// Lines of 64 bytes with their ends: 1024 of them are 65536 bytes.
TEST_F(Conversations, PassOnAsMuchAsTheBoundAndSayOnceThatThereIsMore) {
  const std::string line(63, 'x');
  Conversation conversation =
      with("read q; i=0; while [ $i -lt 1024 ]; do echo " + line +
           "; i=$((i + 1)); done >&2; echo a; read q; echo more >&2; echo b; read q; echo more >&2;"
           " echo c; read q");
  EXPECT_EQ(conversation.ask("q", kAnswersWithin_s), "a");
  ASSERT_EQ(told_.size(), 1024U);
  EXPECT_EQ(told_.back(), line);
  EXPECT_EQ(conversation.ask("q", kAnswersWithin_s), "b");
  ASSERT_EQ(told_.size(), 1025U);
  EXPECT_EQ(told_.back(), "(more than 65536 bytes: the rest is left out)");
  EXPECT_EQ(conversation.ask("q", kAnswersWithin_s), "c");
  EXPECT_EQ(told_.size(), 1025U);
}

/// Though it closes its output before.
TEST_F(Conversations, EndWithWhatTheProgramDoesAndSaysAtLast) {
  Conversation conversation =
      with("read q; echo a; read q; exec >&-; sleep 0.05; echo over > end; echo done >&2");
  EXPECT_EQ(conversation.ask("q", kAnswersWithin_s), "a");
  conversation.part("bye", 10.0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "end"));
  EXPECT_EQ(told_, std::vector<std::string>{"done"});
}

}  // namespace
}  // namespace vantage
