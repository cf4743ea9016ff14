/// A fuzz target is a reader: one function that is handed bytes of anybody's.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vantage::fuzz {

/// A folder, in memory if TMPDIR is, where inputs lie under the names that readers look for.
class InputFolder {
 public:
  InputFolder();
  InputFolder(const InputFolder&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;
  ~InputFolder();

  /// Writes the file, over what was there. @returns its path
  std::filesystem::path put(const std::string& name, std::string_view bytes) const;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// One of the files that a target is given at once: each is preceded by its length in four bytes,
/// little-endian; the last takes what is left.
std::vector<std::string_view> parts_of(std::string_view bytes, std::size_t count);

/// A file of the source tree.
std::filesystem::path source_file(const std::string& name);

/// Defined by each target. An Error of Vantage is an answer; whatever else it throws is a finding.
void read_input(std::string_view bytes, const InputFolder& folder);

}  // namespace vantage::fuzz
