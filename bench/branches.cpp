// How long it takes to see what every view of a decision would have brought.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "bench/measures.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/log.hpp"
#include "vantage/hindsight/branching.hpp"
#include "vantage/tasks/run.hpp"

namespace vantage::bench {
namespace {
namespace fs = std::filesystem;

constexpr std::size_t kScan = 3;  ///< the decision after it

/// In a process of its own: threads that it leaves behind would keep this one from being forked.
void record(const ResolvedEpisode& resolved, const fs::path& directory) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::_exit(run_main([&] {
      RunOptions options;
      options.directory = directory;
      options.overwrite = true;
      run(resolved, options);
    }));
  }
  int status = 0;
  const bool ended = ::waitpid(child, &status, 0) == child && WIFEXITED(status);
  if (!ended || WEXITSTATUS(status) != 0) throw EpisodeFailed("the run to branch was not recorded");
}

void run_benchmark() {
  const fs::path directory = fs::temp_directory_path() / fmt::format("vantage_bench_{}", getpid());
  const auto resolved =
      load_episode("assets/episodes/tabletop.yaml", {fmt::format("scans={}", kScan + 1)});
  record(resolved, directory);
  draw_without_threads();
  const RecordedRun recorded = read_recorded_run(directory);
  const double start_s = wall_s();
  const auto decisions = branch_views(recorded, {.scans = {kScan}, .all = true});
  const double all_s = wall_s() - start_s;
  fs::remove_all(directory);
  const std::vector<Branch>& branches = decisions.front().branches;
  expects(std::ranges::count_if(branches, &Branch::chosen) == 1, "one of them was chosen");
  print_figures("branches", 2, episode_yaml(resolved),
                {{"all_views_s", all_s}, {"views", static_cast<double>(branches.size())}});
}

}  // namespace
}  // namespace vantage::bench

int main() { return vantage::bench::run_main(vantage::bench::run_benchmark); }
