#include "vantage/cli/arena/arena_command.hpp"

#include <CLI/CLI.hpp>

#include <memory>

#include "vantage/cli/arena/arena_verbs.hpp"
#include "vantage/cli/hints/text_check.hpp"

namespace vantage {
namespace {

using Arguments = std::shared_ptr<ArenaArguments>;

void add_jobs(CLI::App& app, ArenaArguments& arguments) {
  app.add_option("--jobs", arguments.jobs, "episodes at a time")
      ->check(CLI::Range(1, 1024))
      ->default_str("all cores");
  app.add_flag("--bounds", arguments.bounds,
               "also what any policy would have needed at least, of each episode");
  app.add_flag("--json", arguments.json, "print one JSON object");
}

void declare_run(CLI::App& app, ArenaArguments& arguments) {
  app.add_option("study", arguments.study, "study whose levels are planners, or an arena's folder")
      ->capture_default_str();
  app.add_option("--out", arguments.directory, "arena's folder; default out/<study>")
      ->check(not_empty);
  app.add_option("--set", arguments.overrides, "key=value for every episode")
      ->type_size(1)
      ->allow_extra_args(false);
  app.add_option("--split", arguments.split,
                 "of the study's splits, the one to run; default: the first");
  add_jobs(app, arguments);
  app.add_flag("--overwrite", arguments.overwrite, "replace a result that is there");
}

void declare_add(CLI::App& app, ArenaArguments& arguments) {
  app.add_option("dir", arguments.directory, "arena's folder")->required();
  app.add_option("name", arguments.name, "that the planner goes by")->required();
  app.add_option("command", arguments.command,
                 "after --: program and arguments, as choice.command has them")
      ->required();
  app.add_option("--timeout", arguments.timeout_s, "wall time for a decision, s")
      ->check(CLI::Range(0.01, 86400.0))
      ->capture_default_str();
  add_jobs(app, arguments);
  app.add_flag("--overwrite", arguments.overwrite,
               "replace a planner of that name, and run its episodes again");
}

void declare_page(CLI::App& app, ArenaArguments& arguments) {
  app.add_option("dir", arguments.directory, "arena's folder")->required();
  app.add_flag("--json", arguments.json, "print one JSON object");
}

struct Verb {
  const char* name;
  const char* help;
  ExitCode (*command)(const ArenaArguments&);
  void (*declare)(CLI::App&, ArenaArguments&);
};

constexpr Verb kVerbs[] = {
    {"run", "run the episodes that have no result yet, and write the page", run_arena, declare_run},
    {"add", "enter a planner, any program, and run its episodes", add_to_arena, declare_add},
    {"page", "write the page anew, of what there is", write_arena, declare_page},
};

}  // namespace

std::function<ExitCode()> declare_arena(CLI::App& app) {
  const auto arguments = std::make_shared<ArenaArguments>();
  const auto chosen = std::make_shared<ExitCode (*)(const ArenaArguments&)>(nullptr);
  app.require_subcommand(1);
  for (const Verb& verb : kVerbs) {
    CLI::App* sub = app.add_subcommand(verb.name, verb.help);
    verb.declare(*sub, *arguments);
    sub->callback([chosen, command = verb.command] { *chosen = command; });
  }
  return [arguments, chosen] { return (*chosen)(*arguments); };
}

}  // namespace vantage
