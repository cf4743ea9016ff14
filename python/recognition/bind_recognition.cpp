#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>

#include "python/bindings.hpp"
#include "python/kit/arrays.hpp"
#include "python/kit/calls.hpp"
#include "python/kit/options.hpp"
#include "python/recognition/active_recogniser.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/perception/dataset_index.hpp"
#include "vantage/recognition/training.hpp"

namespace vantage::python {
namespace {

namespace fs = std::filesystem;

void train(
    const fs::path& dataset, const fs::path& out, int threads,
    const std::optional<std::function<void(const std::string&, std::size_t, std::size_t)>>& tell,
    const std::optional<fs::path>& cache, const py::kwargs& options) {
  require_threads(threads);
  const auto wanted = options_of<TrainingOptions>(options, "");
  LongWork how;
  how.threads = threads;
  how.poll = throw_if_signalled;
  how.tell = tell ? *tell : [](const std::string&, std::size_t, std::size_t) {};
  how.feature_cache = cache.value_or(fs::path());
  without_lock([&] {
    make_writable_directory(fs::absolute(out).parent_path());
    write_recognition_model(train_recognition(index_dataset(dataset), wanted, how), out);
  });
}

constexpr auto kUpdateText = R"(Takes a view of the object into what is known of it.

Parameters
----------
rgb : array (h, w, 3) of uint8
depth : array (h, w)
    Along the optical axis, m; 0 or NaN where nothing was measured.
mask : array (h, w) of bool
    The object's pixels. None: the object nearest to the middle is told by depth alone.
turned_rad : float
    Turn of the camera about the object since the view before, counter-clockwise from above.
elevation_rad : float
    How far the camera looks down.
focal_px : float
centre_px : (2,)
    Principal point in the picture; None: the picture is the middle of a 640 x 480 one.

Returns
-------
dict : features (list), skipped (dict of reasons), entropy_bits, feature_time_s.
)";

}  // namespace

void bind_recognition(py::module_& module) {
  using Active = ActiveRecogniser;
  py::class_<Active>(
      module, "Recogniser",
      "Active recognition of one object by a trained model.\n\n`recogniser` and `recognition` are "
      "dicts of the keys of `vantage recognise --set`; unless recognition['all_features'] is False "
      "every feature of a view is extracted. Raises InputError, ConfigError.")
      .def(py::init<const fs::path&, std::uint64_t, const py::object&, const py::object&>(),
           py::arg("model"), py::arg("seed") = 1, py::arg("recogniser") = py::none(),
           py::arg("recognition") = py::none())
      .def(
          "update",
          [](Active& self, const Colours& rgb, const Depths& depth, const std::optional<Mask>& mask,
             double turned_rad, double elevation_rad, double focal_px,
             const std::optional<Eigen::Vector2d>& centre_px) {
            return self.update(rgb, depth, mask, turned_rad, {elevation_rad, focal_px, centre_px});
          },
          py::arg("rgb"), py::arg("depth"), py::arg("mask") = py::none(), py::kw_only(),
          py::arg("turned_rad") = 0.0, py::arg("elevation_rad") = kUsualElevation_rad,
          py::arg("focal_px") = 570.3, py::arg("centre_px") = py::none(), kUpdateText)
      .def("reset", &Active::reset, "Forgets what was seen: the next view is of another object.")
      .def("next_feature", &Active::next_feature, py::arg("extracted") = std::vector<std::string>(),
           "Which feature to extract from a view: dict of `feature` (None: none is worth it) and "
           "`gain_bits`, what each not in `extracted` is expected to tell.")
      .def("next_view", &Active::next_view, py::arg("turns_rad") = py::none(),
           "Where to look next: dict of `turn_rad` about the object, of `turns_rad` (default: by "
           "whole yaw bins to sides that the model has views of), and `gain_bits`, what each is "
           "expected to tell.")
      .def_property_readonly("posterior", &Active::posterior,
                             "p(object, yaw bin), (objects, bins); the rest to 1 is `p_unknown`.")
      .def_property_readonly(
          "p_objects", [](const Active& a) { return p_object(a.states(), a.known().belief); },
          "(objects,)")
      .def_property_readonly(
          "p_categories", [](const Active& a) { return p_category(a.states(), a.known().belief); },
          "(categories,)")
      .def_property_readonly(
          "p_unknown", [](const Active& a) { return p_unknown(a.states(), a.known().belief); },
          "That it is none of the objects.")
      .def_property_readonly(
          "entropy_bits", [](const Active& a) { return state_entropy_bits(a.known().belief); },
          "Of object and yaw bin.")
      .def_property_readonly("estimate", &Active::estimate,
                             "What it is held to be: dict of object, category, probability.")
      .def_property_readonly(
          "views", [](const Active& a) { return a.known().views.size(); }, "Views taken in so far.")
      .def_property_readonly("features", &Active::features, "Names of the model's features.")
      .def_property_readonly(
          "objects", [](const Active& a) { return a.states().objects; }, "Names.")
      .def_property_readonly(
          "categories", [](const Active& a) { return a.states().categories; }, "Names.")
      .def_property_readonly(
          "bins", [](const Active& a) { return a.states().bins; }, "Yaw bins of an object.");
  module.def(
      "train", &train, py::arg("dataset"), py::arg("out"), py::arg("threads") = 1,
      py::arg("progress") = py::none(), py::arg("feature_cache") = py::none(),
      "Learns to recognise the objects of a folder in the layout of the RGB-D Object Dataset and "
      "writes the model to `out`.\n\n`progress(part, done, of)` is called now and then. Options: "
      "seed, features, videos, bins, ... as in `vantage train`. Raises InputError, ConfigError, "
      "OutputError; Ctrl-C ends it.");
}

}  // namespace vantage::python
