#include "vantage/dataset/pictures/layout_pattern.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

const std::map<std::string, std::string>& forms() {
  static const std::map<std::string, std::string> all{{"object", "([^/]+?)"},
                                                      {"category", "([^/]+?)"},
                                                      {"recording", "([^/]+?)"},
                                                      {"view", "([^/]+?)"},
                                                      {"yaw", "(-?[0-9]+(?:\\.[0-9]+)?)"},
                                                      {"elevation", "(-?[0-9]+(?:\\.[0-9]+)?)"},
                                                      {"frame", "([0-9]+)"},
                                                      {"kind", "([A-Za-z]*)"},
                                                      {"*", "([^/]*?)"}};
  return all;
}

}  // namespace

LayoutPattern::LayoutPattern(const std::string& text) {
  std::string regex;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t close = text[i] == '{' ? text.find('}', i) : std::string::npos;
    if (close == std::string::npos) {
      const bool letter = std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_';
      regex += letter ? std::string(1, text[i]) : std::string("\\") + text[i];
      ++i;
      continue;
    }
    const std::string field = text.substr(i + 1, close - i - 1);
    const auto form = forms().find(field);
    if (form == forms().end()) {
      throw ConfigError(
          fmt::format("--layout: unknown {{{}}}; known: object, category, recording, view, yaw, "
                      "elevation, frame, kind, *",
                      field));
    }
    if (field != "*" && std::ranges::find(fields_, field) != fields_.end()) {
      throw ConfigError(fmt::format("--layout: {{{}}} appears twice", field));
    }
    fields_.push_back(field);
    regex += form->second;
    i = close + 1;
  }
  const auto has = [&](const char* field) {
    return std::ranges::find(fields_, field) != fields_.end();
  };
  if (!has("object") && !has("category")) {
    throw ConfigError("--layout: needs {object}, the place of the object's name");
  }
  regex_ = std::regex(regex);
}

std::optional<std::map<std::string, std::string>> LayoutPattern::match(
    const std::string& path) const {
  std::smatch found;
  if (!std::regex_match(path, found, regex_)) return std::nullopt;
  std::map<std::string, std::string> values;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (fields_[i] != "kind" && fields_[i] != "*") values[fields_[i]] = found[i + 1];
  }
  return values;
}

}  // namespace vantage
