#include "vantage/study/study_reading.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

#include "vantage/core/data_root.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/study/kit/study_values.hpp"
#include "vantage/study/measures.hpp"
#include "vantage/study/study_layout.hpp"
#include "vantage/study/study_levels.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

void require_name(const ConfigNode& node, const std::string& name, const char* what) {
  if (is_study_name(name)) return;
  throw ConfigError(fmt::format("{}: {} '{}' {}", node.where(), what, name, kStudyNameRule));
}

ConfigNode& entry(ConfigNode& root, const std::string& name) {
  return *const_cast<ConfigNode*>(root.find(name));
}

Overrides overrides_of(const ConfigNode& node) {
  if (node.kind == ConfigNode::Kind::null) return {};
  detail::require_kind(node, ConfigNode::Kind::map);
  return node.entries;
}

std::string unnamed(const ConfigNode& root, const fs::path& file, const char* key) {
  const ConfigNode* node = root.find(key);
  return node != nullptr ? node->where() : fmt::format("{}: {}", file.string(), key);
}

/// The base episode's file, named so that it is found again.
void read_base(ConfigNode& root, const fs::path& file, Study& study) {
  const ConfigNode* episode = root.find("episode");
  if (episode == nullptr || episode->kind != ConfigNode::Kind::scalar) {
    throw ConfigError(
        fmt::format("{}: expected the base episode's file", unnamed(root, file, "episode")));
  }
  const std::string found =
      lasting_name(find_input(episode->scalar, file.parent_path(), episode->where()));
  study.episode = find_input(found, {}, "episode");
  entry(root, "episode").scalar = found;
}

/// One assignment of --set into `set`.
void add_override(ConfigNode& set, const std::string& assignment) {
  auto [key, value] = parse_override(assignment);
  ConfigNode given = ConfigNode::make_map();
  given.set(key, std::move(value));
  settle_files(given, {});
  set.set(given.entries.front().first, given.entries.front().second);
}

/// What holds for every episode, those of the command line last.
void read_set(ConfigNode& root, const fs::path& file, const std::vector<std::string>& overrides,
              StudyReading& reading) {
  ConfigNode set = root.find("set") != nullptr ? *root.find("set") : ConfigNode::make_map();
  if (set.kind == ConfigNode::Kind::null) set.kind = ConfigNode::Kind::map;
  if (!reading.problems.attempt([&] { detail::require_kind(set, ConfigNode::Kind::map); })) return;
  reading.problems.attempt([&] { settle_files(set, file.parent_path()); });
  for (const auto& assignment : overrides) {
    reading.problems.attempt([&] { add_override(set, assignment); });
  }
  reading.study.set = set.entries;
  root.set("set", std::move(set));
}

/// A factor called `seed`, with a level for each.
Factor seed_factor(const ConfigNode& node) {
  Factor factor{"seed", {}};
  for (const std::uint64_t seed : read_seeds(node)) {
    ConfigNode value = ConfigNode::make_scalar(std::to_string(seed));
    value.origin = node.origin;
    factor.levels.push_back({std::to_string(seed), {{"seed", std::move(value)}}});
  }
  return factor;
}

/// Of results.csv and timings.csv, whatever is measured.
constexpr auto kColumns = std::to_array<std::string_view>(
    {"episode", "status", "state_hash", "config_hash", "commit", "wall_time_s", "real_time_factor",
     "plan_time_s", "map_time_s", "threads", "cpu"});

Factor factor_of(const std::string& name, ConfigNode& node, const fs::path& base,
                 Problems& problems) {
  require_name(node, name, "factor");
  detail::require_kind(node, ConfigNode::Kind::map);
  if (node.entries.empty()) throw ConfigError(node.where() + ": a factor needs a level");
  if (std::ranges::find(kColumns, name) != kColumns.end() || find_scalar(name)) {
    throw ConfigError(
        fmt::format("{}: the results have a column '{}' already", node.where(), name));
  }
  Factor factor{name, {}};
  for (auto& [level, overrides] : node.entries) {
    problems.attempt([&, &level = level, &overrides = overrides] {
      require_name(overrides, level, "level");
      settle_files(overrides, base);
      factor.levels.push_back({level, overrides_of(overrides)});
    });
  }
  return factor;
}

void add_factor(const std::string& name, ConfigNode& node, const fs::path& base,
                StudyReading& reading) {
  reading.problems.attempt([&] {
    Factor factor =
        name == "seeds" ? seed_factor(node) : factor_of(name, node, base, reading.problems);
    if (std::ranges::find(reading.study.factors, factor.name, &Factor::name) !=
        reading.study.factors.end()) {
      throw ConfigError(fmt::format("{}: factor '{}' is there twice", node.where(), factor.name));
    }
    if (!factor.levels.empty()) reading.study.factors.push_back(std::move(factor));
  });
}

/// `seeds` beside the factors are the last of them, so the fastest.
void read_factors(ConfigNode& root, const fs::path& file, StudyReading& reading) {
  const auto named = [&](const char* key) { return root.find(key) != nullptr; };
  if (named("factors")) {
    ConfigNode& factors = entry(root, "factors");
    if (factors.kind != ConfigNode::Kind::null) {
      reading.problems.attempt([&] { detail::require_kind(factors, ConfigNode::Kind::map); });
    }
    for (auto& [name, node] : factors.entries) add_factor(name, node, file.parent_path(), reading);
  }
  if (named("seeds")) add_factor("seeds", entry(root, "seeds"), {}, reading);
  if (named("seeds") || (named("factors") && !root.find("factors")->entries.empty())) return;
  reading.problems.attempt(
      [&] { throw ConfigError(file.string() + ": factors: a study needs at least one factor"); });
}

/// A key has one master: `set` or one factor.
void require_disjoint(const Study& study, Problems& problems) {
  std::set<std::string> taken;
  for (const auto& [key, value] : study.set) taken.insert(key);
  for (const Factor& factor : study.factors) {
    std::set<std::string> own;
    for (const Level& level : factor.levels) {
      for (const auto& [key, value] : level.overrides) {
        own.insert(key);
        if (!taken.contains(key)) continue;
        problems.attempt([&, &key = key, &value = value] {
          throw ConfigError(
              fmt::format("{}: '{}' is set in another place of the study too", value.where(), key));
        });
      }
    }
    taken.merge(own);
  }
}

void require_known(const std::string& where, const std::string& what, const std::string& name,
                   const std::vector<std::string>& known) {
  if (std::ranges::find(known, name) != known.end()) return;
  throw ConfigError(
      fmt::format("{}: {}", where, unknown_strategy(what, name, {known.begin(), known.end()})));
}

/// "s.yaml:9: report.compare"; of a key that is not there, where the report is.
std::string report_key(const ConfigNode& root, const fs::path& file, const char* key) {
  const ConfigNode* report = root.find("report");
  const ConfigNode* node = report == nullptr ? nullptr : report->find(key);
  return node != nullptr ? node->where() : fmt::format("{}.{}", unnamed(root, file, "report"), key);
}

/// Unless it says so, a study compares its `method`, or else what comes first and is no seed.
std::string compared_by_default(const std::vector<std::string>& factors) {
  if (std::ranges::find(factors, "method") != factors.end()) return "method";
  const auto first =
      std::ranges::find_if(factors, [](const std::string& name) { return name != "seed"; });
  return first != factors.end() ? *first : factors.front();
}

/// What names levels of the factor compared.
void complete_levels(StudyReport& report, const Factor& compared, const auto& where,
                     Problems& problems) {
  const std::vector<std::string> levels = grouped_levels(compared, report.groups).names;
  if (report.reference.empty()) report.reference = levels.front();
  problems.attempt([&] { require_known(where("reference"), "level", report.reference, levels); });
  if (report.predictors_along.empty()) return;
  problems.attempt(
      [&] { require_known(where("predictors_along"), "level", report.predictors_along, levels); });
}

void complete_report(const ConfigNode& root, const fs::path& file, StudyReading& reading) {
  Study& study = reading.study;
  StudyReport& report = study.report;
  Problems& problems = reading.problems;
  const auto where = [&](const char* key) { return report_key(root, file, key); };
  for (const auto& curve : report.curves) {
    problems.attempt([&] { require_known(where("curves"), "curve", curve, curve_names()); });
  }
  for (const auto& table : report.tables) {
    problems.attempt([&] { require_known(where("tables"), "metric", table, scalar_names()); });
  }
  if (study.factors.empty()) return;
  std::vector<std::string> factors;
  for (const Factor& factor : study.factors) factors.push_back(factor.name);
  const ConfigNode* given = root.find("report");
  if (given == nullptr || given->find("compare") == nullptr) {
    report.compare = compared_by_default(factors);
  }
  if (!report.panels.empty()) {
    problems.attempt([&] {
      require_known(where("panels"), "factor", report.panels, factors);
      const Factor& panels = study.factors[factor_index(study, report.panels)];
      const auto names = grouped_levels(panels, report.groups).names;
      if (names.size() > 1 && std::ranges::find(names, "all") != names.end()) {
        throw ConfigError(where("panels") +
                          ": a level or group 'all' has the name of all panels together");
      }
    });
  }
  if (!report.cluster.empty()) {
    problems.attempt([&] { require_known(where("cluster"), "factor", report.cluster, factors); });
  }
  if (!problems.attempt(
          [&] { require_known(where("compare"), "factor", report.compare, factors); })) {
    return;
  }
  problems.attempt([&] {
    if (report.panels != report.compare) return;
    throw ConfigError(where("panels") + ": the factor compared cannot be spread over panels");
  });
  problems.attempt([&] {
    if (report.cluster != report.compare) return;
    throw ConfigError(where("cluster") + ": the factor compared cannot be what is alike");
  });
  complete_levels(report, study.factors[factor_index(study, report.compare)], where, problems);
}

bool is_titled(const ConfigNode& root) {
  const ConfigNode* title = root.find("title");
  return title != nullptr && title->kind != ConfigNode::Kind::null &&
         (title->kind != ConfigNode::Kind::scalar || !title->scalar.empty());
}

/// Of a study that gives itself none: its file's name, or that of the folder of its results, where
/// the file is called study.yaml.
std::string title_of(const fs::path& file) {
  const std::string stem = file.stem().string();
  const fs::path folder = fs::absolute(file).lexically_normal().parent_path().filename();
  return stem == "study" && !folder.empty() ? folder.string() : stem;
}

}  // namespace

bool is_study_name(std::string_view name) {
  const auto good = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '.' || c == '-' || c == '+';
  };
  return !name.empty() && name.front() != '.' && std::ranges::all_of(name, good);
}

StudyReading read_study_file(const fs::path& file, const std::vector<std::string>& overrides,
                             const std::string& split) {
  ConfigNode root = read_yaml(file);
  detail::require_kind(root, ConfigNode::Kind::map);
  StudyReading reading;
  Study& study = reading.study;
  study.name = file.stem().string();
  study.title = title_of(file);
  if (!is_titled(root)) root.set("title", detail::write_value(study.title));
  std::vector<LevelGroup> groups;
  const ConfigNode plain = take_groups(root, groups, reading.problems);
  reading.problems.attempt([&] {
    FieldReader reader(plain);
    reader("title", study.title, "title of the report; by default the name of the file");
    reader("draws", study.draws, "key that numbers the random sequences of episodes");
    reader("report", study.report, "what `vantage sweep collect` makes of the results");
    for (const char* key : {"episode", "set", "factors", "seeds", "splits", "split"}) {
      reader.allow(key);
    }
    reader.finish();
  });
  reading.problems.attempt([&] { read_base(root, file, study); });
  read_set(root, file, overrides, reading);
  read_factors(root, file, reading);
  require_disjoint(study, reading.problems);
  require_drawn(root, study, reading.problems);
  study.report.groups = std::move(groups);
  take_split(root, split, study, reading.problems);
  check_groups(root, study, reading.problems);
  complete_report(root, file, reading);
  study.yaml = to_yaml(root);
  return reading;
}

}  // namespace vantage
