/// The reference as pages of the documentation.
#pragma once

#include <filesystem>
#include <vector>

#include "vantage/cli/reference/entry.hpp"

namespace vantage {

/// Writes keys.md, strategies.md and files.md. `keys`: those of commands too. @throws OutputError
void write_reference_pages(const std::vector<ReferenceEntry>& keys,
                           const std::filesystem::path& directory);

}  // namespace vantage
