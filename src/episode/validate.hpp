/// `vantage validate`: everything wrong with a file, nothing run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vantage {

/// Whether problems of this file are configuration (exit code 2) rather than bad input (3).
bool is_configuration(const std::filesystem::path& file);

/// One line per problem, each naming the file; empty: the file is good.
std::vector<std::string> validate_file(const std::filesystem::path& file);

}  // namespace vantage
