/// A study: one episode, varied by factors. Its YAML file, key by key:
///
///   title: ...                   of its report
///   episode: tabletop.yaml       base of every episode
///   set: {scans: 10}             overrides of it, keys as those of --set
///   seeds: 1..20                 or a list: a factor called seed, the last one
///   factors:                     the episodes are the product of all levels, the last factor
///   fastest
///     method:
///       random: {choice: random}           level: overrides
///       sparse: {gain: beer_lambert, gain.a: 0.999}
///   splits:                      of the levels: what is chosen on, what is reported
///     development: {start: [start_0, start_1]}
///     report: {start: [start_2, start_3]}
///   split: development           the one that is run; by default the first
///   draws: choice.draw           a sequence of random numbers for every episode that sets it
///   report: {compare: method, reference: random, ...}     StudyReport
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "vantage/core/config_node.hpp"
#include "vantage/core/schema.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/tasks/episode.hpp"
#include "vantage/tasks/validate.hpp"

namespace vantage {

/// Levels of one factor that go by one name in panels and comparisons.
struct LevelGroup {
  std::string name;
  std::vector<std::string> levels;
};

/// What `sweep collect` makes of the results.
struct StudyReport {
  std::string compare = "method";  ///< if there is none: the first factor that is no seed
  std::string reference;
  std::string panels;
  std::string cluster;
  std::vector<LevelGroup> groups;  ///< `report.groups`, which is read apart
  std::vector<std::string> curves;
  std::vector<std::string> tables;
  std::string predictors_along;
  void fields(auto&& f) {
    f("compare", compare,
      "factor whose levels are compared with each other, paired over all other factors");
    f("reference", reference,
      "level of `compare` that the others are held against; empty: the first");
    f("panels", panels, "factor with a panel of each figure for every level; empty: one panel");
    f("cluster", cluster,
      "factor whose levels, scenes say, are resampled as a whole for intervals and tests, as what "
      "is of one level is alike; empty: every pair for itself");
    f("curves", curves,
      "names of the measures drawn as curves over the steps of an episode; empty: none");
    f("tables", tables, "names of the measures in the tables, one number per episode; empty: none");
    f("predictors_along", predictors_along,
      "level of `compare` along whose episodes the predictions of all gains are compared; empty: "
      "not compared");
  }
};

using Overrides = std::vector<KeyValue>;

struct Level {
  std::string name;
  Overrides overrides;
};

struct Factor {
  std::string name;
  std::vector<Level> levels;  ///< at least one
};

struct Study {
  std::string name;  ///< of the file, without extension
  std::string title;
  std::filesystem::path episode;  ///< found
  Overrides set;
  std::vector<Factor> factors;  ///< at least one
  StudyReport report;
  std::string draws;  ///< key that numbers random sequences; empty: as the levels say
  std::string split;  ///< of the levels, those that are run; empty: all
  std::string yaml;   ///< the whole study; files named as found again from any directory
};

/// Whether a file is YAML and a study, not an episode.
bool is_study(const std::filesystem::path& file);

/// @param overrides as of --set, of every episode
/// @throws ConfigError or InputError naming file, line, key and value.
/// @param split the one to run; empty: as the file says
Study read_study(const std::filesystem::path& file, const std::vector<std::string>& overrides = {},
                 const std::string& split = {});

struct PlannedEpisode {
  std::string name;                 ///< its levels joined by '/': also its folder
  std::vector<std::size_t> levels;  ///< index of the level of each factor
  ResolvedEpisode resolved;
};

/// Where an episode stands among the factors.
struct EpisodeLevels {
  std::string name;                 ///< its levels joined by '/'
  std::vector<std::size_t> levels;  ///< index of the level of each factor
};

/// Of every episode, in the fixed order of the product.
/// @throws ConfigError if they are too many
std::vector<EpisodeLevels> episode_levels(const Study& study);

/// The keys of a study's file.
std::vector<KeyDescription> study_keys();

/// Every episode, in the fixed order of the product.
/// @throws ConfigError with every problem of every level.
std::vector<PlannedEpisode> plan_study(const Study& study);

/// Everything wrong with a study's file and with the scenes of its episodes.
Validation validate_study(const std::filesystem::path& file);

/// Index of the factor or level called so; it must be there.
std::size_t factor_index(const Study& study, const std::string& name);
std::size_t level_index(const Factor& factor, const std::string& name);

}  // namespace vantage
