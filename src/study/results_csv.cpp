#include "vantage/study/results_csv.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

#include "vantage/core/hash.hpp"
#include "vantage/report/report_data.hpp"

namespace vantage {
namespace {
using Json = nlohmann::ordered_json;

std::string csv_start(const StudyResults& results, std::size_t episode) {
  std::string row = results.plan[episode].name;
  for (std::size_t f = 0; f < results.study.factors.size(); ++f) {
    row += "," + results.study.factors[f].levels[results.plan[episode].levels[f]].name;
  }
  return row;
}

/// The measures of the tasks that the study has, of wall time or else.
std::vector<std::size_t> columns_of(const StudyResults& results, bool wall) {
  std::set<std::size_t> columns;
  for (const PlannedEpisode& episode : results.plan) {
    for (const ScalarMeasure& scalar : measures(episode.resolved.task).scalars) {
      if (scalar.name.wall == wall) columns.insert(find_scalar(scalar.name.name).value());
    }
  }
  return {columns.begin(), columns.end()};
}

std::string csv_header(const StudyResults& results) {
  std::string header = "episode";
  for (const Factor& factor : results.study.factors) header += "," + factor.name;
  return header;
}

/// Whose prediction errors there are, in order.
std::vector<std::string> predictors_of(const StudyResults& results) {
  std::vector<std::string> names;
  for (const auto& measures : results.measures) {
    if (!measures) continue;
    for (const auto& [name, curve] : measures->prediction_errors) {
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

/// Mean of an episode, or nothing.
std::string prediction_error(const StudyResults& results, std::size_t i, const std::string& name) {
  if (!results.measures[i]) return {};
  const PredictionErrors& errors = results.measures[i]->prediction_errors;
  const auto found = std::ranges::find(errors, name, &PredictionErrors::value_type::first);
  const bool none = found == errors.end() || found->second.empty();
  return none ? std::string() : fmt::format("{}", mean(found->second));
}

/// But for `threads`, which change no result.
std::string config_hash(ResolvedEpisode resolved) {
  resolved.setup.options.threads = EpisodeOptions{}.threads;
  return hash_text(hash_bytes(episode_yaml(resolved)));
}

/// The manifest of the episode, an object; empty if there is none.
Json manifest_of(const StudyResults& results, std::size_t i) {
  const Json manifest =
      read_json_or_null(episode_folder(results.directory, results.plan[i]) / "manifest.json");
  return manifest.is_object() ? manifest : Json::object();
}

/// @throws InputError naming the episode whose files hold something of another kind than they
/// should
std::string of_episode(const StudyResults& results, std::size_t i,
                       const std::function<std::string()>& text) {
  try {
    return text();
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: metrics.json or manifest.json: {}",
                                 episode_folder(results.directory, results.plan[i]).string(),
                                 error.what()));
  }
}

/// State hash, and of what configuration and code the episode is.
std::string origin_of(const StudyResults& results, std::size_t i) {
  if (!results.measures[i]) return ",,,";
  const Json versions = manifest_of(results, i).value("versions", Json::object());
  return fmt::format(",{},{},{}", episode_metrics(results, i).value("state_hash", ""),
                     config_hash(results.plan[i].resolved),
                     versions.is_object() ? versions.value("vantage", "") : "");
}

/// Wall times of an episode, and on what machine.
std::string timings_of(const StudyResults& results, std::size_t i,
                       const std::vector<std::size_t>& columns) {
  const Json metrics = episode_metrics(results, i);
  double plan_s = 0.0;
  double map_s = 0.0;
  for (const Json& scan : metrics.value("scans", Json::array())) {
    plan_s += scan.value("plan_time_s", 0.0);
    map_s += scan.value("map_time_s", 0.0);
  }
  std::string text =
      fmt::format("{},{},{},{},{}", csv_start(results, i), metrics.value("wall_time_s", 0.0),
                  metrics.value("real_time_factor", 0.0), plan_s, map_s);
  for (const std::size_t s : columns) {
    const auto& value = results.measures[i]->scalars[s];
    text += value ? fmt::format(",{}", *value) : ",";
  }
  const Json manifest = manifest_of(results, i);
  return text + fmt::format(",{},{}\n", manifest.value("threads", 0),
                            csv_field(manifest.value("cpu", "")));
}

}  // namespace

std::string results_csv(const StudyResults& results) {
  std::string text = csv_header(results) + ",status";
  const std::vector<std::size_t> columns = columns_of(results, false);
  const std::vector<std::string> predictors = predictors_of(results);
  for (const std::size_t s : columns) text += fmt::format(",{}", scalar_measures()[s].name);
  for (const std::string& name : predictors)
    text += fmt::format(",prediction_error_{}_cells", name);
  text += ",state_hash,config_hash,commit\n";
  for (std::size_t i = 0; i < results.plan.size(); ++i) {
    text += fmt::format("{},{}", csv_start(results, i), state_name(results.states[i]));
    for (const std::size_t s : columns) {
      const auto value = results.measures[i] ? results.measures[i]->scalars[s] : std::nullopt;
      text += value ? fmt::format(",{}", *value) : ",";
    }
    for (const std::string& name : predictors) text += "," + prediction_error(results, i, name);
    text += of_episode(results, i, [&] { return origin_of(results, i); }) + "\n";
  }
  return text;
}

std::string timings_csv(const StudyResults& results) {
  std::string text = csv_header(results) + ",wall_time_s,real_time_factor,plan_time_s,map_time_s";
  const std::vector<std::size_t> columns = columns_of(results, true);
  for (const std::size_t s : columns) text += fmt::format(",{}", scalar_measures()[s].name);
  text += ",threads,cpu\n";
  for (std::size_t i = 0; i < results.plan.size(); ++i) {
    if (!results.measures[i]) continue;
    text += of_episode(results, i, [&] { return timings_of(results, i, columns); });
  }
  return text;
}

}  // namespace vantage
