/// What a study came to, read back from its summary.json, as tables and as numbers for claims.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vantage::bench {

using Json = nlohmann::ordered_json;

/// @throws InputError if the file is not there or is not JSON.
Json read_json(const std::filesystem::path& file);

class StudySummary {
 public:
  explicit StudySummary(Json json) : json_(std::move(json)) {}

  [[nodiscard]] bool has(const std::string& table) const {
    return json_.at("tables").contains(table);
  }
  /// Of a table's panel ("objects_8", "all") and level ("adaptive"); none if it was not run.
  [[nodiscard]] std::optional<double> mean(const std::string& table, const std::string& panel,
                                           const std::string& level) const;
  /// Of any episode; none also in what an older collect wrote.
  [[nodiscard]] std::optional<double> least(const std::string& table, const std::string& panel,
                                            const std::string& level) const;
  /// To the reference level, of the same starts.
  [[nodiscard]] std::optional<double> ratio(const std::string& table, const std::string& panel,
                                            const std::string& level) const;
  /// Whether the interval of the difference to the reference level lies above 0; not for that
  /// level.
  [[nodiscard]] bool above_reference(const std::string& table, const std::string& panel,
                                     const std::string& level) const;
  /// The same below 0.
  [[nodiscard]] bool below_reference(const std::string& table, const std::string& panel,
                                     const std::string& level) const;
  /// "1.04 [1.01, 1.07], 20 pairs": ratio to the reference level; empty for that level.
  [[nodiscard]] std::string ratio_text(const std::string& table, const std::string& panel,
                                       const std::string& level) const;
  /// "-3.1 [-4.0, -2.2]": by how much the reference is above that level, paired, times `scale`;
  /// empty for the reference.
  [[nodiscard]] std::string less_text(const std::string& table, const std::string& panel,
                                      const std::string& level, double scale, int digits) const;
  /// How many pairs that is of; 0 for the reference.
  [[nodiscard]] int pairs(const std::string& table, const std::string& panel,
                          const std::string& level) const;
  /// Those of the table but "all", in order.
  [[nodiscard]] std::vector<std::string> panels(const std::string& table) const;
  [[nodiscard]] std::vector<std::string> levels(const std::string& table) const;
  /// "120 of 320 episodes"
  [[nodiscard]] std::string extent() const;

  /// A row a level, a column a panel: mean [95 % interval], ratio to the reference, p.
  [[nodiscard]] std::string markdown(const std::string& table) const;

 private:
  [[nodiscard]] const Json* entry(const std::string& table, const std::string& panel,
                                  const std::string& level) const;
  /// To the reference level; none for that level, and without pairs.
  [[nodiscard]] const Json* difference(const std::string& table, const std::string& panel,
                                       const std::string& level) const;
  Json json_;
};

}  // namespace vantage::bench
