#include "bench/pages/freshness.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "vantage/study/cluster/program.hpp"

namespace vantage::bench {
namespace {

constexpr std::string_view kDirty = "-dirty";

/// What git says, and how it ended; its complaints are not shown.
ProgramEnd ask_git(const std::filesystem::path& repository, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"git", "-C", repository.string()});
  ProgramEnd answer = run_program(arguments).value_or(ProgramEnd{-1, {}, {}});
  while (answer.output.ends_with('\n')) answer.output.pop_back();
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
  std::vector<std::string> arguments{"diff", "--quiet", commit, "HEAD", "--"};
  arguments.insert(arguments.end(), origin.code.begin(), origin.code.end());
  for (const std::string& path : origin.but) arguments.push_back(":!" + path);
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
        ask_git(repository, {"log", "-1", "--format=%h", "--", origin.file.string()}).output;
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
