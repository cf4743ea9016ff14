#include "vantage/dataset/pictures/replace_folder.hpp"

#include <fmt/format.h>

#include <string>

#include "vantage/core/error.hpp"

namespace vantage {
namespace fs = std::filesystem;

void replace_folder(const fs::path& part, const fs::path& folder) {
  const fs::path before = folder.parent_path() / ("." + folder.filename().string() + ".before");
  std::error_code error, ignored;
  fs::remove_all(before, ignored);
  const bool replaces = fs::exists(folder, ignored);
  if (replaces) fs::rename(folder, before, error);
  if (!error) {
    fs::rename(part, folder, error);
    if (error && replaces) fs::rename(before, folder, ignored);
  }
  if (error) {
    throw OutputError(fmt::format("{}: cannot write: {}", folder.string(), error.message()));
  }
  fs::remove_all(before, ignored);
}

}  // namespace vantage
