#include "vantage/runtime/process/line_buffer.hpp"

#include <fmt/format.h>

namespace vantage {

bool LineBuffer::add(std::string_view bytes) {
  const std::size_t room = most_bytes_ - bytes_.size();
  bytes_.append(bytes.substr(0, room));
  return bytes.size() <= room;
}

std::optional<std::string> LineBuffer::take() {
  const auto end = bytes_.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = bytes_.substr(0, end);
  bytes_.erase(0, end + 1);
  return line;
}

std::string printable(std::string_view text, std::size_t most) {
  std::string shown;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = byte >= 0x20 && byte < 0x7f;
    shown += plain ? std::string(1, c) : fmt::format("\\x{:02x}", byte);
    if (shown.size() > most) return shown.substr(0, most) + " ...";
  }
  return shown;
}

}  // namespace vantage
