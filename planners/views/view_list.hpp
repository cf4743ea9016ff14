/// Views as a table in a file.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "vantage/planners/candidate.hpp"

namespace vantage {

/// Reads sensor poses from CSV. The header names the columns, in any order: x_m, y_m, z_m, yaw_rad
/// (world frame; left positive), and if wanted pitch_rad (positive looks down; else 0) and id
/// (whole number >= 0, each once; else counted from 0).
/// @throws InputError naming file, line and column if the file cannot be read, a value is missing,
/// no finite number or out of range, or there is no view or more than 20 000.
std::vector<Candidate> read_views(const std::filesystem::path& path);

/// The same table, all columns; what read_views() reads back.
std::string views_csv(std::span<const Candidate> views);

/// Heading of the view and how far it looks down.
double yaw_of(const Candidate& view);
double pitch_of(const Candidate& view);

}  // namespace vantage
