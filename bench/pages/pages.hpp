/// The pages behind RESULTS.md: tables and figures of each benchmark and study.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/claims/claims.hpp"
#include "bench/pages/origins.hpp"

namespace vantage::bench {

/// Each writes a page of that folder, with its pictures, and gives its path from there.

/// Every figure of every benchmark, with the code and machine that it is of.
std::string write_speed_page(const std::filesystem::path& directory, const Figures& figures,
                             const Origins& origins);
/// A table a measure, and the study's own figures.
std::string write_study_page(const std::filesystem::path& directory, const std::string& name,
                             const std::string& title, const StudyTables& study,
                             const std::vector<std::string>& tables);
/// What a flight costs, term by term.
std::string write_cost_page(const std::filesystem::path& directory);
/// What `vantage evaluate` wrote.
std::string write_recognition_page(const std::filesystem::path& directory);

}  // namespace vantage::bench
