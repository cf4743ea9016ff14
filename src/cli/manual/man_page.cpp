#include "vantage/cli/manual/man_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string page_name(const std::string& command) {
  std::string name = "vantage-" + command;
  std::ranges::replace(name, ' ', '-');
  return name;
}

std::string heading(const std::string& name, const ManualFrame& frame) {
  return fmt::format(".TH \"{}\" \"1\" \"\" \"vantage {}\" \"User Commands\"\n", upper(name),
                     roff_text(frame.version));
}

std::string section(const char* title, const std::string& body) {
  return body.empty() ? body : fmt::format(".SH {}\n{}", title, body);
}

std::string paragraph(const std::string& text) {
  return text.empty() ? text : fmt::format(".PP\n{}\n", roff_text(text));
}

/// A bold name, and what it is.
std::string item(const std::string& name, const std::string& text) {
  return fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff_text(name), roff_text(text));
}

std::string literal(const std::string& text) {
  return text.empty() ? text : fmt::format(".PP\n.nf\n{}\n.fi\n", roff_text(text));
}

/// What stands for the value of an option.
std::string value_name(const OptionText& option) {
  if (option.text.starts_with("key=value")) return "key=value";
  std::string name = option.names.back();
  name.erase(0, name.find_first_not_of('-'));
  return upper(name);
}

std::string option_item(const OptionText& option) {
  std::string names = fmt::format("{}", fmt::join(option.names, ", "));
  if (option.takes_value && !option.positional) names += " " + value_name(option);
  std::string text = option.text;
  if (option.required && !option.positional) text += " (required)";
  if (!option.default_value.empty()) text += fmt::format(" (default: {})", option.default_value);
  return item(names, text);
}

std::string option_items(const CommandText& command) {
  std::string items;
  for (const bool positional : {true, false}) {
    for (const OptionText& option : command.options) {
      if (option.positional == positional) items += option_item(option);
    }
  }
  return items;
}

/// "vantage run [OPTIONS] [episode]"
std::string synopsis(const CommandText& command) {
  std::string line = "vantage " + command.name;
  for (const OptionText& option : command.options) {
    if (option.required && !option.positional) {
      line += fmt::format(" {} {}", option.names.back(), value_name(option));
    }
  }
  line += " [OPTIONS]";
  for (const OptionText& option : command.options) {
    if (!option.positional) continue;
    const std::string name = option.names.front() + (option.repeats ? " ..." : "");
    line += option.required ? " " + name : fmt::format(" [{}]", name);
  }
  return fmt::format(".PP\n.B {}\n", roff_text(line));
}

std::string part_text(const CommandText& part) {
  return fmt::format(".SS \"vantage {}\"\n{}{}{}{}", roff_text(part.name), synopsis(part),
                     paragraph(part.text), option_items(part), literal(part.footer));
}

std::string exit_status(const ManualFrame& frame) {
  std::string items;
  for (const auto& [code, meaning] : frame.exit_status) items += item(code, meaning);
  return section("EXIT STATUS", items);
}

std::string see_also(const std::vector<std::string>& names) {
  std::vector<std::string> pages;
  for (const std::string& name : names)
    pages.push_back(fmt::format("\\fB{}\\fR(1)", roff_text(name)));
  return section("SEE ALSO", fmt::format("{}\n", fmt::join(pages, ", ")));
}

std::string name_line(const std::string& name, const std::string& text) {
  return section("NAME", fmt::format("{} \\- {}\n", roff_text(name), roff_text(text)));
}

}  // namespace

std::string roff_text(const std::string& text) {
  std::string made;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && (c == '.' || c == '\'')) made += "\\&";
    at_start = c == '\n';
    if (c == '\\') {
      made += "\\e";
    } else if (c == '-' || c == '\'' || c == '`' || c == '^' || c == '~') {
      made += c == '-'    ? "\\-"
              : c == '\'' ? "\\(aq"
              : c == '`'  ? "\\(ga"
              : c == '^'  ? "\\(ha"
                          : "\\(ti";
    } else {
      made += c;
    }
  }
  return made;
}

std::string command_page(const CommandText& command, const ManualFrame& frame) {
  std::string synopses = command.parts.empty() ? synopsis(command) : std::string();
  std::string parts;
  for (const CommandText& part : command.parts) {
    synopses += synopsis(part);
    parts += part_text(part);
  }
  return heading(page_name(command.name), frame) +
         name_line(page_name(command.name), command.text) + section("SYNOPSIS", synopses) +
         section("OPTIONS", option_items(command)) + section("COMMANDS", parts) +
         section("NOTES", literal(command.footer)) + exit_status(frame) + see_also({"vantage"});
}

std::string program_page(const std::vector<CommandText>& commands, const ManualFrame& frame) {
  std::string items;
  std::vector<std::string> pages;
  for (const CommandText& command : commands) {
    pages.push_back(page_name(command.name));
    items += item(command.name, command.text);
  }
  return heading("vantage", frame) + name_line("vantage", frame.summary) +
         section("SYNOPSIS", ".PP\n.B vantage COMMAND [OPTIONS]\n") +
         section("DESCRIPTION",
                 paragraph("Each command has a page of its own, vantage-COMMAND(1), and says the "
                           "same with --help. Results are on standard output, progress and "
                           "messages on standard error.")) +
         section("COMMANDS", items) +
         section("OPTIONS", item("-h, --help", "print how it is used and exit") +
                                item("--version", "print the version and exit")) +
         section(
             "ENVIRONMENT",
             item("VANTAGE_DATA", "folder of models and assets, in place of the installed one") +
                 item(
                     "NO_COLOR",
                     "unless empty: no colours and no progress bar on a terminal, lines instead")) +
         section("FILES", item("/usr/share/vantage",
                               "scenes, robots, episodes and studies; they are found from any "
                               "folder by their names below it")) +
         exit_status(frame) + see_also(pages);
}

void write_manual(const std::vector<CommandText>& commands, const ManualFrame& frame,
                  const std::filesystem::path& directory) {
  make_writable_directory(directory);
  write_file(directory / "vantage.1", program_page(commands, frame));
  for (const CommandText& command : commands) {
    write_file(directory / (page_name(command.name) + ".1"), command_page(command, frame));
  }
}

}  // namespace vantage
