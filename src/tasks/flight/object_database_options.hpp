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
    f("seed", seed, "of the generated objects");
    f("objects", objects, "the first of the catalogue, or of `models`", between(1, 100000));
    f("models", models, "folder of <name>/{model.obj, texture.png}; empty: the catalogue");
  }
};

}  // namespace vantage
