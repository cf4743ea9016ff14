/// The golden episodes: short, each aimed at one behaviour.
#pragma once

#include <opencv2/core.hpp>

#include <functional>
#include <ostream>
#include <string_view>
#include <vector>

#include "tests/support/trace.hpp"

namespace vantage {

struct GoldenResult {
  Trace trace;
  cv::Mat image;  ///< of the final map, to look at
};

struct GoldenEpisode {
  std::string_view name;
  std::function<GoldenResult()> run;
};
inline std::ostream& operator<<(std::ostream& out, const GoldenEpisode& e) { return out << e.name; }

std::vector<GoldenEpisode> golden_episodes();

}  // namespace vantage
