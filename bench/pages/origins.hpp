/// Of what code and on what machine results are.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "vantage/report/report_data.hpp"

namespace vantage::bench {

/// Where a benchmark ran.
struct BenchmarkOrigin {
  std::string commit;       ///< with its mark
  std::string config_hash;  ///< of what was measured; "" of files that were written before it was
  int threads = 0;
  std::string cpu;
};
using Origins = std::map<std::string, BenchmarkOrigin>;

/// The commit with a mark where the code that the benchmark depends on has changed since.
/// @throws InputError if a path of that code is not there: what it became is not known to be the
/// same
std::string marked_commit(const std::string& benchmark, const std::string& commit,
                          const std::filesystem::path& file,
                          const std::filesystem::path& repository = ".");

/// The different entries of a column, "" left out; none if there is no such file or column.
std::set<std::string> entries_of(const std::filesystem::path& csv, const std::string& column);

/// What the episodes of table tops and explorations depend on: files and folders, and of those what
/// they do without, as recognition.
const std::vector<std::string>& mapping_code();
const std::vector<std::string>& mapping_does_without();

/// What a file of YAML says of itself before its first key; "" if nothing.
std::string opening_comment(const std::filesystem::path& yaml);

/// "b100039, c29a3d1 \*", or that it is not recorded.
/// @param file whose history tells it then
/// @param mapping of episodes of mapping tasks alone
std::string commits_text(const std::set<std::string>& commits, const std::filesystem::path& file,
                         bool mapping = false);

}  // namespace vantage::bench
