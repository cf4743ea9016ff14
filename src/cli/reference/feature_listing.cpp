#include "vantage/cli/reference/feature_listing.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/data_root.hpp"
#include "vantage/perception/features/feature.hpp"

namespace vantage {
namespace {

using nlohmann::json;

/// With default options; what learns principal components has fewer if it learns from fewer views.
int dimension_of(const Feature& feature) {
  return std::visit(
      [](const auto& options) {
        if constexpr (requires { options.dimension(); }) return options.dimension();
        if constexpr (requires { options.words; }) return 5 * options.words;
        if constexpr (requires { options.match.components; }) return options.match.components;
        if constexpr (requires { options.components; }) return options.components;
      },
      feature);
}

/// As `bench/run features` measured it for this version; null where its results are not at hand.
json measured_figures() {
  const auto path = data_root() / "bench/results/features.json";
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return nullptr;
  const json results = json::parse(read_file(path), nullptr, false);
  return results.is_object() ? results.value("figures", json()) : json();
}

std::string key_of(std::string_view name) {
  if (name == BoundingBox::name) return "bbox_ms";
  for (const PatchKindRow& kind : kPatchKinds) {
    if (kind.name == name) return fmt::format("kernel_{}_ms", name);
  }
  return fmt::format("{}_ms", name);
}

}  // namespace

std::vector<std::string> feature_lines() {
  const json figures = measured_figures();
  std::vector<std::string> lines;
  for (const std::string_view name : strategy_names<Feature>()) {
    std::string line =
        fmt::format("{:<16}{:>5} dimensions", name, dimension_of(make_strategy<Feature>(name)));
    if (const auto found = figures.find(key_of(name)); found != figures.end()) {
      line += fmt::format("{:>8.2f} ms", found->get<double>());
    }
    lines.push_back(line);
  }
  return lines;
}

}  // namespace vantage
