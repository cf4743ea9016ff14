/// The page of a whole study.
#pragma once

#include <filesystem>

#include "vantage/study/evaluation.hpp"

namespace vantage {

/// Whether a folder is a study's, as against a run's.
bool is_study_folder(const std::filesystem::path& directory);

/// Writes `report.html` into the study's folder: static, self-contained, without
/// script.
/// @throws OutputError
void write_study_page(const StudyResults& results, const Evaluation& evaluation);

}  // namespace vantage
