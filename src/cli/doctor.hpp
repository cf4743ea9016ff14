/// `vantage doctor`: what this machine can do.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace vantage {

struct DoctorReport {
  std::vector<std::pair<std::string, std::string>> lines;  ///< what, and how it is
  bool renderer_works = false;
};

DoctorReport examine();

}  // namespace vantage
