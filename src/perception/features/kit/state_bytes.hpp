/// The trained state of a feature as bytes: matrices, options, and a reader that trusts nothing.
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
/// Length as a 32-bit integer, then the characters.
void put_text(std::string& bytes, std::string_view text);

/// Reads what put() and the functions above wrote. Whatever the bytes lack or hold too much of is
/// an InputError that begins with `source`.
class StateReader {
 public:
  /// @param source whose bytes they are, for messages: a file's path
  StateReader(std::string_view bytes, std::string source)
      : bytes_(bytes), source_(std::move(source)) {}

  template <class T>
  T number() {
    static_assert(std::is_arithmetic_v<T>);
    require(sizeof(T));
    return take<T>(bytes_);
  }
  std::string text();
  /// A matrix of finite numbers.
  Eigen::MatrixXf matrix();
  /// A matrix of just this size; -1: any.
  Eigen::MatrixXf matrix(Eigen::Index rows, Eigen::Index columns);
  Eigen::VectorXf vector(Eigen::Index size);
  /// Nothing may be left.
  void finish() const;
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void require(std::size_t bytes) const;
  std::string_view bytes_;
  std::string source_;
};

/// Visitors that write and read the fields of an options struct.
struct FieldPutter {
  std::string& bytes;
  template <class T>
  void operator()(std::string_view, T& value, const Range& = {}) {
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
  StateReader& reader;
  template <class T>
  void operator()(std::string_view, T& value, const Range& = {}) {
    if constexpr (HasFields<T>) {
      value.fields(*this);
    } else if constexpr (std::is_same_v<T, std::string>) {
      value = reader.text();
    } else if constexpr (std::is_same_v<T, bool>) {
      value = reader.number<std::uint8_t>() != 0;
    } else {
      value = reader.number<T>();
    }
  }
};

template <HasFields T>
void put_options(std::string& bytes, T options) {
  options.fields(FieldPutter{bytes});
}
/// Options within their ranges.
template <HasFields T>
T take_options(StateReader& reader) {
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
