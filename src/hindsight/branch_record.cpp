#include "vantage/hindsight/branch_record.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "vantage/core/atomic_file.hpp"
#include "vantage/report/json_file.hpp"
#include "vantage/runtime/json.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

double cells_of(const Branch& branch) { return static_cast<double>(branch.cells.value_or(0)); }

double rate_of(const Branch& branch) {
  return branch.seconds > 0.0 ? cells_of(branch) / branch.seconds : 0.0;
}

Json branch_json(const Branch& branch) {
  const auto or_null = [](const auto& value) { return value ? Json(*value) : Json(); };
  return {{"view", branch.view},
          {"chosen", branch.chosen},
          {"gain", branch.gain},
          {"planned_m", or_null(branch.planned_m)},
          {"fallback", branch.fallback},
          {"new_cells", or_null(branch.cells)},
          {"seconds", branch.seconds},
          {"way_m", branch.way_m},
          {"new_cells_then", or_null(branch.cells_then)},
          {"seconds_then", branch.seconds_then}};
}

Json regret_json(const std::optional<Regret>& regret) {
  if (!regret) return nullptr;
  return {{"best_view", regret->best_view},
          {"cells", regret->cells},
          {"fastest_view", regret->fastest_view},
          {"cells_per_s", regret->cells_per_s}};
}

}  // namespace

std::optional<Regret> regret_of(const BranchedDecision& decision) {
  const auto& branches = decision.branches;
  const auto chosen = std::ranges::find_if(branches, &Branch::chosen);
  if (chosen == branches.end() || !chosen->cells) return std::nullopt;
  const auto best = std::ranges::max_element(branches, {}, cells_of);
  const auto fastest = std::ranges::max_element(branches, {}, rate_of);
  return Regret{best->view, cells_of(*best) - cells_of(*chosen), fastest->view,
                rate_of(*fastest) - rate_of(*chosen)};
}

Json branched_json(const BranchedDecision& decision) {
  Json json = {{"scan", decision.scan},
               {"then", decision.then},
               {"gain_unit", decision.gain_unit},
               {"regret", regret_json(regret_of(decision))},
               {"branches", Json::array()}};
  for (const Branch& branch : decision.branches) json["branches"].push_back(branch_json(branch));
  return json;
}

std::string branched_text(const BranchedDecision& decision) {
  std::string text = fmt::format(
      "decision after scan {}; new cells are of those that can be observed\n"
      "  view  {:>12}  new cells  seconds   way m   cells/s\n",
      decision.scan, decision.gain_unit);
  for (const Branch& branch : decision.branches) {
    text += fmt::format("{} {:>4}  {:>12.1f}  {:>9}  {:>7.1f}  {:>6.2f}  {:>8.1f}{}\n",
                        branch.chosen ? '*' : ' ', branch.view, branch.gain,
                        branch.cells ? std::to_string(*branch.cells) : "none", branch.seconds,
                        branch.way_m, rate_of(branch), branch.fallback ? "  not reached" : "");
  }
  if (const auto regret = regret_of(decision)) {
    text +=
        fmt::format("regret: {:.0f} cells (best view {}), {:.1f} cells/s (fastest view {})\n",
                    regret->cells, regret->best_view, regret->cells_per_s, regret->fastest_view);
  }
  return text;
}

namespace {

/// Of a decision in the file; 0 if it is of another kind.
std::uint64_t scan_of(const Json& decision) {
  const bool told = decision.is_object() && decision.contains("scan");
  return told && decision["scan"].is_number_unsigned() ? decision["scan"].get<std::uint64_t>() : 0;
}

}  // namespace

void keep_branches(const std::filesystem::path& run_dir,
                   const std::vector<BranchedDecision>& decisions) {
  const auto path = run_dir / "branches.json";
  Json kept = Json::object();
  if (std::filesystem::exists(path)) kept = json_object_or_null<Json>(read_file(path));
  if (!kept.is_object() || !kept.contains("decisions") || !kept["decisions"].is_array()) {
    kept = {{"decisions", Json::array()}};
  }
  std::vector<Json> all;
  for (const Json& known : kept["decisions"]) {
    const bool replaced = std::ranges::any_of(
        decisions, [&](const BranchedDecision& d) { return scan_of(known) == d.scan; });
    if (!replaced) all.push_back(known);
  }
  for (const BranchedDecision& decision : decisions) all.push_back(branched_json(decision));
  std::ranges::stable_sort(all, {}, scan_of);
  kept["decisions"] = all;
  write_file(path, json_text(kept));
}

}  // namespace vantage
