// Whoever is given the evaluator of a map knows the truth by name alone.
// expected error: incomplete type
#include "vantage/tasks/mapping/ground_truth_map_evaluator.hpp"

double what_it_learns(const vantage::GroundTruthMapEvaluator& evaluator,
                      [[maybe_unused]] const vantage::MobileGroundTruth& truth) {
#ifdef USE_TRUTH
  return truth.collisions();
#else
  return static_cast<double>(evaluator.observable_cells());
#endif
}
