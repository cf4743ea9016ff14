#include <array>

#include "vantage/cli/reference/entry.hpp"

namespace vantage {
namespace {

struct RecordText {
  std::string_view name;
  std::string_view text;
};

constexpr auto kExitCodes = std::to_array<RecordText>({
    {"0", "done"},
    {"1",
     "a comparison or a goal failed: compare beyond tolerance, replay that differs, an episode "
     "that failed"},
    {"2", "usage or configuration: the command line, a key or a value"},
    {"3", "a file given by the user cannot be used"},
    {"4", "the simulation diverged; what there is has been written"},
    {"5", "output could not be written"},
    {"6", "no OpenGL context could be made; vantage doctor says why"},
    {"70", "internal error: a bug of ours"},
    {"130", "interrupted (SIGINT); results so far are written"},
    {"143", "terminated (SIGTERM); results so far are written"},
});

}  // namespace

std::vector<ReferenceEntry> record_entries() {
  std::vector<ReferenceEntry> entries;
  for (const auto& [name, text] : kExitCodes) {
    ReferenceEntry entry;
    entry.name = name;
    entry.place = "exit codes";
    entry.text = text;
    entries.push_back(std::move(entry));
  }
  return entries;
}

}  // namespace vantage
