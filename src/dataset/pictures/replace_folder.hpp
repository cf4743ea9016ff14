/// A folder in the place of another one.
#pragma once

#include <filesystem>

namespace vantage {

/// Renames `part` to `folder`, beside it; what is there is removed when that is done.
/// @throws OutputError if it cannot be renamed; `folder` is then as it was.
void replace_folder(const std::filesystem::path& part, const std::filesystem::path& folder);

}  // namespace vantage
