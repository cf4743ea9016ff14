/// What `adaptive` is worth beside `simple`, wherever both map.
#pragma once

#include <vector>

#include "bench/claims/claims.hpp"

namespace vantage::bench {

/// The study's reference is one of the two. @param tables less is better in each
Finding adaptive_against_simple(const StudyTables& study, const std::vector<const char*>& tables);

}  // namespace vantage::bench
