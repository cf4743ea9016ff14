/// `vantage doctor`: what this machine can do.
#pragma once

#include <string>

namespace vantage {

struct DoctorReport {
  std::string text;
  bool renderer_works = false;
};

DoctorReport examine();

}  // namespace vantage
