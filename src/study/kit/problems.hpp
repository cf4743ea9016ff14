/// Collects what is wrong with a file, where ending at the first problem would hide the others.
#pragma once

#include <string>
#include <vector>

#include "vantage/core/error.hpp"

namespace vantage {

class Problems {
 public:
  /// Runs `work`, which may throw ConfigError or InputError: each problem is kept, once.
  /// @return whether there was none
  bool attempt(auto&& work) {
    try {
      work();
      return true;
    } catch (const ConfigError& error) {
      for (const std::string& problem : error.problems()) add(problem, error.code());
    } catch (const InputError& error) {
      add(error.what(), error.code());
    }
    return false;
  }

  [[nodiscard]] const std::vector<std::string>& texts() const { return texts_; }
  /// bad_input if it is all about files that are read, usage if a configuration is wrong.
  [[nodiscard]] ExitCode code() const { return code_; }
  /// @throws ConfigError with all of them; InputError if all are about files that are read
  void throw_if_any() const;

 private:
  void add(const std::string& text, ExitCode code);

  std::vector<std::string> texts_;
  ExitCode code_ = ExitCode::done;
};

}  // namespace vantage
