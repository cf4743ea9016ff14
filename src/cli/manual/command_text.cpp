#include "vantage/cli/manual/command_text.hpp"

#include <CLI/CLI.hpp>

#include <utility>

namespace vantage {
namespace {

OptionText option_text(const CLI::Option& option) {
  OptionText text{.text = option.get_description(),
                  .default_value = option.get_default_str(),
                  .positional = option.get_positional(),
                  .takes_value = option.get_items_expected_max() > 0,
                  .required = option.get_required()};
  for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  if (text.positional) text.names = {option.get_name()};
  text.repeats = option.get_items_expected_max() > 1;
  return text;
}

}  // namespace

CommandText command_text(const std::string& name, CLI::App& app) {
  CommandText text{.name = name, .text = app.get_description(), .footer = app.get_footer()};
  for (const CLI::Option* option : app.get_options()) text.options.push_back(option_text(*option));
  for (CLI::App* part : app.get_subcommands({})) {
    text.parts.push_back(command_text(name + " " + part->get_name(), *part));
  }
  return text;
}

}  // namespace vantage
