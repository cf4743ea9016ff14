#include "python/kit/arrays.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "vantage/planners/views/view_list.hpp"

namespace vantage::python {
namespace {

Pose pose_of_row(const double* row, py::ssize_t columns) {
  return make_pose({row[0], row[1], row[2]}, row[3], columns == 5 ? row[4] : 0.0);
}

/// Row-major 4 x 4.
Pose pose_of_matrix(const double* entries, std::size_t index) {
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> T(entries);
  constexpr double kTolerance = 1e-6;
  const Eigen::Matrix3d R = T.topLeftCorner<3, 3>();
  const bool rigid = (R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < kTolerance &&
                     R.determinant() > 0.0 &&
                     (T.row(3) - Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0)).norm() < kTolerance;
  if (!rigid) refuse("views", fmt::format("view {} is no rigid transform", index));
  Pose pose = Pose::Identity();
  pose.linear() = R;
  pose.translation() = T.topRightCorner<3, 1>();
  return pose;
}

void require_coordinates(const double* values, std::size_t count, const std::string& argument) {
  for (std::size_t i = 0; i < count; ++i) {
    if (std::abs(values[i]) <= kMaxCoordinate_m) continue;  // false of NaN
    refuse(argument, fmt::format("{} is no finite number up to 1e6", values[i]));
  }
}

}  // namespace

std::string shape_text(const py::array& array) {
  return fmt::format(
      "({})", fmt::join(std::span(array.shape(), static_cast<std::size_t>(array.ndim())), ", "));
}

void refuse(const std::string& argument, const std::string& why) {
  throw ConfigError(argument + ": " + why);
}

void require_threads(int threads) {
  if (threads < 1 || threads > 256)
    refuse("threads", fmt::format("{} is not in [1, 256]", threads));
}

Eigen::MatrixXd rows_of(const Doubles& array, Eigen::Index columns, const std::string& argument) {
  const bool one = array.ndim() == 1 && array.shape(0) == columns;
  if (!one && (array.ndim() != 2 || array.shape(1) != columns)) {
    refuse(argument, fmt::format("shape {} is not (n, {})", shape_text(array), columns));
  }
  require_coordinates(array.data(), static_cast<std::size_t>(array.size()), argument);
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(array.data(), one ? 1 : array.shape(0), columns);
}

std::vector<Candidate> views_of(const Doubles& array) {
  const bool rows = array.ndim() == 2 && (array.shape(1) == 4 || array.shape(1) == 5);
  const bool matrices = array.ndim() == 3 && array.shape(1) == 4 && array.shape(2) == 4;
  if (!rows && !matrices) {
    refuse("views", "shape " + shape_text(array) + " is not (n, 4), (n, 5) or (n, 4, 4)");
  }
  constexpr py::ssize_t kMaxViews = 20'000;  // stations are compared pair by pair
  if (array.shape(0) > kMaxViews) {
    refuse("views", fmt::format("{} views are more than {}", array.shape(0), kMaxViews));
  }
  require_coordinates(array.data(), static_cast<std::size_t>(array.size()), "views");
  std::vector<Candidate> views(static_cast<std::size_t>(array.shape(0)));
  const auto entries = static_cast<std::size_t>(rows ? array.shape(1) : 16);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const double* from = array.data() + i * entries;
    views[i].id = static_cast<int>(i);
    views[i].T_world_sensor = rows ? pose_of_row(from, array.shape(1)) : pose_of_matrix(from, i);
  }
  return views;
}

py::array_t<double> view_rows(std::span<const Candidate> views) {
  std::vector<double> rows;
  for (const Candidate& view : views) {
    const Eigen::Vector3d p = view.T_world_sensor.translation();
    rows.insert(rows.end(), {p.x(), p.y(), p.z(), yaw_of(view), pitch_of(view)});
  }
  return array_of(std::move(rows), {static_cast<py::ssize_t>(views.size()), 5});
}

Pose2 pose2_of(const Doubles& array, const std::string& argument) {
  if (array.ndim() != 1 || array.shape(0) != 3) {
    refuse(argument, "shape " + shape_text(array) + " is not (3,): x, y, yaw");
  }
  const Eigen::MatrixXd row = rows_of(array, 3, argument);
  return {row(0, 0), row(0, 1), row(0, 2)};
}

py::array_t<double> pose2_row(const Pose2& pose) {
  return array_of(std::vector<double>{pose.x_m, pose.y_m, pose.yaw_rad});
}

py::array_t<double> pose2_rows(std::span<const Pose2> poses) {
  std::vector<double> rows;
  for (const Pose2& pose : poses) rows.insert(rows.end(), {pose.x_m, pose.y_m, pose.yaw_rad});
  return array_of(std::move(rows), {static_cast<py::ssize_t>(poses.size()), 3});
}

}  // namespace vantage::python
