/// How often each fault struck, and when it began to.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "vantage/sim/faults/fault_options.hpp"

namespace vantage {

class FaultRecord {
 public:
  void strike(Fault fault, double time_s, std::int64_t times = 1);
  [[nodiscard]] std::int64_t struck(Fault fault) const;

  /// A row whenever a fault strikes that has not struck for a second: time_s, fault.
  [[nodiscard]] std::string csv() const;

 private:
  struct Onset {
    double time_s;
    Fault fault;
  };
  std::array<std::int64_t, kFaults> struck_{};
  std::array<double, kFaults> last_s_{};
  std::vector<Onset> onsets_;
};

}  // namespace vantage
