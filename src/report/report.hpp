/// The page of one run: everything a reader wants to see of it, in one file.
#pragma once

#include <cstddef>
#include <filesystem>

#include "vantage/report/report_sections.hpp"

namespace vantage {

/// The 3-D view holds at most this many voxels, and half as many laser points.
inline constexpr std::size_t kMaxReportVoxels = 100'000;

/// Reads the run folder and writes `report.html` into it: static, self-contained, opens from the
/// file system. Only `video.mp4` stays outside, referenced by name if it is there; else the last
/// image of `frames/` is shown. `cloud.ply` is optional, `voxels.bin` is so without a map.
/// @throws InputError naming the file that is missing or malformed, OutputError.
void write_report(const std::filesystem::path& run_dir, const ReportSections& sections);

}  // namespace vantage
