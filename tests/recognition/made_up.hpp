/// Recognisers of made-up objects, and cameras that measure them as their models say.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/near_duplicate_families.hpp"
#include "vantage/recognition/recognition.hpp"

namespace vantage::test {

/// Features of these effective dimensions, of 10 times as many dimensions each.
inline Recogniser made_up_recogniser(int objects, const std::vector<double>& effective,
                                     const NearDuplicateSpread& spread, Rng& rng, int bins = 8) {
  const NearDuplicateFamilies families = near_duplicate_families(objects, bins);
  std::vector<FeaturePair> pairs;
  for (const double dimensions : effective) {
    ObservationModel model =
        near_duplicate_model(families, static_cast<int>(10 * dimensions), dimensions, spread, rng);
    model.feature += "_" + std::to_string(pairs.size());
    pairs.push_back({TrainedFeature(Colour{}, model.cost_s), std::move(model)});
  }
  return make_recogniser(families.states, std::move(pairs), 1);
}

/// Turned by whole bins about an object; its features are drawn from the models.
struct MadeUpCamera {
  const Recogniser& recogniser;
  int object = 0;
  int bin = 0;  ///< of the object as the camera sees it
  Rng& rng;
  double bearing_rad = 0.0;
  std::vector<int> seen = {};  ///< bins, in order

  ExtractedFeature extract(std::size_t feature) {
    const RecogniserFeature& f = recogniser.features[feature];
    const int state = recogniser.states.state(object, bin);
    return {.result = {Eigen::VectorXf::Zero(f.observation.dimensions()), {}},
            .time_s = f.observation.cost_s,
            .log_likelihood = measured_log_likelihoods(f.observation, state, rng)};
  }

  [[nodiscard]] std::vector<ObjectViewAction> actions() const {
    std::vector<ObjectViewAction> actions;
    const int bins = recogniser.states.bins;
    for (int turn = 1; turn < bins; ++turn) {
      const int there = ((bin - turn) % bins + bins) % bins;
      actions.push_back({.yaw_rad = turn * recogniser.states.bin_rad(),
                         .visited = std::ranges::find(seen, there) != seen.end()});
    }
    return actions;
  }

  void turn(const ObjectViewAction& action) {
    seen.push_back(bin);
    const int bins = recogniser.states.bins;
    const int by = static_cast<int>(std::lround(action.yaw_rad / recogniser.states.bin_rad()));
    bin = ((bin - by) % bins + bins) % bins;
    bearing_rad += action.yaw_rad;
  }
};

inline ObjectCamera object_camera(MadeUpCamera& camera) {
  return {.extract = [&](std::size_t feature) { return camera.extract(feature); },
          .bearing_rad = [&] { return camera.bearing_rad; },
          .actions = [&] { return camera.actions(); },
          .turn = [&](const ObjectViewAction& action) { camera.turn(action); }};
}

}  // namespace vantage::test
