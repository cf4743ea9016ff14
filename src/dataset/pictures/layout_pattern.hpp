/// Where in a path it says what a picture shows: `{object}/{view}_{kind}`.
#pragma once

#include <map>
#include <optional>
#include <regex>
#include <string>
#include <vector>

namespace vantage {

/// A pattern over paths without extension: text, `{object}`, `{category}`, `{recording}`, `{view}`,
/// `{yaw}`, `{elevation}` (degrees), `{frame}` (digits), `{kind}` and `{*}`, which is left alone.
class LayoutPattern {
 public:
  /// @throws ConfigError if a field is unknown or twice, or neither {object} nor {category} is
  /// there.
  explicit LayoutPattern(const std::string& text);

  /// What each field is in that path, but for {kind}; nothing if the path is not of the form.
  [[nodiscard]] std::optional<std::map<std::string, std::string>> match(
      const std::string& path) const;

 private:
  std::regex regex_;
  std::vector<std::string> fields_;
};

}  // namespace vantage
