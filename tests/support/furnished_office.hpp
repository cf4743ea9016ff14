/// The small office with as many things in it as one likes.
#pragma once

#include <string>

namespace vantage::support {

enum class BoxBodies { one, each };

/// MJCF of models/scenes/office_small_1 with `boxes` small boxes on its walls, between the heights
/// of knees and heads: all of one body, or each of its own. The same every time.
std::string furnished_office(int boxes, BoxBodies bodies = BoxBodies::one);

}  // namespace vantage::support
