#include "vantage/cli/hints/folder.hpp"

#include <fmt/format.h>

#include "vantage/core/error.hpp"
#include "vantage/study/study_page.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

bool is_run_folder(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / "config.yaml", error);
}

[[noreturn]] void refuse(const fs::path& folder, std::string_view what) {
  throw InputError(fmt::format("{}: {}", folder.string(), what));
}

void require_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) refuse(folder, "no such folder");
  if (!fs::is_directory(folder, error)) refuse(folder, "a file; this takes a folder of results");
}

}  // namespace

void require_run_folder(const fs::path& folder) {
  require_folder(folder);
  if (is_run_folder(folder)) return;
  if (is_study_folder(folder)) {
    refuse(folder, "the folder of a study; its runs are the folders below episodes/ in it");
  }
  refuse(folder, "not a run folder, it has no config.yaml; vantage run writes one");
}

void require_study_folder(const fs::path& folder) {
  require_folder(folder);
  if (is_study_folder(folder)) return;
  if (is_run_folder(folder)) refuse(folder, "the folder of a run, not of a study");
  refuse(folder, "not the folder of a study, it has no study.yaml; vantage sweep run writes one");
}

void require_result_folder(const fs::path& folder) {
  require_folder(folder);
  if (is_run_folder(folder) || is_study_folder(folder)) return;
  refuse(folder,
         "the folder of neither a run nor a study: it has no config.yaml, as vantage run writes, "
         "and no study.yaml, as vantage sweep run does");
}

}  // namespace vantage
