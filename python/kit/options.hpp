/// Options structs from dicts and keyword arguments of Python, read as strictly as from YAML, and
/// back.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "vantage/core/fields.hpp"

namespace vantage::python {

namespace py = pybind11;

/// Of None, numbers, text, lists, dicts and numpy arrays.
/// @param name of the argument, for messages @throws ConfigError if a value is none of these
ConfigNode node_of(py::handle value, const std::string& name);

/// The same as Python objects: numbers where a scalar reads as one.
py::object object_of(const ConfigNode& node);

/// What `given` sets of `defaults`; None: nothing.
/// @throws ConfigError naming argument, key and value
template <class Options>
Options options_of(const py::handle& given, const std::string& name, Options defaults = {}) {
  if (given.is_none()) return defaults;
  read_into(node_of(given, name), defaults);
  return defaults;
}

/// A strategy by its name and the options given beside it.
template <class Family>
Family strategy_of(const std::string& name, const py::dict& options, const std::string& argument) {
  ConfigNode node = node_of(options, argument);
  node.kind = ConfigNode::Kind::map;
  node.set("name", ConfigNode::make_scalar(name));
  Family strategy;
  read_into(node, strategy);
  return strategy;
}

}  // namespace vantage::python
