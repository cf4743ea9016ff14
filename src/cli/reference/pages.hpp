/// The reference as pages of the documentation.
#pragma once

#include <filesystem>

namespace vantage {

/// Writes keys.md, strategies.md and files.md. @throws OutputError
void write_reference_pages(const std::filesystem::path& directory);

}  // namespace vantage
