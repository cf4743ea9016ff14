/// Writes the run folder of the task `wait`.
#pragma once

#include "vantage/runtime/recorder.hpp"

namespace vantage {

/// What is known of a scan.
struct WaitRecord {
  double time_s = 0.0;
  std::size_t returns = 0;
};

class WaitRecorder : public EpisodeRecorder {
 public:
  WaitRecorder(const EpisodeRun& run, RecordedRobot robot, int scans);
  void scan(const WaitRecord& record, std::size_t number);
};

}  // namespace vantage
