#include <string>

#include "python/bindings.hpp"
#include "python/kit/calls.hpp"
#include "python/kit/options.hpp"
#include "vantage/core/data_root.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/log.hpp"
#include "vantage/information/distribution_error.hpp"
#include "vantage/planners/choice/outside_choice.hpp"
#include "vantage/planners/objects/information_measure.hpp"
#include "vantage/planners/trajectory/optimisers/trajectory_optimiser.hpp"
#include "vantage/runtime/manifest.hpp"
#include "vantage/tasks/task.hpp"

namespace vantage::python {
namespace {

/// The types of exceptions; they live as long as the process.
struct ErrorTypes {
  PyObject* base = nullptr;
  PyObject* config = nullptr;
  PyObject* input = nullptr;
  PyObject* output = nullptr;
  PyObject* renderer = nullptr;
  PyObject* diverged = nullptr;
  PyObject* decision = nullptr;
  PyObject* distribution = nullptr;
};
ErrorTypes g_errors;

PyObject* error_type(py::module_& module, const char* name, const char* text,
                     std::initializer_list<PyObject*> bases) {
  py::list list;
  for (PyObject* base : bases) list.append(py::handle(base));
  PyObject* made = PyErr_NewExceptionWithDoc((std::string("vantage.") + name).c_str(), text,
                                             py::tuple(list).ptr(), nullptr);
  if (made == nullptr) throw py::error_already_set();
  module.add_object(name, made);
  Py_INCREF(made);
  return made;
}

void add_errors(py::module_& module) {
  ErrorTypes& types = g_errors;
  types.base =
      error_type(module, "Error", "What the library finds wrong; the others derive from it.",
                 {PyExc_Exception});
  const auto add = [&](const char* name, const char* text, PyObject* builtin) {
    return error_type(module, name, text, {types.base, builtin});
  };
  types.config =
      add("ConfigError", "An option, a key or an argument that cannot be used.", PyExc_ValueError);
  types.input = add("InputError", "A file that cannot be used.", PyExc_ValueError);
  types.output = add("OutputError", "A file or folder that could not be written.", PyExc_OSError);
  types.renderer = add("RendererError", "No OpenGL context could be made.", PyExc_RuntimeError);
  types.diverged = add("DivergedError", "The simulation diverged.", PyExc_RuntimeError);
  types.decision = add("BadDecision", "A choice that cannot be carried out.", PyExc_ValueError);
  types.distribution =
      add("DistributionError", "Numbers that are no probability distribution.", PyExc_ValueError);
}

PyObject* type_of(const Error& error) {
  if (dynamic_cast<const BadDecision*>(&error) != nullptr) return g_errors.decision;
  switch (error.code()) {
    case ExitCode::usage: return g_errors.config;
    case ExitCode::bad_input: return g_errors.input;
    case ExitCode::output: return g_errors.output;
    case ExitCode::no_renderer: return g_errors.renderer;
    case ExitCode::diverged: return g_errors.diverged;
    default: return g_errors.base;
  }
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): as pybind11 calls it
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const Error& error) {
    if (error.code() == ExitCode::interrupted) {
      PyErr_SetNone(PyExc_KeyboardInterrupt);
    } else {
      PyErr_SetString(type_of(error), error.what());
    }
  } catch (const DistributionError& error) {
    PyErr_SetString(g_errors.distribution, error.what());
  } catch (const py::cast_error&) {
    PyErr_SetString(PyExc_TypeError,
                    "an argument, or a part of it, is of another type than needed");
  }
}

Verbosity verbosity_of(const std::string& name) {
  if (name == "quiet") return Verbosity::quiet;
  if (name == "normal") return Verbosity::normal;
  if (name == "verbose") return Verbosity::verbose;
  throw ConfigError("verbosity: '" + name + "' is none of quiet, normal, verbose");
}

template <class Family>
py::dict described() {
  py::dict strategies;
  for (const std::string_view name : strategy_names<Family>()) {
    const Family made = make_strategy<Family>(name);
    py::dict options = object_of(write_node(made));
    options.attr("pop")("name");
    const std::string_view summary = std::visit(
        [](const auto& s) { return std::remove_cvref_t<decltype(s)>::text.summary; }, made);
    strategies[py::str(std::string(name))] =
        py::dict(py::arg("summary") = std::string(summary), py::arg("options") = options);
  }
  return strategies;
}

py::dict strategies(const std::string& family) {
  if (family == "gains") return described<Gain>();
  if (family == "choices") return described<ViewChoice>();
  if (family == "optimisers") return described<TrajectoryOptimiser>();
  if (family == "measures") return described<InformationMeasure>();
  throw ConfigError("strategies: '" + family + "' is none of gains, choices, optimisers, measures");
}

}  // namespace

void bind_calls(py::module_& module) {
  add_errors(module);
  py::register_exception_translator(translate);
  set_verbosity(Verbosity::quiet);
  module.def(
      "set_verbosity", [](const std::string& name) { set_verbosity(verbosity_of(name)); },
      py::arg("name"),
      "What the library tells on stderr: 'quiet' (errors alone; as imported), 'normal' (progress, "
      "warnings) or 'verbose'.");
  module.def("version", &version_text, "Version of the library and the commit it was built of.");
  module.def(
      "data_root", [] { return data_root().string(); },
      "Folder with the models, scenes and episodes that come with Vantage.");
  module.def(
      "_set_data_root", [](const std::string& root) { set_data_root(root); }, py::arg("root"),
      "Where the package has its data.");
  module.def("strategies", &strategies, py::arg("family"),
             "What there is to choose from, by name: a dict of {'summary': str, 'options': dict of "
             "defaults}. `family` is 'gains', 'choices', 'optimisers' or 'measures'.");
}

}  // namespace vantage::python
