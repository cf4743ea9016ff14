#include "vantage/core/hash.hpp"

#include <fmt/format.h>

#include "vantage/core/atomic_file.hpp"

namespace vantage {

std::uint64_t hash_bytes(std::string_view bytes, std::uint64_t seed) {
  std::uint64_t hash = seed;
  for (const char byte : bytes) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 0x100000001b3ULL;
  }
  return hash;
}

std::uint64_t hash_doubles(std::span<const double> values, std::uint64_t seed) {
  return hash_bytes({reinterpret_cast<const char*>(values.data()), values.size_bytes()}, seed);
}

std::uint64_t hash_file(const std::filesystem::path& path) { return hash_bytes(read_file(path)); }

std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

}  // namespace vantage
