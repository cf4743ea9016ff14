/// What `--set` reaches of `vantage recognise`.
#pragma once

#include <cstdint>

#include "vantage/core/fields.hpp"
#include "vantage/recognition/recognition.hpp"

namespace vantage {

struct RecogniseOptions {
  std::uint64_t seed = 1;
  RecogniserOptions recogniser;
  /// The views are there: nothing is won by leaving out what they show.
  RecognitionOptions recognition{.features = {}, .all_features = true, .views = {}, .enough = {}};
  void fields(auto&& f) {
    f("seed", seed, "seed of the measures of information that sample");
    f("recogniser", recogniser,
      "which features of the model are used, and how its variances are estimated");
    f("recognition", recognition,
      "how features and views are chosen, and when the object is known well enough");
  }
  void check() const { require_no_weights(recognition.views, "recognition.views"); }
};

}  // namespace vantage
