/// What `vantage list features` says.
#pragma once

#include <string>
#include <vector>

namespace vantage {

/// A line a feature: its name, the dimension of its vectors, and the time that one view takes as
/// `bench/run features` has measured it, where its results are at hand.
std::vector<std::string> feature_lines();

}  // namespace vantage
