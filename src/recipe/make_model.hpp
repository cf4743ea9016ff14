/// Makes a recognition model as its recipe says, from nothing.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "vantage/belief/objects/recognition_model.hpp"
#include "vantage/recipe/model_recipe.hpp"

namespace vantage {

struct ModelMaking {
  /// Recordings and features of views are kept there, each under the hash of what it was made with.
  std::filesystem::path cache;
  int jobs = 1;                          ///< objects rendered at a time, and threads of training
  std::vector<std::string> worker = {};  ///< as DatasetRun
  std::function<bool()> stop = [] { return false; };  ///< asked often while rendering
  std::function<void()> poll = [] {};                 ///< throws if `stop` does not return false
};

/// Renders what is missing of the recordings, then trains; shows progress over the whole and the
/// time left. A call that was ended is gone on with by another one. The model depends on the recipe
/// alone if it states the features' costs.
/// @throws as render_dataset and train_recognition, and what `how.poll` throws
RecognitionModel make_model(const ModelRecipe& recipe, const ModelMaking& how);

/// Where a recording of these options is kept.
std::filesystem::path recording_folder(const std::filesystem::path& cache,
                                       const DatasetOptions& options);

}  // namespace vantage
