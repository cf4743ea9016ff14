/// Folders that commands take: what is said of one that is not theirs.
#pragma once

#include <filesystem>

namespace vantage {

/// @throws InputError saying what the folder is, or lacks, unless it is that of a run
void require_run_folder(const std::filesystem::path& folder);
/// @throws InputError saying what the folder is, or lacks, unless it is that of a study
void require_study_folder(const std::filesystem::path& folder);
/// @throws InputError unless it is that of a run or of a study
void require_result_folder(const std::filesystem::path& folder);

}  // namespace vantage
