/// Which objects there may be.
#pragma once

#include <cstdint>
#include <string>

#include "vantage/core/fields.hpp"

namespace vantage {

/// The objects that may stand about, as `vantage dataset render` makes them.
struct ObjectDatabaseOptions {
  std::uint64_t seed = 1;  ///< of the generated objects
  int objects = 326;       ///< the first of the catalogue, or of `models`
  std::string models;      ///< folder of <name>/{model.obj, texture.png}; empty: the catalogue
  void fields(auto&& f) {
    f("seed", seed);
    f("objects", objects, between(1, 100000));
    f("models", models);
  }
};

}  // namespace vantage
