/// Which objects there may be.
#pragma once

#include <cstdint>
#include <string>

#include "vantage/core/fields.hpp"

namespace vantage {

/// The objects that may stand about, as `vantage dataset render` makes them.
struct ObjectDatabaseOptions {
  std::uint64_t seed = 1;
  int objects = 326;
  std::string models;
  void fields(auto&& f) {
    f("seed", seed,
      "seed of the generated objects: that of the dataset that the model was trained on");
    f("objects", objects, "number of objects, the first ones of the catalogue or of `models`",
      between(1, 100000));
    f("models", models,
      "folder of objects `<name>/{model.obj, texture.png}` to use instead of the catalogue; empty: "
      "the catalogue");
  }
};

}  // namespace vantage
