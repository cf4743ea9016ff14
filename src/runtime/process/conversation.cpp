#include "vantage/runtime/process/conversation.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <utility>

namespace vantage {
namespace {

constexpr double kSlice_s = 0.05;
constexpr std::size_t kRememberedErrorBytes = 4096;
constexpr std::size_t kToldErrorLetters = 200;

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Writing to a program that has ended is an error like any other in this thread.
class NoBrokenPipeSignal {
 public:
  NoBrokenPipeSignal() {
    ::sigemptyset(&pipe_);
    ::sigaddset(&pipe_, SIGPIPE);
    sigset_t pending;
    ::sigpending(&pending);
    was_pending_ = ::sigismember(&pending, SIGPIPE) == 1;
    ::pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  NoBrokenPipeSignal(const NoBrokenPipeSignal&) = delete;
  NoBrokenPipeSignal& operator=(const NoBrokenPipeSignal&) = delete;
  ~NoBrokenPipeSignal() {
    const timespec none{};
    if (!was_pending_) {
      while (::sigtimedwait(&pipe_, nullptr, &none) < 0 && errno == EINTR) {
      }
    }
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

 private:
  sigset_t pipe_{};
  sigset_t before_{};
  bool was_pending_ = false;
};

/// What can be read now. @return false at its end
bool read_some(int from, std::string_view& bytes, std::array<char, 4096>& room) {
  const ssize_t got = ::read(from, room.data(), room.size());
  if (got > 0) bytes = {room.data(), static_cast<std::size_t>(got)};
  return got > 0 || (got < 0 && (errno == EAGAIN || errno == EINTR));
}

}  // namespace

Conversation::Conversation(const ProgramToRun& program,
                           std::function<void(std::string_view)> on_error,
                           std::function<void()> on_wait)
    : working_directory_(program.working_directory.string()),
      process_(program),
      on_error_(std::move(on_error)),
      on_wait_(std::move(on_wait)) {}

std::string Conversation::ask(std::string_view line, double timeout_s) {
  exchange_for(0.0);
  // Who says his first line at once may have said it already.
  if (std::exchange(was_asked_, true) && heard_.waiting() > 0) {
    throw ConversationFailed("it said more than one line, or spoke before it was asked");
  }
  unsent_ = std::string(line) + "\n";
  const double until_s = now_s() + timeout_s;
  while (true) {
    if (auto answer = heard_.take()) {
      if (heard_.waiting() == 0) return *answer;
      throw ConversationFailed("it said more than one line to one question");
    }
    if (!hears_) fail_ended();
    const double left_s = until_s - now_s();
    if (left_s <= 0.0) {
      throw ConversationFailed(
          fmt::format("no answer within {:g} s{}", timeout_s,
                      unsent_.empty() ? "" : ", it does not read what it is asked"));
    }
    // A process that it started may hold its output open after it.
    const bool has_ended = process_.wait_for_end(0.0).has_value();
    const std::size_t heard = heard_.waiting();
    exchange_for(std::min(left_s, kSlice_s));
    if (has_ended && heard_.waiting() == heard) fail_ended();
    on_wait_();
  }
}

void Conversation::part(std::string_view line, double grace_s) {
  unsent_ = std::string(line) + "\n";
  const double until_s = now_s() + grace_s;
  while (hears_ && now_s() < until_s) {
    if (unsent_.empty()) process_.close_input();
    exchange_for(std::min(until_s - now_s(), kSlice_s));
    while (heard_.take()) {
    }
  }
  process_.wait_for_end(std::max(0.0, until_s - now_s()));
  hear_errors();
}

void Conversation::fail_ended() {
  constexpr double kSoon_s = 0.5;
  const auto end = process_.wait_for_end(kSoon_s);
  hear_errors();
  const char* midway = heard_.waiting() > 0 ? " in the middle of a line" : "";
  const std::string how = end ? fmt::format("it ended{}: {}", midway, *end)
                              : fmt::format("it closed its output{}", midway);
  const std::string said = last_error();
  throw ConversationFailed(said.empty() ? how : how + ", after it said: " + said);
}

void Conversation::remember_error(std::string_view bytes) {
  last_errors_ += bytes;
  if (last_errors_.size() > kRememberedErrorBytes) {
    last_errors_.erase(0, last_errors_.size() - kRememberedErrorBytes);
  }
}

/// Its last line that is not empty, for people. The working directory, another one each time, is
/// its `.`; empty: it said nothing.
std::string Conversation::last_error() const {
  const auto end = last_errors_.find_last_not_of(" \t\r\n");
  if (end == std::string::npos) return {};
  const auto before = last_errors_.find_last_of("\r\n", end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  std::string line = last_errors_.substr(begin, end + 1 - begin);
  const std::string& folder = working_directory_;
  for (auto at = line.find(folder); !folder.empty() && at != std::string::npos;
       at = line.find(folder, at + 1)) {
    line.replace(at, folder.size(), ".");
  }
  return printable(line, kToldErrorLetters);
}

/// Moves what there is in either direction, or waits for it.
void Conversation::exchange_for(double at_most_s) {
  std::array<pollfd, 3> ends{};
  ends[0] = {hears_ ? process_.output() : -1, POLLIN, 0};
  ends[1] = {hears_errors_ ? process_.errors() : -1, POLLIN, 0};
  ends[2] = {unsent_.empty() ? -1 : process_.input(), POLLOUT, 0};
  const int wait_ms = std::max(at_most_s > 0.0 ? 1 : 0, static_cast<int>(1e3 * at_most_s));
  if (::poll(ends.data(), ends.size(), wait_ms) <= 0) return;
  if (ends[1].revents != 0) hear_errors();
  if (ends[2].revents != 0) send();
  if (ends[0].revents != 0) hear();
}

/// What is asked after its input was closed is lost: no answer comes.
void Conversation::send() {
  const NoBrokenPipeSignal guard;
  const ssize_t sent = ::write(process_.input(), unsent_.data(), unsent_.size());
  if (sent > 0) unsent_.erase(0, static_cast<std::size_t>(sent));
  if (sent < 0 && errno != EAGAIN && errno != EINTR) {
    process_.close_input();
    unsent_.clear();
  }
}

void Conversation::hear() {
  std::array<char, 4096> room{};
  std::string_view bytes;
  hears_ = read_some(process_.output(), bytes, room);
  if (heard_.add(bytes)) return;
  throw ConversationFailed(
      fmt::format("it floods its output: more than {} bytes without an answer", kMaxAnswerBytes));
}

/// The log shall not grow with what it says.
void Conversation::hear_errors() {
  std::array<char, 4096> room{};
  for (int pieces = 0; hears_errors_ && pieces < 64; ++pieces) {
    std::string_view bytes;
    hears_errors_ = read_some(process_.errors(), bytes, room);
    if (bytes.empty() && hears_errors_) break;
    remember_error(bytes);
    if (errors_told_ > kMaxErrorBytes) continue;
    const bool all = errors_.add(bytes);
    if (!hears_errors_ && errors_.waiting() > 0) errors_.add("\n");
    while (const auto line = errors_.take()) {
      errors_told_ += line->size() + 1;
      if (errors_told_ <= kMaxErrorBytes) on_error_(*line);
    }
    if (all && errors_told_ <= kMaxErrorBytes) continue;
    errors_told_ = kMaxErrorBytes + 1;
    on_error_(fmt::format("(more than {} bytes: the rest is left out)", kMaxErrorBytes));
  }
}

}  // namespace vantage
