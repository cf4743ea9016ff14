/// What an outside choice is asked, as Python sees it.
#pragma once

#include <memory>

#include "vantage/planners/choice/outside_choice.hpp"

namespace vantage::python {

/// A situation or a request lasts as long as the episode waits; after that its holder is empty, and
/// asking it is an error in Python.
template <class T>
struct Lent {
  const T* value = nullptr;
};
using LentRequest = Lent<DecisionRequest>;
using LentSituation = Lent<MapSituation>;

}  // namespace vantage::python
