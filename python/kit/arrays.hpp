/// numpy arrays in and out. Cells of a grid are indexed [x, y, z] in Python; in memory x runs
/// fastest, as in the library, so that arrays of cells are Fortran-ordered and no copies.
#pragma once

#include <Eigen/Core>
#include <pybind11/numpy.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "vantage/geometry/grid_frame.hpp"
#include "vantage/planners/candidate.hpp"

namespace vantage::python {

namespace py = pybind11;

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Cells = py::array_t<float, py::array::f_style | py::array::forcecast>;

/// No coordinate is farther from the origin: cells are counted in whole numbers.
inline constexpr double kMaxCoordinate_m = 1e6;

/// "(3, 4)"
std::string shape_text(const py::array& array);
/// @throws ConfigError naming the argument
[[noreturn]] void refuse(const std::string& argument, const std::string& why);
void require_threads(int threads);

/// Rows of `columns` numbers, finite and no larger than kMaxCoordinate_m. One row may be given
/// flat.
Eigen::MatrixXd rows_of(const Doubles& array, Eigen::Index columns, const std::string& argument);

/// Sensor poses T_world_sensor: n x 4 (x, y, z, yaw), n x 5 (pitch, positive looks down) or
/// n x 4 x 4 (rigid transforms).
std::vector<Candidate> views_of(const Doubles& array);
/// n x 5, as above.
py::array_t<double> view_rows(std::span<const Candidate> views);

/// A pose on the floor: x, y, yaw.
Pose2 pose2_of(const Doubles& array, const std::string& argument);
py::array_t<double> pose2_row(const Pose2& pose);
/// n x 3
py::array_t<double> pose2_rows(std::span<const Pose2> poses);

/// (nx, ny, nz) over the memory of `owner`, which it keeps alive.
template <class T>
py::array cells_view(const GridFrame& frame, const T* data, py::handle owner, bool writable) {
  const Eigen::Array3i& n = frame.cells;
  constexpr auto kSize = static_cast<py::ssize_t>(sizeof(T));
  py::array_t<T> view({n.x(), n.y(), n.z()}, {kSize, kSize * n.x(), kSize * n.x() * n.y()}, data,
                      owner);
  if (!writable) view.attr("setflags")(py::arg("write") = false);
  return view;
}

/// The vector itself, of that shape: nothing is copied. Strides run as in the vector, with the
/// first index fastest if `first_fastest`.
template <class T>
py::array_t<T> array_of(std::vector<T> values, std::vector<py::ssize_t> shape,
                        bool first_fastest = false) {
  std::vector<py::ssize_t> strides(shape.size());
  auto step = static_cast<py::ssize_t>(sizeof(T));
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const std::size_t axis = first_fastest ? i : shape.size() - 1 - i;
    strides[axis] = step;
    step *= shape[axis];
  }
  auto kept = std::make_unique<std::vector<T>>(std::move(values));
  const T* data = kept->data();
  const py::capsule owner(kept.get(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
  static_cast<void>(kept.release());  // the capsule's
  return py::array_t<T>(std::move(shape), std::move(strides), data, owner);
}
template <class T>
py::array_t<T> array_of(std::vector<T> values) {
  const auto n = static_cast<py::ssize_t>(values.size());
  return array_of(std::move(values), {n});
}

}  // namespace vantage::python
