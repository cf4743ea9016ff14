/// Claims of table tops and offices alike.
#pragma once

#include <string>
#include <vector>

#include "bench/claims/claims.hpp"

namespace vantage::bench {

/// What `adaptive` is worth beside `simple`: the study's reference is one of the two. @param tables
/// less is better in each
Finding adaptive_against_simple(const StudyTables& study, const std::vector<const char*>& tables);
/// Of all levels of a study of explorations or of table tops.
Finding intervals_cover(const StudyTables& study);
/// Of every episode of every level. @throws NotRun if one is missing
std::vector<double> all_values(const StudyTables& study, const std::string& table);
/// Poses within 50 mm and precision of 0.98, in every episode.
Finding maps_are_right(const StudyTables& study);
/// @param compared what the study compares, "method"
Finding without_collision(const StudyTables& study, const char* compared);

}  // namespace vantage::bench
