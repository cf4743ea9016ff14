#include "vantage/sim/world/mujoco_errors.hpp"

#include <mujoco/mujoco.h>

#include <mutex>

#include "vantage/core/log.hpp"
#include "vantage/sim/stepping/near_pairs.hpp"

namespace vantage {
namespace {

thread_local std::vector<std::string>* collected_warnings = nullptr;

std::string trimmed(const char* message) {
  std::string text = message;
  text.erase(text.find_last_not_of(" \n\r\t") + 1);
  return text;
}

[[noreturn]] void throw_error(const char* message) { throw MujocoError(trimmed(message)); }

void collect_warning(const char* message) {
  if (collected_warnings != nullptr) {
    collected_warnings->push_back(trimmed(message));
  } else {
    log_warning("MuJoCo: " + trimmed(message));
  }
}

}  // namespace

void install_mujoco_handlers() {
  static std::once_flag once;
  std::call_once(once, [] {
    mju_user_error = throw_error;
    mju_user_warning = collect_warning;
    mjcb_contactfilter = discard_far_pair;
  });
}

WarningCollector::WarningCollector(std::vector<std::string>& sink) : previous_(collected_warnings) {
  collected_warnings = &sink;
}

WarningCollector::~WarningCollector() { collected_warnings = previous_; }

}  // namespace vantage
