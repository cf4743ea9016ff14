/// Random distributions for the property tests.
#pragma once

#include <Eigen/Core>
#include <rapidcheck.h>

#include <vector>

namespace vantage::test {

/// Some outcomes have probability exactly zero, some are tiny.
inline std::vector<double> random_distribution(std::size_t size) {
  const auto weights = *rc::gen::container<std::vector<int>>(
      size, rc::gen::weightedElement<int>({{3, 0}, {2, 1}, {5, 1000}, {5, 37'003}, {5, 90'001}}));
  std::vector<double> p(size);
  double sum = 0.0;
  for (std::size_t i = 0; i < size; ++i) sum += p[i] = weights[i];
  if (sum == 0.0) sum = p.front() = 1.0;
  for (double& mass : p) mass /= sum;
  return p;
}

inline std::vector<double> random_distribution() {
  return random_distribution(*rc::gen::inRange<std::size_t>(1, 9));
}

inline Eigen::MatrixXd random_joint() {
  const int rows = *rc::gen::inRange(1, 6);
  const int columns = *rc::gen::inRange(1, 6);
  const auto p =
      random_distribution(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  return Eigen::Map<const Eigen::MatrixXd>(p.data(), rows, columns);
}

inline std::vector<double> flat(const Eigen::MatrixXd& matrix) {
  return {matrix.data(), matrix.data() + matrix.size()};
}

}  // namespace vantage::test
