/// Reads a binary record that may be anything: what is not there is an error, never a read beyond
/// the end, and no size is believed before the bytes for it were seen.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "vantage/core/bytes.hpp"
#include "vantage/core/error.hpp"

namespace vantage {

class ByteReader {
 public:
  /// @param name of the file, for errors
  ByteReader(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

  /// @throws InputError "<file>: <why>"
  [[noreturn]] void fail(const std::string& why) const { throw InputError(name_ + ": " + why); }
  void require(bool condition, const std::string& why) const {
    if (!condition) fail(why);
  }

  /// @throws InputError if fewer bytes are left; as all below.
  template <class T>
  T number(std::string_view what) {
    std::string_view bytes = block(sizeof(T), what);
    return take<T>(bytes);
  }

  /// A count of items of at least `bytes_each`, which must be left.
  std::size_t count(std::size_t bytes_each, std::string_view what) {
    const auto items = number<std::uint32_t>(what);
    if (items > bytes_.size() / bytes_each) cut_short(what);
    return items;
  }

  std::string text(std::string_view what) { return std::string(block(count(1, what), what)); }

  std::string_view block(std::size_t size, std::string_view what) {
    if (size > bytes_.size()) cut_short(what);
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }

  [[nodiscard]] std::size_t left() const { return bytes_.size(); }

 private:
  [[noreturn]] void cut_short(std::string_view what) const {
    fail("ends within " + std::string(what));
  }

  std::string_view bytes_;
  std::string name_;
};

inline void put_text(std::string& bytes, std::string_view text) {
  put(bytes, static_cast<std::uint32_t>(text.size()));
  bytes.append(text);
}

}  // namespace vantage
