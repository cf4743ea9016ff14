/// Bytes that come in pieces, put together to lines, of which none is longer than a bound.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace vantage {

class LineBuffer {
 public:
  explicit LineBuffer(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// @return false if more would wait than is allowed: what is too much is not kept
  bool add(std::string_view bytes);
  /// The first whole line, without its end; none if there is none.
  std::optional<std::string> take();
  /// Bytes that were not taken yet.
  [[nodiscard]] std::size_t waiting() const { return bytes_.size(); }

 private:
  std::size_t most_bytes_;
  std::string bytes_;
};

/// `text` for people: what is not printable ASCII as \xNN, and of no more than so many characters,
/// then " ...".
std::string printable(std::string_view text, std::size_t most = 80);

}  // namespace vantage
