/// What `vantage run` says of an episode when it has ended.
#pragma once

#include "vantage/tasks/run.hpp"

namespace vantage {

/// A few lines on stdout, by task.
void print_outcome(const RunOutcome& outcome);

}  // namespace vantage
