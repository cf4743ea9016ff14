/// A study whose results are written by hand.
#pragma once

#include <filesystem>
#include <string>

#include "vantage/core/atomic_file.hpp"
#include "vantage/study/evaluation.hpp"
#include "vantage/study/study.hpp"

namespace vantage::support {

/// Of two scenes, with a budget of 100 s; nothing of it is run.
/// @param planners, seeds as in the file of a study
inline StudyResults hand_made_results(const std::filesystem::path& folder,
                                      const std::string& planners, const std::string& seeds) {
  write_file(folder / "study.yaml", R"(title: Hand-made
episode: assets/episodes/tabletop.yaml
set: {budget.time_s: 100}
factors:
  scene:
    a: {scene: models/scenes/tabletop_4/scene.xml}
    b: {scene: models/scenes/tabletop_8/scene.xml}
  planner:
)" + planners + "seeds: " + seeds +
                                        R"(
report: {compare: planner, reference: greedy, panels: scene, cluster: scene}
)");
  StudyResults results;
  results.study = read_study(folder / "study.yaml");
  results.directory = folder;
  results.plan = plan_study(results.study);
  results.states.assign(results.plan.size(), EpisodeState::missing);
  results.measures.resize(results.plan.size());
  return results;
}

}  // namespace vantage::support
