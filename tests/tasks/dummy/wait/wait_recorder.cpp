#include "vantage/tasks/wait/wait_recorder.hpp"

#include <fmt/format.h>

#include <utility>

namespace vantage {

WaitRecorder::WaitRecorder(const EpisodeRun& run, RecordedRobot robot, int scans)
    : EpisodeRecorder(run, std::move(robot), "time_s,scan,returns", scans) {}

void WaitRecorder::scan(const WaitRecord& record, std::size_t index) {
  step(fmt::format("{},{},{}", record.time_s, index, record.returns), index,
       static_cast<double>(index + 1), fmt::format("scan {}: {} returns", index, record.returns));
}

}  // namespace vantage
