/// What the names in a run folder mean: files, columns of tables, keys of metrics.json.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace vantage {

/// A file of the run folder where `name` is the file's, else one of its columns or keys: dotted, of
/// the elements of a list key[]. What differs from run to run stands in <>.
struct RecordText {
  std::string_view file;
  std::string_view name;
  std::string_view text;
};
using RecordTexts = std::vector<RecordText>;

inline constexpr std::string_view kRunFolder = "run folder";

/// Of every run folder, whatever its task.
RecordTexts run_records();

/// `first`, then `more`.
RecordTexts joined(RecordTexts first, std::span<const RecordText> more);

}  // namespace vantage
