#include "tests/support/trace.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

namespace vantage {
namespace {

std::string entry_text(const TraceEntry& entry) {
  if (entry.band == 0.0) return fmt::format("{} = {}", entry.key, entry.number);
  return fmt::format("{} = {} ~ {}{}", entry.key, entry.number, entry.band,
                     entry.band_is_percent ? " %" : "");
}

bool agrees(const TraceEntry& expected, const TraceEntry& actual) {
  const double allowed =
      expected.band_is_percent ? 0.01 * expected.band * std::abs(expected.number) : expected.band;
  return expected.step == actual.step && expected.key == actual.key &&
         std::abs(expected.number - actual.number) <= allowed;
}

}  // namespace

void Trace::exact(int step, std::string key, double number) {
  entries.push_back({step, std::move(key), number, 0.0, false});
}

void Trace::within(int step, std::string key, double number, double band) {
  entries.push_back({step, std::move(key), number, band, false});
}

void Trace::within_percent(int step, std::string key, double number, double percent) {
  entries.push_back({step, std::move(key), number, percent, true});
}

std::string trace_text(const Trace& trace) {
  std::string text;
  int step = -1;
  for (const TraceEntry& entry : trace.entries) {
    if (entry.step != step) text += fmt::format("step {}\n", entry.step);
    step = entry.step;
    text += "  " + entry_text(entry) + "\n";
  }
  return text;
}

Trace parse_trace(std::string_view text) {
  Trace trace;
  int step = -1;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key;
    std::string sign;
    if (!(words >> key)) continue;
    if (key == "step" && words >> step) continue;
    TraceEntry entry{.step = step, .key = key};
    if (!(words >> sign >> entry.number) || sign != "=") {
      throw std::runtime_error("trace line not understood: " + line);
    }
    if (words >> sign) {
      if (sign != "~" || !(words >> entry.band)) {
        throw std::runtime_error("trace band not understood: " + line);
      }
      entry.band_is_percent = static_cast<bool>(words >> sign) && sign == "%";
    }
    trace.entries.push_back(entry);
  }
  return trace;
}

std::string trace_difference(const Trace& expected, const Trace& actual) {
  std::string difference;
  int first_step = -1;
  const std::size_t count = std::max(expected.entries.size(), actual.entries.size());
  for (std::size_t i = 0; i < count; ++i) {
    const auto* e = i < expected.entries.size() ? &expected.entries[i] : nullptr;
    const auto* a = i < actual.entries.size() ? &actual.entries[i] : nullptr;
    if (e != nullptr && a != nullptr && agrees(*e, *a)) continue;
    const int step = (e != nullptr ? e : a)->step;
    if (first_step == -1) {
      first_step = step;
      difference = fmt::format("first difference in step {}:\n", step);
    }
    if (step != first_step) break;
    difference +=
        fmt::format("  expected {}\n  actual   {}\n", e != nullptr ? entry_text(*e) : "nothing",
                    a != nullptr ? entry_text(*a) : "nothing");
  }
  return difference;
}

}  // namespace vantage
