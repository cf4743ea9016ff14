/// A recogniser at work on one object, with arrays in and out.
#pragma once

#include <Eigen/Core>
#include <pybind11/numpy.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/perception/dataset_reader.hpp"
#include "vantage/recognition/recognition.hpp"

namespace vantage::python {

namespace py = pybind11;

using Colours = py::array_t<std::uint8_t, py::array::c_style>;
using Depths = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Mask = py::array_t<bool, py::array::c_style | py::array::forcecast>;

struct CameraArguments {
  double elevation_rad = kUsualElevation_rad;
  double focal_px = 570.3;
  std::optional<Eigen::Vector2d> centre_px;
};

/// What its members mean is told where they are bound.
class ActiveRecogniser {
 public:
  ActiveRecogniser(const std::filesystem::path& model, std::uint64_t seed,
                   const py::object& recogniser, const py::object& recognition);
  py::dict update(const Colours& rgb, const Depths& depth, const std::optional<Mask>& mask,
                  double turned_rad, const CameraArguments& camera);
  void reset() { known_ = begin_recognition(recogniser_); }
  py::dict next_feature(const std::vector<std::string>& extracted);
  py::dict next_view(const std::optional<std::vector<double>>& turns);

  [[nodiscard]] py::array_t<double> posterior() const;
  [[nodiscard]] py::dict estimate() const;
  [[nodiscard]] std::vector<std::string> features() const;
  [[nodiscard]] const ObjectStates& states() const { return recogniser_.states; }
  [[nodiscard]] const Recognition& known() const { return known_; }

 private:
  [[nodiscard]] bool was_visited(double turn_rad) const;
  [[nodiscard]] py::dict last_view() const;

  RecognitionOptions options_;
  Rng rng_;
  Recogniser recogniser_;
  Recognition known_;
};

}  // namespace vantage::python
