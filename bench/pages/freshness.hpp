/// Whether the code that results are of has changed since, as git tells.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace vantage::bench {

enum class Freshness { fresh, stale, unknown };

/// "", " \*" or " ?"; what stands behind results in RESULTS.md.
std::string mark(Freshness freshness);

/// Results, and what they are of.
struct Origin {
  /// As recorded, "b100039" or "0.1.0 (b100039)"; "b100039-dirty": and more, never committed.
  std::set<std::string> commits = {};
  std::filesystem::path file = {};     ///< of the results, below the repository
  std::vector<std::string> code = {};  ///< files and folders that they depend on, below it
  std::vector<std::string> but = {};   ///< of those, what they do not depend on
};

/// Stale if any of the code differs between a commit and HEAD. Results without a recorded commit
/// are of code no newer than the commit that brought their file. Unknown without git or its
/// history, and of code that was never committed or recorded and is not known to have changed.
Freshness freshness_of(const Origin& origin, const std::filesystem::path& repository = ".");

}  // namespace vantage::bench
