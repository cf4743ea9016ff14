/// `vantage sweep submit|work|cancel`: a study on many machines that share its folder.
#pragma once

#include "vantage/cli/sweep/arguments.hpp"
#include "vantage/core/error.hpp"

namespace vantage {

/// An array of `sweep work` on Slurm, and a job that collects.
ExitCode submit_study(const SweepArguments& arguments);
/// Claims and runs episodes until none is left that nobody is at; exit 1 if one of those it ran is
/// not completed.
ExitCode work_on_study(const SweepArguments& arguments);
/// Ends what was submitted from a folder.
ExitCode cancel_study(const SweepArguments& arguments);

}  // namespace vantage
