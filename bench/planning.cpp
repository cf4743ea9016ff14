// A whole decision of `tour`: candidates, what they show, the ways between them, the tour; in a
// large and a small office and at a table, along episodes.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "bench/measures.hpp"
#include "bench/situation.hpp"
#include "vantage/planners/navigation/path_lengths.hpp"
#include "vantage/tasks/exploration/exploration_session.hpp"
#include "vantage/tasks/mapping/view_planner.hpp"
#include "vantage/tasks/tabletop/tabletop_session.hpp"

namespace vantage::bench {
namespace {
namespace fs = std::filesystem;

double ms_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

double median(std::vector<double> values) {
  expects(!values.empty(), "a decision was timed");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// The parts of an episode that time their decisions, and again the work that is in each.
template <class Parts>
class Timed : public Parts {
 public:
  Timed(const MappingContext& context, const auto& task, auto& robot, auto& belief)
      : Parts(context, task, robot, belief),
        options_(task),
        belief_(belief),
        threads_(context.options.threads) {}

  std::size_t choose(std::vector<Candidate>& candidates) {
    const std::size_t chosen = Parts::choose(candidates);
    if (this->scans_.size() > 1) time_parts(candidates);
    return chosen;
  }

  struct Parts_ms {
    std::vector<double> problem, travel, tour, views;
  };
  Parts_ms parts_ms;

 private:
  void time_parts(const std::vector<Candidate>& candidates) {
    const BlockField transmission = belief_.hazard().transmission();
    const auto planned = this->navigator_.plan();
    const PathField& paths = *planned;
    auto start = std::chrono::steady_clock::now();
    const PlanningProblem problem = planning_problem(options_, options_.gain, candidates,
                                                     {.belief = belief_,
                                                      .transmission = transmission,
                                                      .robot = this->robot_,
                                                      .paths = paths,
                                                      .budget = this->budget_,
                                                      .threads = threads_});
    parts_ms.problem.push_back(ms_since(start));
    start = std::chrono::steady_clock::now();
    path_lengths_m(paths, problem.place_m, threads_);
    parts_ms.travel.push_back(ms_since(start));
    Rng rng(1);
    start = std::chrono::steady_clock::now();
    plan_views(options_.choice, problem, rng);
    parts_ms.tour.push_back(ms_since(start));
    parts_ms.views.push_back(static_cast<double>(problem.views()));
  }

  const MappingOptions options_;
  const MapBelief& belief_;
  int threads_;
};

template <class Session>
void print_planning(const std::string& name, Session& session) {
  run_episode(session.parts);
  std::vector<double> decision_ms;
  for (std::size_t i = 2; i < session.parts.scans().size(); ++i) {
    decision_ms.push_back(1e3 * session.parts.scans()[i].plan_time_s);
  }
  const auto& parts = session.parts.parts_ms;
  const double problem = median(parts.problem);
  const double travel = median(parts.travel);
  const double tour = median(parts.tour);
  const double all = median(decision_ms);
  print_figures(name, kThreads,
                {{"decision_ms", all},
                 {"decision_ms_max", *std::ranges::max_element(decision_ms)},
                 {"sweep_share", (problem - travel) / all},
                 {"travel_share", travel / all},
                 {"tour_share", tour / all},
                 {"views", median(parts.views)}});
}

void run_benchmark() {
  const fs::path directory = fs::temp_directory_path() / "vantage_bench_planning";
  fs::create_directories(directory);
  {
    const auto resolved = load_episode("assets/episodes/tabletop.yaml", {"choice=tour"});
    const RunRequest request = lean_request(resolved, directory);
    TabletopSession<Timed<TabletopParts>> session(request, std::get<Tabletop>(resolved.task));
    print_planning("planning_tabletop", session);
  }
  for (const char* office : {"office_small", "office_large"}) {
    const auto resolved =
        load_episode(fmt::format("assets/episodes/{}.yaml", office), {"choice=tour", "scans=30"});
    const RunRequest request = lean_request(resolved, directory);
    ExplorationSession<Timed<ExplorationParts>> session(request,
                                                        std::get<Exploration>(resolved.task));
    print_planning(fmt::format("planning_{}", office), session);
  }
  fs::remove_all(directory);
}

}  // namespace
}  // namespace vantage::bench

int main() { return vantage::bench::run_main(vantage::bench::run_benchmark); }
