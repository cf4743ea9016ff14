/// Binary records: numbers in the machine's byte order, texts after their length, and a reader that
/// trusts nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "vantage/core/error.hpp"

namespace vantage {

template <class T>
void put(std::string& bytes, T value) {
  static_assert(std::is_arithmetic_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Length as a 32-bit integer, then the characters.
inline void put_text(std::string& bytes, std::string_view text) {
  put(bytes, static_cast<std::uint32_t>(text.size()));
  bytes.append(text);
}

/// Reads what the functions above wrote from bytes that may be anything: what is not there is an
/// error, never a read beyond the end, and no size is believed before the bytes for it were seen.
class ByteReader {
 public:
  /// @param name of the file, for errors
  ByteReader(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

  /// @throws InputError "<file>: <why>"
  [[noreturn]] void fail(const std::string& why) const { throw InputError(name_ + ": " + why); }
  void require(bool condition, const std::string& why) const {
    if (!condition) fail(why);
  }

  /// @throws InputError "<file>: ends within <what>" if fewer bytes are left; as all below.
  template <class T>
  T number(std::string_view what) {
    static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>);
    T value;
    numbers(std::span(&value, 1), what);
    return value;
  }
  template <class T>
  void numbers(std::span<T> into, std::string_view what) {
    const std::string_view taken = block(into.size_bytes(), what);
    if (!taken.empty()) std::memcpy(into.data(), taken.data(), taken.size());
  }

  /// A count of items of at least `bytes_each`, which must be left.
  std::size_t count(std::size_t bytes_each, std::string_view what) {
    const auto items = number<std::uint32_t>(what);
    require_items(items, bytes_each, what);
    return items;
  }
  void require_items(std::size_t items, std::size_t bytes_each, std::string_view what) const {
    if (items > bytes_.size() / bytes_each) cut_short(what);
  }

  std::string text(std::string_view what) { return std::string(block(count(1, what), what)); }

  std::string_view block(std::size_t size, std::string_view what) {
    if (size > bytes_.size()) cut_short(what);
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }

  [[nodiscard]] std::size_t left() const { return bytes_.size(); }
  /// Nothing may be left.
  void finish() const {
    require(bytes_.empty(), "has " + std::to_string(bytes_.size()) + " bytes too many");
  }

 private:
  [[noreturn]] void cut_short(std::string_view what) const {
    fail("ends within " + std::string(what));
  }

  std::string_view bytes_;
  std::string name_;
};

}  // namespace vantage
