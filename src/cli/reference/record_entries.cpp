#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "vantage/cli/reference/entry.hpp"
#include "vantage/hindsight/hindsight_records.hpp"
#include "vantage/study/study_records.hpp"
#include "vantage/tasks/task.hpp"

namespace vantage {
namespace {

constexpr auto kExitCodes = std::to_array<RecordText>({
    {"exit codes", "0", "done"},
    {"exit codes", "1",
     "a comparison or a goal failed: compare beyond the tolerance, a replay that differs, an "
     "episode that failed"},
    {"exit codes", "2",
     "usage or configuration: the command line, a key or a value, YAML that is none"},
    {"exit codes", "3", "a file given by the user cannot be used"},
    {"exit codes", "4", "the simulation diverged; what there is has been written"},
    {"exit codes", "5", "output could not be written"},
    {"exit codes", "6", "no OpenGL context could be made; vantage doctor says why"},
    {"exit codes", "70", "internal error: a bug of ours; or not enough memory"},
    {"exit codes", "130", "interrupted (SIGINT); results so far are written"},
    {"exit codes", "143", "terminated (SIGTERM); results so far are written"},
});

ReferenceEntry entry_of(const RecordText& record) {
  const bool names_a_file = record.file == kRunFolder || record.file == kStudyFolder;
  return {.name = std::string(record.name),
          .place = std::string(record.file),
          .unit = names_a_file ? std::string() : unit_in_name(record.name),
          .text = std::string(record.text)};
}

/// A name of one task or of several that have it alike.
struct TaskRecord {
  RecordText record;
  std::vector<std::string_view> tasks;
};

std::vector<TaskRecord> records_of_tasks() {
  std::vector<TaskRecord> found;
  for_each_task([&]<class T>(const T&) {
    for (const RecordText& record : T::records()) {
      const auto same = std::ranges::find_if(found, [&](const TaskRecord& other) {
        return other.record.file == record.file && other.record.name == record.name &&
               other.record.text == record.text;
      });
      if (same == found.end()) {
        found.push_back({record, {T::name}});
      } else {
        same->tasks.push_back(T::name);
      }
    }
  });
  return found;
}

}  // namespace

std::vector<ReferenceEntry> record_entries() {
  std::vector<ReferenceEntry> entries;
  for (const RecordText& record : run_records()) entries.push_back(entry_of(record));
  for (const auto& [record, tasks] : records_of_tasks()) {
    entries.push_back(entry_of(record));
    entries.back().applies = {fmt::format("task: {}", fmt::join(tasks, " or "))};
  }
  for (const RecordText& record : hindsight_records()) entries.push_back(entry_of(record));
  for (const RecordText& record : study_records()) entries.push_back(entry_of(record));
  for (const RecordText& code : kExitCodes) entries.push_back(entry_of(code));
  return entries;
}

}  // namespace vantage
