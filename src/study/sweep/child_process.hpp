/// Episodes of a study are processes of their own: one that crashes takes no other with it.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vantage {

/// Runs this very program with `arguments`; stdin is closed, stdout and stderr go to `output`. The
/// child is killed when this process ends, however it ends: no orphan writes into a folder that the
/// next sweep has taken over.
/// @throws OutputError if `output` cannot be written or the system refuses a process.
pid_t start_self(const std::vector<std::string>& arguments, const std::filesystem::path& output);

struct ChildEnd {
  pid_t pid = 0;
  int exit_code = 0;  ///< 128 + the signal that killed it
};
/// A child that has ended since the last call, if any.
std::optional<ChildEnd> poll_child();

}  // namespace vantage
