#include "vantage/sim/faults/fault_record.hpp"

#include <fmt/format.h>

namespace vantage {

void FaultRecord::strike(Fault fault, double time_s, std::int64_t times) {
  constexpr double kPause_s = 1.0;
  if (times == 0) return;
  const auto i = static_cast<std::size_t>(fault);
  if (struck_[i] == 0 || time_s - last_s_[i] > kPause_s) onsets_.push_back({time_s, fault});
  struck_[i] += times;
  last_s_[i] = time_s;
}

std::int64_t FaultRecord::struck(Fault fault) const {
  return struck_[static_cast<std::size_t>(fault)];
}

std::string FaultRecord::csv() const {
  std::string text = "time_s,fault\n";
  for (const auto& [time_s, fault] : onsets_) {
    text += fmt::format("{:.3f},{}\n", time_s, name_of(fault));
  }
  return text;
}

}  // namespace vantage
