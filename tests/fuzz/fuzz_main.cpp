// What libFuzzer calls, for all targets.
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>

#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/core/error.hpp"

namespace vantage::fuzz {

InputFolder::InputFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "fuzz-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) std::abort();
  path_ = name;
}

InputFolder::~InputFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path InputFolder::put(const std::string& name, std::string_view bytes) const {
  const std::filesystem::path file = path_ / name;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return file;
}

std::vector<std::string_view> parts_of(std::string_view bytes, std::size_t count) {
  std::vector<std::string_view> parts;
  while (parts.size() + 1 < count) {
    std::size_t size = 0;
    for (std::size_t i = 0; i < 4 && i < bytes.size(); ++i) {
      size |= static_cast<std::size_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
    }
    bytes.remove_prefix(std::min<std::size_t>(4, bytes.size()));
    parts.push_back(bytes.substr(0, size));
    bytes.remove_prefix(parts.back().size());
  }
  parts.push_back(bytes);
  return parts;
}

std::filesystem::path source_file(const std::string& name) {
  return std::filesystem::path(VANTAGE_SOURCE_DIR) / name;
}

}  // namespace vantage::fuzz

/// A broken promise ends our programs by _Exit, which libFuzzer would take for the end of its run.
extern "C" void _Exit(int code) noexcept {
  if (code == static_cast<int>(vantage::ExitCode::internal)) __builtin_trap();
  ::syscall(SYS_exit_group, code);
  __builtin_unreachable();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const vantage::fuzz::InputFolder folder;
  try {
    vantage::fuzz::read_input({reinterpret_cast<const char*>(data), size}, folder);
  } catch (const vantage::Error&) {  // an answer
  }
  return 0;
}
