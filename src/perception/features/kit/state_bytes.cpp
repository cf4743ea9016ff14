#include "vantage/perception/features/kit/state_bytes.hpp"

#include <fmt/format.h>

#include <span>

namespace vantage {

void put_matrix(std::string& bytes, const Eigen::MatrixXf& matrix) {
  put(bytes, static_cast<std::uint32_t>(matrix.rows()));
  put(bytes, static_cast<std::uint32_t>(matrix.cols()));
  bytes.append(reinterpret_cast<const char*>(matrix.data()),
               static_cast<std::size_t>(matrix.size()) * sizeof(float));
}

Eigen::MatrixXf take_matrix(ByteReader& reader) {
  const std::uint64_t rows = reader.number<std::uint32_t>("a matrix");
  const std::uint64_t columns = reader.number<std::uint32_t>("a matrix");
  if (columns != 0 && rows > reader.left() / sizeof(float) / columns) {
    reader.fail(fmt::format("ends within a matrix of {} x {}", rows, columns));
  }
  Eigen::MatrixXf matrix(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  reader.numbers(std::span(matrix.data(), rows * columns), "a matrix");
  reader.require(matrix.allFinite(), "holds a number that is not finite");
  return matrix;
}

Eigen::MatrixXf take_matrix(ByteReader& reader, Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXf read = take_matrix(reader);
  if ((rows >= 0 && read.rows() != rows) || (columns >= 0 && read.cols() != columns)) {
    reader.fail(fmt::format("holds a matrix of {} x {} where {} x {} belongs", read.rows(),
                            read.cols(), rows, columns));
  }
  return read;
}

Eigen::VectorXf take_vector(ByteReader& reader, Eigen::Index size) {
  return take_matrix(reader, size, 1);
}

}  // namespace vantage
