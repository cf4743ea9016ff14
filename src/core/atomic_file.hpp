/// Files that are either whole or not there: written beside their name, renamed when complete.
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>

namespace vantage {

/// @throws InputError if the file does not exist or cannot be read.
std::string read_file(const std::filesystem::path& path);

/// @throws OutputError if the directory or the disk refuses; nothing is left under `path` then.
void write_file(const std::filesystem::path& path, std::string_view content);

/// Where a file is written until it is whole: beside `path`, same extension.
std::filesystem::path part_name(const std::filesystem::path& path);

/// Calls `write` with a temporary name beside `path` (same extension, so that writers which pick a
/// format by it work), checks that a non-empty file came out, and renames it to `path`. For
/// libraries that write files themselves; `write` returns false on failure.
/// @throws OutputError and removes the temporary file if anything failed.
void write_file_with(const std::filesystem::path& path,
                     const std::function<bool(const std::filesystem::path&)>& write);

/// The system's folder for what is thrown away soon, TMPDIR. @throws OutputError if there is none.
std::filesystem::path temporary_place();

/// @throws OutputError naming the directory if it cannot be made or written into.
void make_writable_directory(const std::filesystem::path& directory);

/// The rule of all commands that write: a result that is there is not replaced unasked.
/// @param place "--out out/run" @param holds what is there, "holds metrics.json already"
/// @throws ConfigError "--out out/run: holds metrics.json already; --overwrite replaces it"
[[noreturn]] void refuse_to_replace(std::string_view place, std::string_view holds);
/// The same if `result` is there and `overwrite` is not set. @param option that names it
void require_absent(const std::filesystem::path& result, bool overwrite,
                    std::string_view option = "--out");

/// A file that grows during a run; visible under `path` only after commit(). Destroyed without
/// commit (an error on the way), it removes what it wrote.
class GrowingFile {
 public:
  explicit GrowingFile(std::filesystem::path path);
  GrowingFile(GrowingFile&&) = default;
  GrowingFile& operator=(GrowingFile&&) = delete;
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;
  ~GrowingFile();

  void write(std::string_view bytes);  ///< @throws OutputError
  void commit();                       ///< @throws OutputError

 private:
  [[nodiscard]] std::filesystem::path part() const;
  std::filesystem::path path_;
  std::ofstream stream_;
};

}  // namespace vantage
