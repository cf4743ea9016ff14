#include "bench/measures.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vantage_commit.hpp>

#include <cmath>
#include <fstream>

#include "vantage/core/hash.hpp"

namespace vantage::bench {
namespace {

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

/// Central second moments, up to the number of points.
struct Moments {
  double aa = 0.0;
  double ab = 0.0;
  double bb = 0.0;
};

Moments moments(std::span<const double> a, std::span<const double> b) {
  const auto count = static_cast<double>(a.size());
  const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / count;
  const double mean_b = std::accumulate(b.begin(), b.end(), 0.0) / count;
  Moments m;
  for (std::size_t i = 0; i < a.size(); ++i) {
    m.aa += (a[i] - mean_a) * (a[i] - mean_a);
    m.ab += (a[i] - mean_a) * (b[i] - mean_b);
    m.bb += (b[i] - mean_b) * (b[i] - mean_b);
  }
  return m;
}

}  // namespace

std::vector<double> ranks(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
  std::vector<double> result(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    for (std::size_t i = begin; i < end; ++i) {
      result[order[i]] = 0.5 * static_cast<double>(begin + end - 1);
    }
    begin = end;
  }
  return result;
}

double spearman(std::span<const double> a, std::span<const double> b) {
  const Moments m = moments(ranks(a), ranks(b));
  return m.aa > 0.0 && m.bb > 0.0 ? m.ab / std::sqrt(m.aa * m.bb) : 1.0;
}

double slope(std::span<const double> x, std::span<const double> y) {
  const Moments m = moments(x, y);
  return m.ab / m.aa;
}

void print_figures(const std::string& name, int threads, const std::string& configuration,
                   const std::vector<std::pair<std::string, double>>& figures) {
  nlohmann::ordered_json object;
  object["name"] = name;
  object["commit"] = VANTAGE_GIT_COMMIT;
  object["config_hash"] = hash_text(hash_bytes(configuration));
  object["cpu"] = cpu_name();
  object["threads"] = threads;
  object["figures"] = nlohmann::ordered_json::object();
  for (const auto& [key, figure] : figures) object["figures"][key] = figure;
  fmt::print("{}\n", object.dump());
}

}  // namespace vantage::bench
