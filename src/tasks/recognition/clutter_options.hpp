/// What else stands on the table.
#pragma once

#include "vantage/core/fields.hpp"

namespace vantage {

struct ClutterOptions {
  int objects = 0;
  int near_duplicates = 3;
  int tall = 0;
  double tall_m = 0.18;
  int posts = 0;
  int screens = 0;
  double screen_m = 0.3;
  double spacing_m = 0.05;
  double reach_m = 0.3;
  void fields(auto&& f) {
    f("objects", objects,
      "number of objects of the database that stand round the targets; more hide more; 0: none",
      between(0, 40));
    f("near_duplicates", near_duplicates,
      "how many of them are near-duplicates of a target, as far as its family and category go; "
      "more are easier to mistake for it",
      between(0, 40));
    f("tall", tall, "how many of the others are at least `tall_m` high; more hide more",
      between(0, 40));
    f("tall_m", tall_m, "height from which an object counts as tall", between(0.0, 1.0));
    f("posts", posts,
      "number of thin posts besides, nearly as high as `map.height_m` allows, in the way of views "
      "and flights",
      between(0, 10));
    f("screens", screens,
      "how many of the targets stand in a screen of their own, three walls that are open to one "
      "side; more are hidden from most sides",
      between(0, 10));
    f("screen_m", screen_m, "height of the screens; higher hides more from views from above",
      between(0.05, 1.0));
    f("spacing_m", spacing_m,
      "least gap between two things on the table; lower stands closer and hides more",
      between(0.01, 0.5));
    f("reach_m", reach_m,
      "how far round the targets they stand, farther where there is no room; lower stands closer",
      between(0.05, 2.0));
  }
  [[nodiscard]] bool any() const { return objects > 0 || posts > 0 || screens > 0; }
};

}  // namespace vantage
