/// Numbers in binary files, in the machine's byte order.
#pragma once

#include <cstring>
#include <string>
#include <string_view>

namespace vantage {

template <class T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Removes what it reads; `bytes` must hold it.
template <class T>
T take(std::string_view& bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return value;
}

}  // namespace vantage
