/// What a recognition model is made of: recordings of objects, and how it is trained on them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vantage/dataset/dataset_options.hpp"
#include "vantage/recognition/training.hpp"

namespace vantage {

struct ModelRecipe {
  DatasetOptions render = {};
  std::vector<DatasetOptions> recordings = {};
  TrainingOptions train = {};
  void fields(auto&& f) {
    f("render", render, "what recordings have in common, keys of `vantage dataset render`");
    f("recordings", recordings, "recordings of the objects: where each differs from `render`");
    f("train", train, "how the model is trained on all of them, keys of `vantage train`");
  }
  void check() const;  ///< some recordings, no two alike, with every video that is trained on
};

/// @param overrides "key=value" as --set has them, "render.objects=12"
/// @throws InputError, ConfigError with file, line, key and value. Folders of objects are looked
/// for from the recipe's folder, as find_input() does.
ModelRecipe read_model_recipe(const std::filesystem::path& file,
                              const std::vector<std::string>& overrides = {});

}  // namespace vantage
