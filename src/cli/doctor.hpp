/// `vantage doctor`: what this machine can do.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "vantage/core/error.hpp"

namespace CLI {
class App;
}

namespace vantage {

struct DoctorReport {
  std::vector<std::pair<std::string, std::string>> lines;  ///< what, and how it is
  bool renderer_works = false;
};

DoctorReport examine();

std::function<ExitCode()> declare_doctor(CLI::App& app);

}  // namespace vantage
