#include "bench/tables/study_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "bench/tables/paired_difference.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/study/study_reading.hpp"

namespace vantage::bench {
namespace {
constexpr std::string_view kPredictors = "predictors";
constexpr std::string_view kPredictorFront = "prediction_error_";
constexpr std::string_view kPredictorBack = "_cells";

std::optional<double> value_in(const std::vector<std::string>& row, std::size_t column) {
  double value = 0.0;
  const std::string& cell = row.at(column);
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size() || !std::isfinite(value)) return {};
  return value;
}

/// Its place among the names, or how many they are.
std::size_t place_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

CsvTable read_results(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::exists(file, error) ? read_csv(file) : CsvTable{};
}

/// Files that its episodes need, models say, may be elsewhere.
Study read_plan(const std::filesystem::path& file) {
  const char* split = read_yaml(file).find("splits") != nullptr ? "report" : "";
  StudyReading reading = read_study_file(file, {}, split);
  if (reading.problems.code() == ExitCode::usage) reading.problems.throw_if_any();
  return std::move(reading.study);
}

}  // namespace

Json read_json(const std::filesystem::path& file) {
  Json json = Json::parse(read_file(file), nullptr, false);
  if (json.is_discarded()) throw InputError(file.string() + ": not JSON");
  return json;
}

std::string ratio_text(const Difference& paired) {
  if (!paired.ratio) throw NotRun("a ratio to 0");
  return fmt::format("{:.2f} [{:.2f}, {:.2f}], {} pairs, p {:.2g}", *paired.ratio,
                     paired.ratio_interval->low, paired.ratio_interval->high, paired.pairs,
                     paired.p_value);
}

StudyTables::StudyTables(Study study, CsvTable results)
    : study_(std::move(study)), layout_(study_), results_(std::move(results)) {
  plan_episodes();
  find_rows();
}

StudyTables::StudyTables(const std::filesystem::path& study_file, CsvTable results)
    : StudyTables(read_plan(study_file), std::move(results)) {}

StudyTables::StudyTables(const std::filesystem::path& study_file,
                         const std::filesystem::path& results_csv)
    : StudyTables(study_file, read_results(results_csv)) {}

StudyTables StudyTables::compared_by(const std::string& factor,
                                     const std::string& reference) const {
  Study study = study_;
  study.report.panels = std::exchange(study.report.compare, factor);
  study.report.reference = reference;
  return {std::move(study), results_};
}

StudyTables StudyTables::ungrouped() const {
  Study study = study_;
  study.report.groups.clear();
  return {std::move(study), results_};
}

void StudyTables::plan_episodes() {
  for (const EpisodeLevels& levels : episode_levels(study_)) {
    episodes_.push_back({levels.name, layout_.place(levels.levels), nullptr});
  }
}

void StudyTables::find_rows() {
  const std::size_t names = place_of(results_.columns, "episode");
  const std::size_t states = place_of(results_.columns, "status");
  std::map<std::string, const std::vector<std::string>*> rows;
  for (const auto& row : results_.rows) {
    const std::string& status = row.at(states);
    // What failed has come to something as well; leaving it out would flatter what fails.
    if (status == "completed" || status == "failed") rows[row.at(names)] = &row;
  }
  for (Episode& episode : episodes_) {
    const auto found = rows.find(episode.name);
    if (found != rows.end()) episode.row = found->second;
  }
}

std::vector<std::string> StudyTables::panels() const {
  return study_.report.panels.empty() ? std::vector<std::string>{} : layout_.panels();
}

std::vector<std::string> StudyTables::groups() const {
  const auto names = panels();
  return names.empty() ? std::vector<std::string>{kAllPanels} : names;
}

std::optional<double> StudyTables::value_of(const Episode& episode, const std::string& name) const {
  const std::size_t column = place_of(results_.columns, name);
  if (episode.row == nullptr || column == results_.columns.size()) return {};
  return value_in(*episode.row, column);
}

bool StudyTables::has_failed(const Episode& episode) const {
  return episode.row != nullptr &&
         episode.row->at(place_of(results_.columns, "status")) == "failed";
}

std::string StudyTables::extent() const {
  const auto run =
      std::ranges::count_if(episodes_, [](const Episode& e) { return e.row != nullptr; });
  const auto failed =
      std::ranges::count_if(episodes_, [this](const Episode& e) { return has_failed(e); });
  return fmt::format("{} of {} episodes{}", run, episodes_.size(),
                     failed > 0 ? fmt::format(", {} failed", failed) : "");
}

StudyTables::Table StudyTables::scalar_table(const std::string& name) const {
  Table table{levels(), place_of(levels(), reference()), {}};
  for (const Episode& episode : episodes_) {
    const auto value = value_of(episode, name);
    if (value) table.samples.push_back(sample_at(episode.place, episode.place.level, *value));
  }
  return table;
}

/// A level is a predictor here, its episodes are those of the level that all are compared along.
StudyTables::Table StudyTables::predictor_table() const {
  const std::size_t along = place_of(levels(), study_.report.predictors_along);
  Table table;
  for (std::size_t column = 0; column < results_.columns.size(); ++column) {
    const std::string_view name = results_.columns[column];
    if (!name.starts_with(kPredictorFront) || !name.ends_with(kPredictorBack)) continue;
    if (name.size() <= kPredictorFront.size() + kPredictorBack.size()) continue;
    for (const Episode& episode : episodes_) {
      if (episode.row == nullptr || episode.place.level != along) continue;
      const auto value = value_in(*episode.row, column);
      if (!value) continue;
      table.samples.push_back(sample_at(episode.place, table.levels.size(), *value));
    }
    table.levels.emplace_back(name.substr(
        kPredictorFront.size(), name.size() - kPredictorFront.size() - kPredictorBack.size()));
  }
  const std::size_t simple = place_of(table.levels, "simple");
  table.reference = simple < table.levels.size() ? simple : 0;
  return table;
}

const StudyTables::Table& StudyTables::table(const std::string& name) const {
  const auto found = tables_.find(name);
  if (found != tables_.end()) return found->second;
  return tables_.emplace(name, name == kPredictors ? predictor_table() : scalar_table(name))
      .first->second;
}

bool StudyTables::is_of(const Episode& episode, const std::string& panel, std::size_t level) const {
  return episode.place.level == level &&
         (panel == kAllPanels || panels().at(episode.place.panel) == panel);
}

std::size_t StudyTables::planned(const std::string& panel, std::size_t level) const {
  return static_cast<std::size_t>(std::ranges::count_if(
      episodes_, [&](const Episode& episode) { return is_of(episode, panel, level); }));
}

/// Whose episodes it is about.
std::size_t StudyTables::level_of(const std::string& table, const std::string& level) const {
  const std::string& name = table == kPredictors ? study_.report.predictors_along : level;
  const std::size_t place = place_of(levels(), name);
  if (place == levels().size()) throw NotRun(fmt::format("no level '{}' is planned", name));
  return place;
}

std::vector<Sample> StudyTables::samples(const std::string& name, const std::string& panel,
                                         const std::string& level) const {
  const Table& of = table(name);
  const std::size_t wanted = place_of(of.levels, level);
  const auto groups = panels();
  std::vector<Sample> found;
  for (const Sample& sample : of.samples) {
    const bool here = panel == kAllPanels || groups.at(sample.panel) == panel;
    if (here && sample.level == wanted) found.push_back(sample);
  }
  return found;
}

std::vector<Sample> StudyTables::whole_samples(const std::string& name, const std::string& panel,
                                               const std::string& level) const {
  const std::size_t count = planned(panel, level_of(name, level));
  std::vector<Sample> found = samples(name, panel, level);
  if (count == 0 || found.size() < count) {
    throw NotRun(fmt::format("`{}` of `{}` in {}: {} of {} episodes", name, level, panel,
                             found.size(), count));
  }
  return found;
}

std::vector<double> StudyTables::values(const std::string& name, const std::string& panel,
                                        const std::string& level) const {
  std::vector<double> values;
  for (const Sample& sample : whole_samples(name, panel, level)) values.push_back(sample.value);
  return values;
}

double StudyTables::mean(const std::string& name, const std::string& panel,
                         const std::string& level) const {
  return vantage::mean(values(name, panel, level));
}

double StudyTables::least(const std::string& name, const std::string& panel,
                          const std::string& level) const {
  return std::ranges::min(whole_samples(name, panel, level), {}, &Sample::value).value;
}

double StudyTables::most(const std::string& name, const std::string& panel,
                         const std::string& level) const {
  return std::ranges::max(whole_samples(name, panel, level), {}, &Sample::value).value;
}

Difference StudyTables::difference(const std::string& name, const std::string& panel,
                                   const std::string& level) const {
  const Table& of = table(name);
  if (of.levels.empty()) throw NotRun(fmt::format("`{}`: there is none", name));
  return difference(name, panel, level, of.levels[of.reference]);
}

Difference StudyTables::difference(const std::string& name, const std::string& panel,
                                   const std::string& level, const std::string& against) const {
  if (level == against) {
    throw NotRun(fmt::format("`{}` of `{}`: nothing to hold it against", name, level));
  }
  const LevelSamples other{against, whole_samples(name, panel, against)};
  const LevelSamples own{level, whole_samples(name, panel, level)};
  const auto difference = paired_difference(name, panel, other, own);
  if (difference) return *difference;
  throw NotRun(fmt::format("`{}` of `{}`: no pairs", name, level));
}

double StudyTables::ratio(const std::string& name, const std::string& panel,
                          const std::string& level) const {
  const Difference paired = difference(name, panel, level);
  if (!paired.ratio) throw NotRun(fmt::format("`{}` of `{}`: the reference is 0", name, level));
  return *paired.ratio;
}

std::string StudyTables::ratio_text(const std::string& name, const std::string& panel,
                                    const std::string& level) const {
  return bench::ratio_text(difference(name, panel, level));
}

bool StudyTables::has(const std::string& name) const { return !table(name).samples.empty(); }

}  // namespace vantage::bench
