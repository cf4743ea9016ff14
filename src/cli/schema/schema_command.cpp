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
  struct Arguments {
    std::string kind;
    bool json = false;  ///< it is JSON in any case
  };
  auto arguments = std::make_shared<Arguments>();
  app.add_option("kind", arguments->kind, "of file, one of: " + schema_kinds_text())->required();
  app.add_flag("--json", arguments->json, "print one JSON object");
  return [arguments] {
    fmt::print("{}", json_text(file_schema(arguments->kind)));
    return ExitCode::done;
  };
}

}  // namespace vantage
