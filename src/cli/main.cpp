#include <CLI/CLI.hpp>
#include <malloc.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <new>
#include <string_view>
#include <system_error>

#include "vantage/cli/commands.hpp"
#include "vantage/cli/common_flags.hpp"
#include "vantage/cli/dataset_commands.hpp"
#include "vantage/cli/hints/suggestion.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/log.hpp"
#include "vantage/dataset/render_worker.hpp"
#include "vantage/runtime/manifest.hpp"

namespace {

int exit_code(vantage::ExitCode code) { return static_cast<int>(code); }

/// What is printed is in a buffer until here. @throws OutputError
int printed(int code) {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw vantage::OutputError("stdout: cannot write");
  }
  return code;
}

/// "vantage sweep run": what was asked for, as far as it was understood.
std::string command_of(const CLI::App& app) {
  const auto subs = app.get_subcommands();
  return subs.empty() ? app.get_name() : app.get_name() + " " + command_of(*subs.front());
}

int run_command_line(int argc, char** argv) {
  CLI::App app{"Vantage: robots that choose their next action by how much they will learn from it"};
  app.name("vantage");
  app.require_subcommand(0, 1);
  app.set_version_flag("--version", vantage::version_text());
  std::function<vantage::ExitCode()> chosen;
  for (const vantage::Command& command : vantage::commands()) {
    CLI::App* sub = app.add_subcommand(std::string(command.name), std::string(command.help));
    auto action = command.declare(*sub);
    vantage::add_common_flags(*sub);
    sub->callback([&chosen, action] { chosen = action; });
  }
  const std::vector<std::string> words = vantage::with_every_set({argv + 1, argv + argc});
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return printed(app.exit(error));
    const auto unknown = vantage::unknown_command(app, words);
    std::fprintf(stderr, "error: %s\n%s --help shows how it is used\n",
                 unknown ? unknown->c_str() : error.what(), command_of(app).c_str());
    return exit_code(vantage::ExitCode::usage);
  }
  if (!chosen) {
    std::fputs(app.help().c_str(), stderr);
    return exit_code(vantage::ExitCode::usage);
  }
  return printed(exit_code(chosen()));
}

int fail(vantage::ExitCode code, const std::string& message) {
  vantage::log_error(message);
  vantage::log_to_file({});
  return exit_code(code);
}

int fail_internally(const std::exception& error) {
  return fail(vantage::ExitCode::internal, std::string("internal error: ") + error.what());
}

/// What is freed stays with the process: a decision in an office makes 70 MB of tables anew, and
/// their pages, asked of the kernel each time, are 5 % of the episode.
void keep_freed_memory() {
  constexpr int kBytes = 1 << 30;
  if (mallopt(M_MMAP_THRESHOLD, kBytes) == 1) mallopt(M_TRIM_THRESHOLD, kBytes);
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit is a write error like any other
  keep_freed_memory();
  vantage::remember_command_line(argc, argv);
  try {
    // What `vantage dataset render` and `vantage train --recipe` start to render by; not for
    // people.
    if (argc == 2 && std::string_view(argv[1]) == vantage::kRenderWorker) {
      return exit_code(vantage::serve_rendering(STDIN_FILENO));
    }
    return run_command_line(argc, argv);
  } catch (const vantage::Error& error) {
    return fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(vantage::ExitCode::internal, "not enough memory");
  } catch (const std::filesystem::filesystem_error& error) {
    // Files that are read throw InputError by themselves: what is left are places for output.
    const std::string path = error.path1().string();
    return fail(vantage::ExitCode::output,
                path.empty() ? error.what() : path + ": " + error.code().message());
  } catch (const std::system_error& error) {
    if (std::ferror(stdout) == 0) return fail_internally(error);
    return fail(vantage::ExitCode::output, "stdout: cannot write: " + error.code().message());
  } catch (const std::exception& error) {
    return fail_internally(error);
  }
}
