/// What benchmarks of a decision share: the maps of an episode's decisions, and the sweep held
/// against the exact evaluator and a peer's.
#pragma once

#include <span>
#include <vector>

#include "vantage/planners/gain.hpp"
#include "vantage/tasks/episode.hpp"
#include "vantage/tasks/mapping/mapping_parts.hpp"

namespace vantage::bench {

inline constexpr int kThreads = 2;

/// What a decision looks at.
struct Situation {
  OccupancyGrid grid;
  BlockField transmission;
  std::vector<Candidate> views;
  FieldOfView field;

  [[nodiscard]] GainContext context() const { return {grid, &transmission}; }
};

/// To run in `directory`, in place of what is there; neither states nor voxels are kept.
RunRequest lean_request(const ResolvedEpisode& resolved, const std::filesystem::path& directory);

/// The parts of an episode that keep what every decision looks at.
template <class Parts>
class Watched : public Parts {
 public:
  Watched(const MappingContext& context, const auto& task, auto& robot, auto& belief)
      : Parts(context, task, robot, belief), belief_(belief), field_(robot.view_field()) {}

  void score(std::vector<Candidate>& candidates) {
    situations.push_back(
        {belief_.filled_grid(), belief_.hazard().transmission(), candidates, field_});
    Parts::score(candidates);
  }

  std::vector<Situation> situations;

 private:
  const MapBelief& belief_;
  FieldOfView field_;
};

/// How well the sweep agrees with exact rays, at worst.
struct Agreement {
  double spearman_min = 1.0;
  double regret_max = 0.0;  ///< share of the best view's exact gain that the chosen one lacks
  double sweep_ms_max = 0.0;

  void compare(const Gain& gain, const Situation& situation);
};

/// Medians of several.
struct Timings {
  double sweep_ms = 0.0;
  double exact_ms = 0.0;
};
/// Of all views of a decision, each after a run that is not timed.
Timings time_both(const Gain& gain, const Situation& situation);

/// castRay as peers use it, a ray for each of the sensor's `beams`. `timed_views` of the decision's
/// views, spread over them, are timed once each, kThreads at a time, after one that is not timed.
/// The decision takes their mean for each of its views, shared evenly by kThreads.
/// @param timed_views a multiple of kThreads
double castray_ms(const Situation& situation, std::span<const Eigen::Vector3d> beams,
                  std::size_t timed_views);

/// One line of JSON with the figures of the contract.
/// @param configuration YAML of the episodes that built the maps
void print_decision(const std::string& name, const std::string& configuration,
                    const Timings& timings, double castray_ms, const Agreement& agreement);

}  // namespace vantage::bench
