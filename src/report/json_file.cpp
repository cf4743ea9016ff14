#include "vantage/report/json_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr int kMaxDepth = 64;

}  // namespace

template <class Json>
Json parsed_json(std::string_view text, const std::string& name) {
  const auto not_too_deep = [&](int depth, typename Json::parse_event_t, Json&) {
    if (depth <= kMaxDepth) return true;
    throw InputError(
        fmt::format("{}: not valid JSON: nested deeper than {} levels", name, kMaxDepth));
  };
  try {
    return Json::parse(text, not_too_deep);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: not valid JSON: {}", name, error.what()));
  }
}

template <class Json>
Json json_object_or_null(std::string_view text) {
  try {
    Json json = parsed_json<Json>(text, "");
    return json.is_object() ? json : Json(nullptr);
  } catch (const InputError&) {
    return nullptr;
  }
}

template nlohmann::json parsed_json(std::string_view, const std::string&);
template nlohmann::ordered_json parsed_json(std::string_view, const std::string&);
template nlohmann::json json_object_or_null(std::string_view);
template nlohmann::ordered_json json_object_or_null(std::string_view);

}  // namespace vantage
