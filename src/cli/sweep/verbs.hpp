/// `vantage sweep run|plan|status|collect`: a study on this machine.
#pragma once

#include "vantage/cli/sweep/arguments.hpp"
#include "vantage/core/error.hpp"

namespace vantage {

/// Ends with what `sweep collect` does.
ExitCode run_study(const SweepArguments& arguments);
/// What has no result yet, and so would run now.
ExitCode print_study_plan(const SweepArguments& arguments);
ExitCode print_study_status(const SweepArguments& arguments);
/// What there is, even if something is missing; says then what, and ends in 1.
ExitCode collect_study(const SweepArguments& arguments);

}  // namespace vantage
