#include "vantage/core/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "vantage/core/error.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

std::string reason() { return errno != 0 ? std::strerror(errno) : "write failed"; }

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw OutputError(fmt::format("{}: cannot write: {}", path.string(), why));
}

/// Libraries that swallow write errors are caught here: on a full disk the flush to the device
/// fails.
void flush_to_disk(const fs::path& written, const fs::path& path) {
  const int descriptor = ::open(written.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail(path, reason());
  const int result = ::fsync(descriptor);
  const std::string why = reason();
  ::close(descriptor);
  if (result != 0) fail(path, why);
}

void publish(const fs::path& written, const fs::path& path) {
  std::error_code error;
  fs::rename(written, path, error);
  if (error) {
    const std::string why = error.message();
    fs::remove(written, error);
    fail(path, why);
  }
}

}  // namespace

fs::path part_name(const fs::path& path) {
  return path.parent_path() / (path.stem().string() + ".part" + path.extension().string());
}

std::string read_file(const fs::path& path) {
  errno = 0;
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    throw InputError(path.string() + ": is a directory, expected a file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(fmt::format("{}: cannot read: {}", path.string(), reason()));
  std::string content;
  constexpr std::size_t kBlock = 1 << 16;
  while (stream) {
    const std::size_t before = content.size();
    content.resize(before + kBlock);
    stream.read(content.data() + before, kBlock);
    content.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) throw InputError(fmt::format("{}: cannot read: {}", path.string(), reason()));
  return content;
}

void write_file(const fs::path& path, std::string_view content) {
  GrowingFile file(path);
  file.write(content);
  file.commit();
}

void write_file_with(const fs::path& path, const std::function<bool(const fs::path&)>& write) {
  const fs::path part = part_name(path);
  std::error_code ignored;
  errno = 0;
  try {
    if (!write(part)) fail(path, reason());
    if (!fs::exists(part) || fs::file_size(part) == 0) fail(path, "nothing was written");
    flush_to_disk(part, path);
  } catch (...) {
    fs::remove(part, ignored);
    throw;
  }
  publish(part, path);
}

fs::path temporary_place() {
  std::error_code error;
  fs::path place = fs::temp_directory_path(error);
  if (!error) return place;
  const char* wanted = std::getenv("TMPDIR");
  throw OutputError(
      fmt::format("TMPDIR: {}: {}", wanted != nullptr ? wanted : "/tmp", error.message()));
}

void make_writable_directory(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) {
    throw OutputError(
        fmt::format("{}: cannot make directory: {}", directory.string(), error.message()));
  }
  const fs::path probe = directory / ".probe.part";
  errno = 0;
  std::ofstream stream(probe);
  stream << "x" << std::flush;
  const bool good = stream.good();
  const std::string why = reason();
  stream.close();
  fs::remove(probe, error);
  if (!good)
    throw OutputError(fmt::format("{}: cannot write into directory: {}", directory.string(), why));
}

void refuse_to_replace(std::string_view place, std::string_view holds) {
  throw ConfigError(fmt::format("{}: {}; --overwrite replaces it", place, holds));
}

void require_absent(const fs::path& result, bool overwrite, std::string_view option) {
  std::error_code ignored;
  if (overwrite || !fs::exists(result, ignored)) return;
  refuse_to_replace(fmt::format("{} {}", option, result.string()), "is there already");
}

GrowingFile::GrowingFile(fs::path path) : path_(std::move(path)) {
  errno = 0;
  stream_.open(part(), std::ios::binary | std::ios::trunc);
  if (!stream_) fail(path_, reason());
}

GrowingFile::~GrowingFile() {
  if (!stream_.is_open()) return;
  stream_.close();
  std::error_code ignored;
  fs::remove(part(), ignored);
}

fs::path GrowingFile::part() const { return part_name(path_); }

void GrowingFile::write(std::string_view bytes) {
  errno = 0;
  stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream_) fail(path_, reason());
}

void GrowingFile::commit() {
  errno = 0;
  stream_.flush();
  if (!stream_) fail(path_, reason());
  flush_to_disk(part(), path_);
  stream_.close();
  publish(part(), path_);
}

}  // namespace vantage
