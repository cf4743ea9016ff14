#include "vantage/tasks/wait/wait_recorder.hpp"

#include <fmt/format.h>

#include <utility>

namespace vantage {

WaitRecorder::WaitRecorder(const EpisodeRun& run, RecordedRobot robot, int scans)
    : EpisodeRecorder(run, std::move(robot), "time_s,scan,returns", scans) {}

void WaitRecorder::scan(const WaitRecord& record, std::size_t number) {
  step(fmt::format("{},{},{}", record.time_s, number, record.returns), number,
       static_cast<double>(number), fmt::format("scan {}: {} returns", number, record.returns));
}

}  // namespace vantage
