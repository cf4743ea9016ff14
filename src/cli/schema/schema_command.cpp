#include "vantage/cli/schema/schema_command.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <string>

#include "vantage/cli/schema/file_schemas.hpp"
#include "vantage/runtime/json.hpp"

namespace vantage {

std::function<ExitCode()> declare_schema(CLI::App& app) {
  auto kind = std::make_shared<std::string>();
  app.add_option("kind", *kind, "of file, one of: " + schema_kinds_text())->required();
  return [kind] {
    fmt::print("{}", json_text(file_schema(*kind)));
    return ExitCode::done;
  };
}

}  // namespace vantage
