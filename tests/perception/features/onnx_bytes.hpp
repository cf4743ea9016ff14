/// ONNX networks of one layer, written field by field. [onnx.proto, Protocol Buffers encoding]
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace vantage {

inline std::string varint(std::uint64_t value) {
  std::string bytes;
  for (; value > 127; value >>= 7) bytes.push_back(static_cast<char>((value & 127) | 128));
  bytes.push_back(static_cast<char>(value));
  return bytes;
}
inline std::string number_field(int field, std::uint64_t value) {
  return varint(static_cast<std::uint64_t>(field) << 3) + varint(value);
}
inline std::string bytes_field(int field, std::string_view content) {
  return varint(static_cast<std::uint64_t>(field) << 3 | 2U) + varint(content.size()) +
         std::string(content);
}

/// A float tensor's name, type and shape: ValueInfoProto.
inline std::string value_info(std::string_view name, const std::vector<int>& shape) {
  std::string dims;
  for (const int size : shape) {
    dims += bytes_field(1, number_field(1, static_cast<std::uint64_t>(size)));
  }
  const std::string tensor = number_field(1, 1) + bytes_field(2, dims);
  return bytes_field(1, name) + bytes_field(2, bytes_field(1, tensor));
}

/// ModelProto around the nodes and constants of a graph from "x", of so many channels, to "y".
inline std::string onnx_model(const std::string& nodes, const std::string& constants,
                              int channels) {
  const std::string graph = nodes + bytes_field(2, "tiny") + constants +
                            bytes_field(11, value_info("x", {1, channels, 224, 224})) +
                            bytes_field(12, value_info("y", {1, 3, 1, 1}));
  const std::string opset = bytes_field(1, "") + number_field(2, 11);
  return number_field(1, 7) + bytes_field(7, graph) + bytes_field(8, opset);
}

/// The mean of each channel.
inline std::string averaging_network() {
  const std::string node =
      bytes_field(1, "x") + bytes_field(2, "y") + bytes_field(4, "GlobalAveragePool");
  return onnx_model(bytes_field(1, node), "", 3);
}

/// The means of 4 x 4 squares of 56 px of each channel.
inline std::string pooling_network() {
  const auto sides = [](std::string_view name) {
    return bytes_field(
        5, bytes_field(1, name) + number_field(8, 56) + number_field(8, 56) + number_field(20, 7));
  };
  const std::string node = bytes_field(1, "x") + bytes_field(2, "y") +
                           bytes_field(4, "AveragePool") + sides("kernel_shape") + sides("strides");
  return onnx_model(bytes_field(1, node), "", 3);
}

/// A 1 x 1 convolution of an input of `channels` channels.
inline std::string convolution_network(int channels) {
  const std::string raw(static_cast<std::size_t>(channels) * sizeof(float), '\0');
  std::string weights = number_field(1, 1) + number_field(1, static_cast<std::uint64_t>(channels)) +
                        number_field(1, 1) + number_field(1, 1);
  weights += number_field(2, 1) + bytes_field(8, "w") + bytes_field(9, raw);
  const std::string node = bytes_field(1, "x") + bytes_field(1, "w") + bytes_field(2, "y") +
                           bytes_field(4, "Conv") +
                           bytes_field(5, bytes_field(1, "kernel_shape") + number_field(8, 1) +
                                              number_field(8, 1) + number_field(20, 7));
  return onnx_model(bytes_field(1, node), bytes_field(5, weights), channels);
}

}  // namespace vantage
