/// What benchmarks share: medians of timings, rank correlation, the JSON object they print.
#pragma once

#include <algorithm>
#include <chrono>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "vantage/core/error.hpp"
#include "vantage/core/log.hpp"

namespace vantage::bench {

/// Median wall time of `work` over `repeats` calls, ms.
template <class Work>
double median_ms(int repeats, Work&& work) {
  std::vector<double> times_ms;
  for (int i = 0; i < repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    times_ms.push_back(taken.count());
  }
  const auto middle = times_ms.begin() + repeats / 2;
  std::ranges::nth_element(times_ms, middle);
  return *middle;
}

/// Ranks from 0, equal values share the mean of theirs.
std::vector<double> ranks(std::span<const double> values);
/// Rank correlation [Spearman1904]; 1 where one side is constant.
double spearman(std::span<const double> a, std::span<const double> b);

/// Of the least-squares line through points (x, y).
double slope(std::span<const double> x, std::span<const double> y);

/// One line of JSON: {name, commit, config_hash, cpu, threads, figures}.
/// @param configuration YAML of what is measured, episodes or strategies with their options; its
///     hash is printed
void print_figures(const std::string& name, int threads, const std::string& configuration,
                   const std::vector<std::pair<std::string, double>>& figures);

/// Exit code of a benchmark; user errors are told.
template <class Benchmark>
int run_main(Benchmark&& benchmark) {
  try {
    benchmark();
    return 0;
  } catch (const Error& error) {
    log_error(error.what());
    return static_cast<int>(error.code());
  }
}

}  // namespace vantage::bench
