#include "python/kit/options.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <optional>
#include <system_error>

namespace vantage::python {
namespace {

constexpr int kDeepest = 32;

/// Whole numbers and reals of Python and numpy; empty: neither.
std::string number_text(py::handle value) {
  if (PyNumber_Check(value.ptr()) == 0 || py::hasattr(value, "__len__")) return {};  // arrays
  const bool whole = PyIndex_Check(value.ptr()) != 0;
  const auto number = py::reinterpret_steal<py::object>(whole ? PyNumber_Index(value.ptr())
                                                              : PyNumber_Float(value.ptr()));
  if (!number) {  // complex ones
    PyErr_Clear();
    return {};
  }
  return whole ? py::str(number) : py::repr(number);
}

/// Of Python or numpy.
bool is_truth(py::handle value) {
  if (py::isinstance<py::bool_>(value)) return true;
  if (!py::hasattr(value, "dtype") || py::hasattr(value, "__len__")) return false;
  return py::str(value.attr("dtype").attr("kind")).cast<std::string>() == "b";
}

ConfigNode made_of(py::handle value, const std::string& key, int depth) {
  if (depth > kDeepest) throw ConfigError(key + ": nested too deeply");
  ConfigNode node;
  if (value.is_none()) {
    node = ConfigNode{};
  } else if (is_truth(value)) {
    node = ConfigNode::make_scalar(py::bool_(py::reinterpret_borrow<py::object>(value)) ? "true"
                                                                                        : "false");
  } else if (py::isinstance<py::str>(value)) {
    node = detail::write_value(value.cast<std::string>());
  } else if (py::isinstance<py::dict>(value)) {
    node = ConfigNode::make_map();
    for (const auto& [name, entry] : py::reinterpret_borrow<py::dict>(value)) {
      if (!py::isinstance<py::str>(name)) throw ConfigError(key + ": keys are text");
      const auto text = name.cast<std::string>();
      node.set(text,
               made_of(entry, key.empty() ? text : fmt::format("{}.{}", key, text), depth + 1));
    }
  } else if (std::string number = number_text(value); !number.empty()) {
    node = ConfigNode::make_scalar(std::move(number));
  } else if (py::hasattr(value, "tolist")) {
    return made_of(value.attr("tolist")(), key, depth + 1);
  } else if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    node = ConfigNode::make_list();
    for (const py::handle item : value) node.items.push_back(made_of(item, key, depth + 1));
  } else if (py::hasattr(value, "__fspath__")) {
    node = ConfigNode::make_scalar(value.attr("__fspath__")().cast<std::string>(), true);
  } else {
    throw ConfigError(key + ": a " + std::string(py::str(py::type::of(value).attr("__name__"))) +
                      " is no option; options are None, numbers, text, lists and dicts");
  }
  node.key = key;
  return node;
}

/// None: the text is no such number, or one that does not fit.
template <class Number>
std::optional<Number> parsed(const std::string& text) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, number);
  return error == std::errc{} && stopped == end ? std::optional(number) : std::nullopt;
}

py::object scalar_of(const ConfigNode& node) {
  const std::string& text = node.scalar;
  if (node.quoted) return py::str(text);
  if (text == "true" || text == "false") return py::bool_(text == "true");
  if (const auto whole = parsed<long long>(text)) return py::int_(*whole);
  if (const auto whole = parsed<std::uint64_t>(text)) return py::int_(*whole);
  if (const auto real = parsed<double>(text)) return py::float_(*real);
  return py::str(text);
}

}  // namespace

ConfigNode node_of(py::handle value, const std::string& name) { return made_of(value, name, 0); }

py::object object_of(const ConfigNode& node) {
  switch (node.kind) {
    case ConfigNode::Kind::null: return py::none();
    case ConfigNode::Kind::scalar: return scalar_of(node);
    case ConfigNode::Kind::list: {
      py::list list;
      for (const ConfigNode& item : node.items) list.append(object_of(item));
      return list;
    }
    case ConfigNode::Kind::map: break;
  }
  py::dict dict;
  for (const auto& [name, entry] : node.entries) dict[py::str(name)] = object_of(entry);
  return dict;
}

}  // namespace vantage::python
