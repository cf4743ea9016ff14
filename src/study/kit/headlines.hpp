/// What is said first of two runs, or of two studies: few numbers that matter, side by side.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vantage {

struct Headline {
  std::string name;  ///< of the measure; of a study with its level, "area, adaptive"
  std::optional<double> first;
  std::optional<double> second;
  bool beyond = false;  ///< differs more than is tolerated
};

/// Of two metrics.json: what the task of the first calls its headlines.
std::vector<Headline> run_headlines(const nlohmann::ordered_json& first,
                                    const nlohmann::ordered_json& second, double tolerance);
/// Of two summary.json: the mean of every level in every table but of wall times, over all panels.
std::vector<Headline> study_headlines(const nlohmann::ordered_json& first,
                                      const nlohmann::ordered_json& second, double tolerance);

/// A row each: both numbers in four digits, and their difference; `!` where it is beyond.
std::string headlines_text(const std::vector<Headline>& headlines, const std::string& first,
                           const std::string& second);
nlohmann::ordered_json headlines_json(const std::vector<Headline>& headlines);

/// Whether that key of a metrics.json, or table of a summary.json, depends on the machine and its
/// load.
bool is_wall_time(std::string_view key);

/// |a - b| as a share of the larger one.
double relative_difference(double a, double b);

}  // namespace vantage
