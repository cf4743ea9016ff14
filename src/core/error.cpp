#include "vantage/core/error.hpp"

#include <cstdio>
#include <cstdlib>

namespace vantage {
namespace {

std::string summary(const std::vector<std::string>& problems) {
  expects(!problems.empty(), "a ConfigError without a problem");
  if (problems.size() == 1) return problems.front();
  return problems.front() + " (and " + std::to_string(problems.size() - 1) + " more)";
}

}  // namespace

ConfigError::ConfigError(std::vector<std::string> problems)
    : Error(ExitCode::usage, summary(problems)), problems_(std::move(problems)) {}

void assertion_failed(std::string_view what, const char* file, int line) {
  std::fprintf(stderr, "vantage: internal error: %.*s (%s:%d)\n", static_cast<int>(what.size()),
               what.data(), file, line);
  std::_Exit(static_cast<int>(ExitCode::internal));
}

}  // namespace vantage
