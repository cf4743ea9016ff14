/// The trained state of a feature as bytes: matrices and options. What the bytes lack or hold too
/// much of is an InputError that begins with the reader's file.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "vantage/core/bytes.hpp"
#include "vantage/core/fields.hpp"

namespace vantage {

/// Rows and columns as 32-bit integers, then the numbers column by column.
void put_matrix(std::string& bytes, const Eigen::MatrixXf& matrix);
/// What put_matrix() wrote, of finite numbers.
Eigen::MatrixXf take_matrix(ByteReader& reader);
/// The same of just this size; -1: any.
Eigen::MatrixXf take_matrix(ByteReader& reader, Eigen::Index rows, Eigen::Index columns);
Eigen::VectorXf take_vector(ByteReader& reader, Eigen::Index size);

/// Visitors that write and read the fields of an options struct.
struct FieldPutter {
  std::string& bytes;
  template <class T>
  void operator()(std::string_view, T& value, std::string_view, const Range& = {}) {
    if constexpr (HasFields<T>) {
      value.fields(*this);
    } else if constexpr (std::is_same_v<T, std::string>) {
      put_text(bytes, value);
    } else {
      static_assert(std::is_arithmetic_v<T>);
      put(bytes, value);
    }
  }
};
struct FieldTaker {
  ByteReader& reader;
  template <class T>
  void operator()(std::string_view name, T& value, std::string_view, const Range& = {}) {
    if constexpr (HasFields<T>) {
      value.fields(*this);
    } else if constexpr (std::is_same_v<T, std::string>) {
      value = reader.text(name);
    } else if constexpr (std::is_same_v<T, bool>) {
      value = reader.number<std::uint8_t>(name) != 0;
    } else {
      value = reader.number<T>(name);
    }
  }
};

template <HasFields T>
void put_options(std::string& bytes, T options) {
  options.fields(FieldPutter{bytes});
}
/// Options within their ranges.
template <HasFields T>
T take_options(ByteReader& reader) {
  T options;
  options.fields(FieldTaker{reader});
  try {
    check_options(options);
  } catch (const ConfigError& error) {
    reader.fail(error.what());
  }
  return options;
}

}  // namespace vantage
