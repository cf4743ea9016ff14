#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "vantage/hindsight/run_bound.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

Json progress_json(const std::optional<ShareReached>& progress) {
  if (!progress) return nullptr;
  return {{"scans", progress->scans}, {"way_m", progress->way_m}, {"time_s", progress->time_s}};
}

Json ratios_json(const std::optional<ShareReached>& of, const std::optional<ShareReached>& to) {
  if (!of || !to) return nullptr;
  const auto ratio = [](double a, double b) { return b > 0.0 ? Json(a / b) : Json(); };
  return {{"scans", ratio(static_cast<double>(of->scans), static_cast<double>(to->scans))},
          {"way_m", ratio(of->way_m, to->way_m)},
          {"time_s", ratio(of->time_s, to->time_s)}};
}

Json share_json(const ShareBound& share) {
  return {
      {"percent", share.percent},
      {"run", progress_json(share.run)},
      {"least", progress_json(share.least)},
      {"exact",
       {{"scans", share.exact_scans}, {"way_m", share.exact_way}, {"time_s", share.exact_time}}},
      {"given_cells", share.given_cells},
      {"run_over_least", ratios_json(share.run, share.least)},
      {"oracle_tour", progress_json(share.oracle_tour)},
      {"run_over_oracle_tour", ratios_json(share.run, share.oracle_tour)}};
}

std::string row(std::string_view what, const std::optional<ShareReached>& progress) {
  if (!progress) return fmt::format("  {:<12} {:>6}\n", what, "never");
  return fmt::format("  {:<12} {:>6} {:>9.2f} {:>9.1f}\n", what, progress->scans, progress->way_m,
                     progress->time_s);
}

/// Of nothing there is none.
std::string quotient_text(double of, double to) {
  return to > 0.0 ? fmt::format("{:.2f}", of / to) : "-";
}

std::string ratio_row(std::string_view what, const std::optional<ShareReached>& of,
                      const std::optional<ShareReached>& to) {
  if (!of || !to) return {};
  return fmt::format("  {:<12} {:>6} {:>9} {:>9}\n", what,
                     quotient_text(static_cast<double>(of->scans), static_cast<double>(to->scans)),
                     quotient_text(of->way_m, to->way_m), quotient_text(of->time_s, to->time_s));
}

std::optional<ShareReached> progress_of(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return ShareReached{json.at("scans"), json.at("way_m"), json.at("time_s")};
}

}  // namespace

void keep_oracle_tour(const Json& former, RunBound& bound) {
  if (!former.is_object() || !former.value("has_oracle_tour", false)) return;
  bound.has_oracle_tour = true;
  for (ShareBound& share : bound.shares) {
    for (const Json& told : former.at("shares")) {
      if (told.at("percent") == share.percent) {
        share.oracle_tour = progress_of(told.at("oracle_tour"));
      }
    }
  }
}

Json run_bound_json(const RunBound& bound) {
  Json json = {{"poses", bound.poses},
               {"observable_cells", bound.observable_cells},
               {"speed_m_s", bound.speed_m_s},
               {"scan_s", bound.scan_s},
               {"first_scan", progress_json(bound.first_scan)},
               {"has_oracle_tour", bound.has_oracle_tour},
               {"shares", Json::array()}};
  for (const ShareBound& share : bound.shares) json["shares"].push_back(share_json(share));
  return json;
}

std::string run_bound_text(const RunBound& bound) {
  std::string text =
      fmt::format("any policy, from {} poses, at {} m/s at most, with scans of {:.1f} s at least\n",
                  bound.poses, bound.speed_m_s, bound.scan_s);
  for (const ShareBound& share : bound.shares) {
    text += fmt::format("{} % observed      scans     way m    time s\n", share.percent);
    text += row("run", share.run);
    if (bound.has_oracle_tour) text += row("oracle_tour", share.oracle_tour);
    text += row("at least", share.least);
    text += ratio_row("run / least", share.run, share.least);
    text += ratio_row("run / oracle", share.run, share.oracle_tour);
  }
  return text;
}

}  // namespace vantage
