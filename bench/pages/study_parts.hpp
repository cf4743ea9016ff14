/// The studies that bench/RESULTS.md tells of, in its order.
#pragma once

#include <string>
#include <vector>

#include "bench/claims/claims.hpp"

namespace vantage::bench {

struct StudyPart {
  std::string name;
  const char* title;
  std::vector<std::string> tables;
  std::vector<Finding> (*findings)(const StudyTables&);
  bool is_bounded = false;  ///< some of its runs are held against what any policy needs
};

const std::vector<StudyPart>& study_parts();

}  // namespace vantage::bench
