/// A recogniser that knows two objects and has learnt nothing of them.
#pragma once

#include "vantage/recognition/recogniser.hpp"

namespace vantage::support {

inline Recogniser recogniser_of_two() {
  Recogniser recogniser;
  recogniser.states = {.objects = {"mug_1", "bowl_2"},
                       .categories = {"mug", "bowl"},
                       .category_of = {0, 1},
                       .bins = 4};
  return recogniser;
}

}  // namespace vantage::support
