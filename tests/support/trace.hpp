/// Readable traces of episodes: what golden tests compare.
///
///   step 2
///     chosen_view = 17
///     unobserved_cells = 61234 ~ 2 %
///     precision = 0.97 ~ 0.02
///
/// A number without a band must be met exactly.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vantage {

struct TraceEntry {
  int step = 0;
  std::string key;
  double number = 0.0;
  double band = 0.0;             ///< allowed deviation, 0: exact
  bool band_is_percent = false;  ///< of the expected number
};

struct Trace {
  std::vector<TraceEntry> entries;
  void exact(int step, std::string key, double number);
  void within(int step, std::string key, double number, double band);
  void within_percent(int step, std::string key, double number, double percent);
};

std::string trace_text(const Trace& trace);
/// @throws std::runtime_error naming the line that cannot be read.
Trace parse_trace(std::string_view text);

/// Empty if `actual` keeps to `expected` and its bands; else the first step that differs and, for
/// each of its lines that differ, expected and actual.
std::string trace_difference(const Trace& expected, const Trace& actual);

}  // namespace vantage
