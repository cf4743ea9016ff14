#include "vantage/dataset/pictures/view_directions.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <set>
#include <utility>

namespace vantage {
namespace {

constexpr int kUsualBins = 8;
constexpr std::size_t kFewAngles = 12;
constexpr int kMaxBins = 36;
constexpr double kSameAngle_deg = 2.0;
constexpr double kOffMiddle = 0.1;  ///< of a bin, that an angle may be beside its middle

std::string letters_of(std::string_view name) {
  std::string letters;
  for (const char c : name) {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (c != '_' && c != '-' && c != ' ' && c != '.') {
      return {};
    }
  }
  for (const std::string_view ending : {"view", "side"}) {
    if (letters.size() > ending.size() && letters.ends_with(ending)) {
      letters.resize(letters.size() - ending.size());
    }
  }
  return letters;
}

std::optional<double> yaw_of(const std::string& letters) {
  constexpr std::array<std::pair<std::string_view, double>, 21> kYaw{{
      {"front", 0.0},       {"back", 180.0},      {"rear", 180.0},       {"behind", 180.0},
      {"left", 270.0},      {"right", 90.0},      {"frontleft", 315.0},  {"leftfront", 315.0},
      {"frontright", 45.0}, {"rightfront", 45.0}, {"backleft", 225.0},   {"leftback", 225.0},
      {"backright", 135.0}, {"rightback", 135.0}, {"rearleft", 225.0},   {"leftrear", 225.0},
      {"rearright", 135.0}, {"rightrear", 135.0}, {"behindleft", 225.0}, {"behindright", 135.0},
      {"forward", 0.0},
  }};
  const auto found = std::ranges::find(kYaw, letters, &std::pair<std::string_view, double>::first);
  if (found == kYaw.end()) return std::nullopt;
  return found->second;
}

}  // namespace

std::optional<NamedDirection> named_direction(std::string_view name) {
  const std::string letters = letters_of(name);
  if (const auto yaw_deg = yaw_of(letters))
    return NamedDirection{.yaw_deg = yaw_deg, .elevation_deg = {}};
  if (letters == "top" || letters == "above" || letters == "up") {
    return NamedDirection{.yaw_deg = {}, .elevation_deg = 90.0};
  }
  if (letters == "bottom" || letters == "below" || letters == "down") {
    return NamedDirection{.yaw_deg = {}, .elevation_deg = -90.0};
  }
  return std::nullopt;
}

int bins_for(const std::vector<double>& yaws_deg) {
  std::vector<double> distinct;
  for (const double yaw : yaws_deg) {
    const bool known = std::ranges::any_of(distinct, [&](double other) {
      return std::abs(std::remainder(yaw - other, 360.0)) < kSameAngle_deg;
    });
    if (!known) distinct.push_back(yaw);
  }
  if (distinct.size() < 2 || distinct.size() > kFewAngles) return kUsualBins;
  for (int bins = static_cast<int>(distinct.size()); bins <= kMaxBins; ++bins) {
    const double bin_deg = 360.0 / bins;
    const bool fits = std::ranges::all_of(distinct, [&](double yaw) {
      return std::abs(std::remainder(yaw, bin_deg)) <= kOffMiddle * bin_deg;
    });
    if (fits) return bins;
  }
  return kUsualBins;
}

Directions directions_of_names(const std::vector<std::string>& names) {
  const std::set<std::string> distinct(names.begin(), names.end());
  Directions directions;
  std::vector<std::pair<double, std::string>> order;  // by yaw, those without after
  std::vector<double> yaws_deg;
  for (const std::string& name : distinct) {
    const auto named = named_direction(name);
    const bool angle = named && named->yaw_deg;
    if (angle) yaws_deg.push_back(*named->yaw_deg);
    order.emplace_back(angle ? *named->yaw_deg : 1000.0, name);
  }
  std::ranges::sort(order);
  const std::set<double> different(yaws_deg.begin(), yaws_deg.end());
  directions.degrees = different.size() == distinct.size();
  directions.bins = directions.degrees ? bins_for(yaws_deg) : static_cast<int>(distinct.size());
  directions.bins = std::max(directions.bins, 2);
  directions.names.resize(static_cast<std::size_t>(directions.bins));
  const double bin_deg = 360.0 / directions.bins;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double yaw_deg = directions.degrees ? order[i].first : static_cast<double>(i) * bin_deg;
    directions.yaw_deg[order[i].second] = yaw_deg;
    const auto bin = static_cast<std::size_t>(std::lround(yaw_deg / bin_deg));
    directions.names[bin % directions.names.size()] = order[i].second;
  }
  return directions;
}

}  // namespace vantage
