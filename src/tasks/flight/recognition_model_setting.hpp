/// Which model the task of an episode that flies recognises with.
#pragma once

#include "vantage/tasks/scenario.hpp"

namespace vantage {

/// The key that names the model's file.
inline const char* recognition_model_key(const Episode& episode) {
  return episode.flies_trajectory() ? "trajectory.model" : "recognition.model";
}

/// What that key says; of an Episode, or of a const one.
auto& recognition_model_of(auto& episode) {
  return episode.flies_trajectory() ? episode.trajectory.model : episode.recognition.model;
}

}  // namespace vantage
