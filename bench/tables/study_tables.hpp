/// What a study came to, read from its results.csv and held against its plan: a number is of every
/// episode that it stands for, or there is none.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "vantage/report/report_data.hpp"
#include "vantage/study/study.hpp"
#include "vantage/study/study_layout.hpp"
#include "vantage/study/tables/comparison.hpp"

namespace vantage::bench {

using Json = nlohmann::ordered_json;

/// @throws InputError if the file is not there or is not JSON.
Json read_json(const std::filesystem::path& file);

/// What was to be known was not measured, or not of all that it is about.
class NotRun : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// `above` / `below`. @throws NotRun if that is no number
double quotient(double above, double below);

/// "1.04 [1.01, 1.07], 20 pairs, p 0.031": the ratio.
std::string ratio_text(const Difference& paired);

/// The panel that holds all others.
inline constexpr const char* kAllPanels = "all";

/// Rows whose episode is in `results`, and where both tables have a state hash, as the same one:
/// what is told of an episode that has no result counts no more.
CsvTable of_results(CsvTable table, const CsvTable& results);

class StudyTables {
 public:
  /// @param results of sweep collect; no rows if it was never run
  /// @throws ConfigError if the study's file is wrong
  StudyTables(const std::filesystem::path& study_file, CsvTable results);
  StudyTables(const std::filesystem::path& study_file, const std::filesystem::path& results_csv);

  /// The same episodes, levels of another factor compared: those that were compared are its panels.
  /// @param reference a level of `factor`
  [[nodiscard]] StudyTables compared_by(const std::string& factor,
                                        const std::string& reference) const;

  /// The same episodes, each level a panel or a level of its own.
  [[nodiscard]] StudyTables ungrouped() const;

  // Of a table (a column of results.csv, or "predictors"), a panel and a level; each throws NotRun
  // unless every episode of the plan that it is about came to a value.
  [[nodiscard]] double mean(const std::string& table, const std::string& panel,
                            const std::string& level) const;
  [[nodiscard]] double least(const std::string& table, const std::string& panel,
                             const std::string& level) const;
  [[nodiscard]] double most(const std::string& table, const std::string& panel,
                            const std::string& level) const;
  /// Of each episode, in the order of the plan.
  [[nodiscard]] std::vector<double> values(const std::string& table, const std::string& panel,
                                           const std::string& level) const;
  /// The same, where one that failed before there was a value counts as `of_failed`.
  [[nodiscard]] std::vector<double> values(const std::string& table, const std::string& panel,
                                           const std::string& level, double of_failed) const;
  [[nodiscard]] double mean(const std::string& table, const std::string& panel,
                            const std::string& level, double of_failed) const;
  /// To the reference level, of the same episodes but for the level; that has none to itself.
  [[nodiscard]] Difference difference(const std::string& table, const std::string& panel,
                                      const std::string& level) const;
  /// To another level than the reference.
  [[nodiscard]] Difference difference(const std::string& table, const std::string& panel,
                                      const std::string& level, const std::string& against) const;
  [[nodiscard]] double ratio(const std::string& table, const std::string& panel,
                             const std::string& level) const;
  /// Of the ratio to the reference level.
  [[nodiscard]] std::string ratio_text(const std::string& table, const std::string& panel,
                                       const std::string& level) const;

  /// Of a table of what it takes to get somewhere, where not every episode gets: of those that do.
  /// @throws NotRun unless every episode was run
  [[nodiscard]] std::vector<Sample> arrivals(const std::string& table, const std::string& panel,
                                             const std::string& level) const;
  /// Of the same table, of every episode: 1 if it gets there, else 0.
  [[nodiscard]] std::vector<Sample> whether_arrived(const std::string& table,
                                                    const std::string& panel,
                                                    const std::string& level) const;
  /// Episodes of the level, as planned.
  [[nodiscard]] std::size_t planned(const std::string& panel, const std::string& level) const {
    return planned(panel, level_of({}, level));
  }

  /// As planned.
  [[nodiscard]] std::vector<std::string> panels() const;
  [[nodiscard]] std::vector<std::string> levels() const { return layout_.levels(); }
  [[nodiscard]] const std::string& reference() const { return study_.report.reference; }
  /// "120 of 320 episodes, 2 failed"
  [[nodiscard]] std::string extent() const;
  /// Whether there is any value.
  [[nodiscard]] bool has(const std::string& table) const;
  /// A row a level, a column a panel: mean [95 % interval], ratio to the reference, p, and of how
  /// many episodes where some are missing.
  [[nodiscard]] std::string markdown(const std::string& table) const;

 private:
  struct Episode {
    std::string name;
    EpisodePlace place;
    const std::vector<std::string>* row = nullptr;  ///< none: it came to no result
  };
  StudyTables(Study study, CsvTable results);
  /// The panels, or one of all episodes.
  [[nodiscard]] std::vector<std::string> groups() const;
  void plan_episodes();
  void find_rows();
  struct Table {
    std::vector<std::string> levels;
    std::size_t reference = 0;
    std::vector<Sample> samples;
  };
  [[nodiscard]] const Table& table(const std::string& name) const;
  [[nodiscard]] Table scalar_table(const std::string& name) const;
  [[nodiscard]] Table predictor_table() const;
  [[nodiscard]] bool is_of(const Episode& episode, const std::string& panel,
                           std::size_t level) const;
  /// Of a column; none: it was not run, or came to no number.
  [[nodiscard]] std::optional<double> value_of(const Episode& episode,
                                               const std::string& column) const;
  /// It was run, to no good end.
  [[nodiscard]] bool has_failed(const Episode& episode) const;
  [[nodiscard]] std::size_t planned(const std::string& panel, std::size_t level) const;
  /// As many as there are.
  [[nodiscard]] std::vector<Sample> samples(const std::string& table, const std::string& panel,
                                            const std::string& level) const;
  /// @throws NotRun if one is missing
  [[nodiscard]] std::vector<Sample> whole_samples(const std::string& table,
                                                  const std::string& panel,
                                                  const std::string& level) const;
  [[nodiscard]] std::size_t level_of(const std::string& table, const std::string& level) const;

  Study study_;
  StudyLayout layout_;
  CsvTable results_;
  std::vector<Episode> episodes_;
  mutable std::map<std::string, Table> tables_;
};

}  // namespace vantage::bench
