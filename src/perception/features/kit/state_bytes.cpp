#include "vantage/perception/features/kit/state_bytes.hpp"

#include <fmt/format.h>

namespace vantage {

void put_matrix(std::string& bytes, const Eigen::MatrixXf& matrix) {
  put(bytes, static_cast<std::uint32_t>(matrix.rows()));
  put(bytes, static_cast<std::uint32_t>(matrix.cols()));
  bytes.append(reinterpret_cast<const char*>(matrix.data()),
               static_cast<std::size_t>(matrix.size()) * sizeof(float));
}

void put_text(std::string& bytes, std::string_view text) {
  put(bytes, static_cast<std::uint32_t>(text.size()));
  bytes.append(text);
}

void StateReader::fail(const std::string& what) const { throw InputError(source_ + ": " + what); }

void StateReader::require(std::size_t bytes) const {
  if (bytes_.size() < bytes) {
    fail(fmt::format("ends {} bytes too early", bytes - bytes_.size()));
  }
}

std::string StateReader::text() {
  const auto size = number<std::uint32_t>();
  require(size);
  std::string text(bytes_.substr(0, size));
  bytes_.remove_prefix(size);
  return text;
}

Eigen::MatrixXf StateReader::matrix() {
  const std::uint64_t rows = number<std::uint32_t>();
  const std::uint64_t columns = number<std::uint32_t>();
  if (columns != 0 && rows > bytes_.size() / sizeof(float) / columns) {
    fail(fmt::format("ends within a matrix of {} x {}", rows, columns));
  }
  Eigen::MatrixXf matrix(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  const std::size_t size = rows * columns * sizeof(float);
  if (size > 0) std::memcpy(matrix.data(), bytes_.data(), size);
  bytes_.remove_prefix(size);
  if (!matrix.allFinite()) fail("holds a number that is not finite");
  return matrix;
}

Eigen::MatrixXf StateReader::matrix(Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXf read = matrix();
  if ((rows >= 0 && read.rows() != rows) || (columns >= 0 && read.cols() != columns)) {
    fail(fmt::format("holds a matrix of {} x {} where {} x {} belongs", read.rows(), read.cols(),
                     rows, columns));
  }
  return read;
}

Eigen::VectorXf StateReader::vector(Eigen::Index size) { return matrix(size, 1); }

void StateReader::finish() const {
  if (!bytes_.empty()) fail(fmt::format("{} bytes too many", bytes_.size()));
}

}  // namespace vantage
