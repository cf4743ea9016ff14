#include "bench/freshness.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>

namespace vantage::bench {
namespace {

constexpr std::string_view kDirty = "-dirty";

struct Answer {
  int exit_code = -1;
  std::string text;
};

/// What git says; its complaints are not shown.
Answer ask_git(const std::filesystem::path& repository, const std::string& arguments) {
  const std::string command =
      fmt::format("git -C '{}' {} 2>/dev/null", repository.string(), arguments);
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  Answer answer;
  std::array<char, 256> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) answer.text += buffer.data();
  const int status = pclose(pipe);
  if (WIFEXITED(status)) answer.exit_code = WEXITSTATUS(status);
  while (answer.text.ends_with('\n')) answer.text.pop_back();
  return answer;
}

/// "b100039" of "0.1.0 (b100039)", else the text.
std::string within_brackets(const std::string& text) {
  const auto open = text.find('(');
  const auto close = text.find(')');
  if (open == std::string::npos || close == std::string::npos || close < open) return text;
  return text.substr(open + 1, close - open - 1);
}

bool is_commit(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

Freshness since(const std::string& commit, const Origin& origin,
                const std::filesystem::path& repository) {
  if (!is_commit(commit)) return Freshness::unknown;
  std::string arguments = fmt::format("diff --quiet {} HEAD --", commit);
  for (const std::string& path : origin.code) arguments += fmt::format(" '{}'", path);
  const int exit_code = ask_git(repository, arguments).exit_code;
  if (exit_code == 0) return Freshness::fresh;
  return exit_code == 1 ? Freshness::stale : Freshness::unknown;
}

/// At most as good as what is behind it.
Freshness worse(Freshness a, Freshness b) {
  if (a == Freshness::stale || b == Freshness::stale) return Freshness::stale;
  return std::max(a, b);
}

}  // namespace

std::string mark(Freshness freshness) {
  switch (freshness) {
    case Freshness::fresh: return "";
    case Freshness::stale: return " \\*";
    case Freshness::unknown: break;
  }
  return " ?";
}

Freshness freshness_of(const Origin& origin, const std::filesystem::path& repository) {
  if (origin.commits.empty()) {
    const std::string brought =
        ask_git(repository, fmt::format("log -1 --format=%h -- '{}'", origin.file.string())).text;
    return worse(since(brought, origin, repository), Freshness::unknown);
  }
  Freshness all = Freshness::fresh;
  for (const std::string& recorded : origin.commits) {
    std::string commit = within_brackets(recorded);
    if (commit.ends_with(kDirty)) {
      commit.resize(commit.size() - kDirty.size());
      all = worse(all, Freshness::unknown);
    }
    all = worse(all, since(commit, origin, repository));
  }
  return all;
}

}  // namespace vantage::bench
