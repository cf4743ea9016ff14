/// FNV-1a, 64 bit: names random streams and tells whether two runs are the same. Not cryptographic.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace vantage {

inline constexpr std::uint64_t kHashSeed = 0xcbf29ce484222325ULL;

std::uint64_t hash_bytes(std::string_view bytes, std::uint64_t seed = kHashSeed);
std::uint64_t hash_doubles(std::span<const double> values, std::uint64_t seed = kHashSeed);
/// @throws InputError if the file cannot be read.
std::uint64_t hash_file(const std::filesystem::path& path);
std::string hash_text(std::uint64_t hash);  ///< 16 hexadecimal digits

}  // namespace vantage
