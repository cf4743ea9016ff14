#include "tests/cli/program_inside.hpp"

#include <sys/wait.h>
#include <unistd.h>
#include <wordexp.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <set>
#include <string>

// Its main() is called below.
#define main vantage_main
#include "src/cli/main.cpp"  // NOLINT(bugprone-suspicious-include)
#undef main

namespace vantage::support {
namespace {

/// Words of a command, as a shell tells them apart.
class ShellWords {
 public:
  explicit ShellWords(const std::string& text)
      : understood_(::wordexp(text.c_str(), &words_, WRDE_NOCMD | WRDE_UNDEF) == 0) {}
  ~ShellWords() {
    if (understood_) ::wordfree(&words_);
  }
  ShellWords(const ShellWords&) = delete;
  ShellWords& operator=(const ShellWords&) = delete;

  [[nodiscard]] bool understood() const { return understood_; }
  [[nodiscard]] int count() const { return static_cast<int>(words_.we_wordc); }
  [[nodiscard]] char** words() { return words_.we_wordv; }

 private:
  wordexp_t words_{};
  bool understood_;
};

/// Of itself, by /proc/self/exe, which is the test here.
bool starts_programs(const std::set<std::string>& words) {
  const auto has = [&](const char* word) { return words.contains(word); };
  if (has("--help")) return false;
  return ((has("sweep") || has("arena")) &&
          (has("run") || has("add") || has("work") || has("submit"))) ||
         (has("dataset") && has("render")) ||
         (has("train") && std::ranges::any_of(words, [](const std::string& word) {
            return word.starts_with("--recipe");
          }));
}

/// A fork has none of them, and what they hold is held for ever there.
bool has_other_threads() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/task"),
                       std::filesystem::directory_iterator()) > 1;
}

/// As a program of its own: what it throws ends it, and it holds nothing of the pipe but its
/// output, which is written in blocks even if that of the test is a terminal.
[[noreturn]] void run_in_child(const std::filesystem::path& folder, ShellWords& words,
                               const std::array<int, 2>& ends) noexcept {
  ::dup2(ends[1], STDOUT_FILENO);
  ::dup2(ends[1], STDERR_FILENO);
  for (const int end : ends) ::close(end);
  std::setvbuf(stdout, nullptr, _IOFBF, BUFSIZ);
  if (::chdir(folder.c_str()) != 0) ::_exit(127);
  const int code = vantage_main(words.count(), words.words());
  std::fflush(nullptr);
  ::_exit(code);
}

}  // namespace

std::optional<ShellResult> run_inside(const std::filesystem::path& folder,
                                      const std::string& arguments) {
  // Names of files are those of the folder, which a shell is in.
  if (arguments.find_first_of("$*?") != std::string::npos || has_other_threads()) return {};
  ShellWords words("vantage " + arguments);
  if (!words.understood() || starts_programs({words.words(), words.words() + words.count()}))
    return {};
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) return {};
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) run_in_child(folder, words, ends);
  ::close(ends[1]);
  if (child < 0) {
    ::close(ends[0]);
    return {};
  }
  ShellResult result;
  std::array<char, 4096> buffer{};
  for (ssize_t n = 0; (n = ::read(ends[0], buffer.data(), buffer.size())) > 0;) {
    result.output.append(buffer.data(), static_cast<std::size_t>(n));
  }
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

}  // namespace vantage::support
