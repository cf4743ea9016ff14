// A whole decision of `tour`: candidates, what they show, the ways between them, the tour; in a
// large and a small office and at a table, along episodes.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "bench/measures.hpp"
#include "bench/situation.hpp"
#include "vantage/planners/choice/partial_scans.hpp"
#include "vantage/planners/swept_blocks.hpp"
#include "vantage/planners/swept_gain.hpp"
#include "vantage/planners/travel/path_lengths.hpp"
#include "vantage/planners/views/forecast_calibration.hpp"
#include "vantage/tasks/exploration/exploration_session.hpp"
#include "vantage/tasks/mapping/view_planner.hpp"
#include "vantage/tasks/tabletop/tabletop_session.hpp"

namespace vantage::bench {
namespace {
namespace fs = std::filesystem;

double median(std::vector<double> values) {
  expects(!values.empty(), "a decision was timed");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// The parts of an episode that, after each decision, time some of its work again.
template <class Parts>
class Timed : public Parts {
 public:
  Timed(const MappingContext& context, const auto& task, auto& robot, auto& belief)
      : Parts(context, task, robot, belief),
        options_(task),
        belief_(belief),
        threads_(context.options.threads) {}

  std::size_t choose(std::vector<Candidate>& candidates) {
    const auto intended_m = this->intended_m_;  // the choice sets the next
    const std::size_t chosen = Parts::choose(candidates);
    if (this->scans_.size() > 1) time_parts(candidates, intended_m);
    return chosen;
  }

  struct Parts_ms {
    std::vector<double> sweep, travel, tour, views;
  };
  Parts_ms parts_ms;

 private:
  /// Of the problem that the choice had.
  void time_parts(const std::vector<Candidate>& candidates,
                  const std::optional<Eigen::Vector2d>& intended_m) {
    const BlockField transmission =
        ForecastCalibration(options_.forecast)
            .transmission(belief_.hazard().transmission(), this->scans_.back().hazard_scale);
    const auto planned = this->navigator_.plan();
    const PathField& paths = *planned;
    const int scans_left = options_.scans - static_cast<int>(this->scans_.size());
    const PlanningProblem problem =
        planning_problem(options_, options_.gain, candidates,
                         {.belief = belief_,
                          .transmission = transmission,
                          .robot = this->robot_,
                          .paths = paths,
                          .budget = this->budget_,
                          .threads = threads_,
                          .scans_left = static_cast<std::size_t>(std::max(1, scans_left)),
                          .intended_m = intended_m});
    parts_ms.sweep.push_back(median_ms(1, [&] { sweep(candidates, transmission); }));
    parts_ms.travel.push_back(
        median_ms(1, [&] { path_lengths_m(paths, problem.place_m, threads_); }));
    Rng rng(1);
    parts_ms.tour.push_back(median_ms(1, [&] { plan_views(options_.choice, problem, rng); }));
    parts_ms.views.push_back(static_cast<double>(problem.views()));
  }

  /// What the views of the problem show.
  void sweep(const std::vector<Candidate>& candidates, const BlockField& transmission) const {
    std::vector<Candidate> views;
    for (const std::size_t i : open_candidates(candidates)) views.push_back(candidates[i]);
    const GainContext map{belief_.filled_grid(), &transmission};
    swept_blocks(attenuation_of(options_.gain, map), map.grid, views, this->robot_.view_field(),
                 blocks_of(map.grid.frame, options_.planning.block_m), threads_);
  }

  const MappingOptions options_;
  const MapBelief& belief_;
  int threads_;
};

template <class Session>
void print_planning(const std::string& name, const std::string& configuration, Session& session) {
  run_episode(session.parts);
  std::vector<double> decision_ms;
  for (std::size_t i = 2; i < session.parts.scans().size(); ++i) {
    decision_ms.push_back(1e3 * session.parts.scans()[i].plan_time_s);
  }
  const auto& parts = session.parts.parts_ms;
  const double all = median(decision_ms);
  print_figures(name, kThreads, configuration,
                {{"decision_ms", all},
                 {"decision_ms_max", *std::ranges::max_element(decision_ms)},
                 {"sweep_share", median(parts.sweep) / all},
                 {"travel_share", median(parts.travel) / all},
                 {"tour_share", median(parts.tour) / all},
                 {"views", median(parts.views)}});
}

/// `tour` as the studies have it: partial scans, and images on the way.
const std::vector<std::string> kTour{"choice=tour", "gaze.worth=0.25", "gaze.share=0.0001",
                                     "gaze.on_the_way_m=0.5"};

std::vector<std::string> tour_of(const std::string& more) {
  std::vector<std::string> overrides = kTour;
  overrides.push_back(more);
  return overrides;
}

void run_benchmark() {
  const fs::path directory = fs::temp_directory_path() / "vantage_bench_planning";
  fs::create_directories(directory);
  {
    const auto resolved =
        load_episode("assets/episodes/tabletop_clutter.yaml", {"choice=tour", "scans=30"});
    const RunRequest request = lean_request(resolved, directory);
    TabletopSession<Timed<TabletopParts>> session(request, std::get<Tabletop>(resolved.task));
    print_planning("planning_tabletop", request.config, session);
  }
  for (const char* office : {"office_small", "office_large"}) {
    const auto resolved =
        load_episode(fmt::format("assets/episodes/{}.yaml", office), tour_of("scans=300"));
    const RunRequest request = lean_request(resolved, directory);
    ExplorationSession<Timed<ExplorationParts>> session(request,
                                                        std::get<Exploration>(resolved.task));
    print_planning(fmt::format("planning_{}", office), request.config, session);
  }
  fs::remove_all(directory);
}

}  // namespace
}  // namespace vantage::bench

int main() { return vantage::bench::run_main(vantage::bench::run_benchmark); }
