#include "vantage/study/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "vantage/core/data_root.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/study/measures.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

constexpr std::size_t kMaxEpisodes = 100'000;

/// Names become folders and columns.
void require_name(const ConfigNode& node, const std::string& name, const char* what) {
  const auto good = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '.' || c == '-' || c == '+';
  };
  if (name.empty() || name.front() == '.' || !std::ranges::all_of(name, good)) {
    throw ConfigError(fmt::format("{}: {} '{}' may hold letters, digits and _ . - + only",
                                  node.where(), what, name));
  }
}

/// Values that name files are found beside the study, and named so that they are found again.
void settle_files(ConfigNode& overrides, const fs::path& base) {
  for (auto& [key, value] : overrides.entries) {
    if ((key != "scene" && key != "robot.model") || value.kind != ConfigNode::Kind::scalar) {
      continue;
    }
    value.scalar = lasting_name(find_input(value.scalar, base, value.where()));
    value.quoted = true;
  }
}

Overrides overrides_of(const ConfigNode& node) {
  if (node.kind == ConfigNode::Kind::null) return {};
  detail::require_kind(node, ConfigNode::Kind::map);
  return node.entries;
}

Factor factor_of(const std::string& name, const ConfigNode& node) {
  require_name(node, name, "factor");
  detail::require_kind(node, ConfigNode::Kind::map);
  if (node.entries.empty()) throw ConfigError(node.where() + ": a factor needs a level");
  if (name == "episode" || name == "status" || name == "state_hash" || find_scalar(name)) {
    throw ConfigError(
        fmt::format("{}: the results have a column '{}' already", node.where(), name));
  }
  Factor factor{name, {}};
  for (const auto& [level, overrides] : node.entries) {
    require_name(overrides, level, "level");
    factor.levels.push_back({level, overrides_of(overrides)});
  }
  return factor;
}

/// A key has one master: `set` or one factor.
void require_disjoint(const Study& study) {
  std::set<std::string> taken;
  for (const auto& [key, value] : study.set) taken.insert(key);
  for (const Factor& factor : study.factors) {
    std::set<std::string> own;
    for (const Level& level : factor.levels) {
      for (const auto& [key, value] : level.overrides) {
        own.insert(key);
        if (taken.contains(key)) {
          throw ConfigError(
              fmt::format("{}: '{}' is set in another place of the study too", value.where(), key));
        }
      }
    }
    taken.merge(own);
  }
}

std::vector<std::string> level_names(const Factor& factor) {
  std::vector<std::string> names;
  for (const Level& level : factor.levels) names.push_back(level.name);
  return names;
}

void require_known(const std::string& where, const std::string& what, const std::string& name,
                   const std::vector<std::string>& known) {
  if (std::ranges::find(known, name) != known.end()) return;
  throw ConfigError(
      fmt::format("{}: unknown {} '{}'; known: {}", where, what, name, fmt::join(known, ", ")));
}

void complete_report(Study& study, const std::string& where) {
  StudyReport& report = study.report;
  std::vector<std::string> factors;
  for (const Factor& factor : study.factors) factors.push_back(factor.name);
  require_known(where + ".compare", "factor", report.compare, factors);
  const Factor& compared = study.factors[factor_index(study, report.compare)];
  if (report.reference.empty()) report.reference = compared.levels.front().name;
  require_known(where + ".reference", "level", report.reference, level_names(compared));
  if (!report.panels.empty()) require_known(where + ".panels", "factor", report.panels, factors);
  if (report.panels == report.compare) {
    throw ConfigError(where + ".panels: the factor compared cannot be spread over panels");
  }
  if (!report.predictors_along.empty()) {
    require_known(where + ".predictors_along", "level", report.predictors_along,
                  level_names(compared));
  }
  for (const auto& curve : report.curves) {
    require_known(where + ".curves", "curve", curve, curve_names());
  }
  for (const auto& table : report.tables) {
    require_known(where + ".tables", "metric", table, scalar_names());
  }
}

ConfigNode& entry(ConfigNode& root, const std::string& name) {
  return *const_cast<ConfigNode*>(root.find(name));
}

/// Replaces the names of files, and adds `overrides` to `set`.
void settle(ConfigNode& root, const fs::path& file, const std::vector<std::string>& overrides) {
  const fs::path base = file.parent_path();
  detail::require_kind(root, ConfigNode::Kind::map);
  const ConfigNode* episode = root.find("episode");
  if (episode == nullptr || episode->kind != ConfigNode::Kind::scalar) {
    throw ConfigError(fmt::format("{}: episode: expected the base episode's file", file.string()));
  }
  const std::string found = lasting_name(find_input(episode->scalar, base, episode->where()));
  entry(root, "episode").scalar = found;
  ConfigNode set = root.find("set") != nullptr ? *root.find("set") : ConfigNode::make_map();
  if (set.kind == ConfigNode::Kind::null) set.kind = ConfigNode::Kind::map;
  detail::require_kind(set, ConfigNode::Kind::map);
  settle_files(set, base);
  for (const auto& assignment : overrides) {
    const auto equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw ConfigError(fmt::format("--set {}: expected key=value", assignment));
    }
    ConfigNode given = ConfigNode::make_map();
    ConfigNode value = parse_yaml(assignment.substr(equals + 1), "--set");
    value.origin = "--set";
    given.set(assignment.substr(0, equals), std::move(value));
    settle_files(given, {});
    set.set(given.entries.front().first, given.entries.front().second);
  }
  root.set("set", std::move(set));
  if (root.find("factors") == nullptr) return;
  for (auto& [name, factor] : entry(root, "factors").entries) {
    for (auto& [level, node] : factor.entries) settle_files(node, base);
  }
}

std::size_t episode_count(const Study& study) {
  std::size_t count = 1;
  for (const Factor& factor : study.factors) {
    count *= factor.levels.size();
    if (count > kMaxEpisodes) {
      throw ConfigError(fmt::format("factors: more than {} episodes", kMaxEpisodes));
    }
  }
  return count;
}

/// Digits of `number` in the mixed base of the factors, the last one fastest.
std::vector<std::size_t> levels_of(const Study& study, std::size_t number) {
  std::vector<std::size_t> levels(study.factors.size());
  for (std::size_t f = study.factors.size(); f-- > 0;) {
    levels[f] = number % study.factors[f].levels.size();
    number /= study.factors[f].levels.size();
  }
  return levels;
}

PlannedEpisode planned(const Study& study, ConfigNode root,
                       const std::vector<std::size_t>& levels) {
  PlannedEpisode episode;
  episode.levels = levels;
  Overrides overrides = study.set;
  for (std::size_t f = 0; f < levels.size(); ++f) {
    const Level& level = study.factors[f].levels[levels[f]];
    episode.name += (f == 0 ? "" : "/") + level.name;
    overrides.insert(overrides.end(), level.overrides.begin(), level.overrides.end());
  }
  set_values(root, std::move(overrides));
  episode.resolved = resolve_episode(root, study.episode);
  return episode;
}

}  // namespace

bool is_study(const fs::path& file) {
  if (file.extension() != ".yaml" && file.extension() != ".yml") return false;
  try {
    const ConfigNode root = read_yaml(file);
    return root.find("factors") != nullptr || root.find("episode") != nullptr;
  } catch (const Error&) {
    return false;
  }
}

Validation validate_study(const fs::path& file) {
  return validation_of([&] {
    Validation found;
    std::set<fs::path> seen;
    for (const PlannedEpisode& episode : plan_study(read_study(file))) {
      if (!seen.insert(episode.resolved.setup.scene).second) continue;
      const Validation scene = validation_of([&] {
        require_start(file, episode.resolved);
        return Validation{};
      });
      found.problems.insert(found.problems.end(), scene.problems.begin(), scene.problems.end());
      found.code = std::max(found.code, scene.code);
    }
    return found;
  });
}

Study read_study(const fs::path& file, const std::vector<std::string>& overrides) {
  ConfigNode root = read_yaml(file);
  settle(root, file, overrides);
  Study study;
  study.name = file.stem().string();
  study.title = study.name;
  FieldReader reader(root);
  reader("title", study.title, "title of the report; by default the name of the file");
  reader("report", study.report, "what `vantage sweep collect` makes of the results");
  for (const char* key : {"episode", "set", "factors"}) reader.allow(key);
  reader.finish();
  study.episode = find_input(root.find("episode")->scalar, {}, "episode");
  study.set = overrides_of(*root.find("set"));
  const ConfigNode* factors = root.find("factors");
  if (factors == nullptr || factors->entries.empty()) {
    throw ConfigError(file.string() + ": factors: a study needs at least one factor");
  }
  for (const auto& [name, node] : factors->entries) study.factors.push_back(factor_of(name, node));
  require_disjoint(study);
  const ConfigNode* report = root.find("report");
  complete_report(study, report != nullptr ? report->where() : file.string() + ": report");
  study.yaml = to_yaml(root);
  return study;
}

std::vector<KeyDescription> study_keys() {
  const auto key = [](const char* name, const char* type, const char* text) {
    return KeyDescription{.key = name, .type = type, .text = text};
  };
  std::vector<KeyDescription> keys{
      key("title", "text", "of the study's report; default: the name of its file"),
      key("episode", "text", "file of the episode that every episode of the study begins with"),
      key("set", "section", "overrides of it, keys as those of --set"),
      key("factors", "section",
          "name of a factor: name of a level: overrides; the study is the product of all levels, "
          "the last factor changes fastest"),
      key("report", "section", "what is made of the results")};
  keys[2].section = keys[3].section = keys[4].section = true;
  StudyReport report;
  report.fields(FieldDescriber(keys, "report."));
  return keys;
}

std::vector<PlannedEpisode> plan_study(const Study& study) {
  const std::size_t count = episode_count(study);
  const ConfigNode base = read_yaml(study.episode);
  std::vector<PlannedEpisode> plan;
  std::vector<std::string> problems;
  for (std::size_t number = 0; number < count; ++number) {
    const auto levels = levels_of(study, number);
    try {
      plan.push_back(planned(study, base, levels));
    } catch (const ConfigError& error) {
      for (const auto& problem : error.problems()) {
        if (std::ranges::find(problems, problem) == problems.end()) problems.push_back(problem);
      }
    }
  }
  if (!problems.empty()) throw ConfigError(problems);
  return plan;
}

std::size_t factor_index(const Study& study, const std::string& name) {
  const auto found = std::ranges::find(study.factors, name, &Factor::name);
  expects(found != study.factors.end(), "a factor of that name");
  return static_cast<std::size_t>(found - study.factors.begin());
}

std::size_t level_index(const Factor& factor, const std::string& name) {
  const auto found = std::ranges::find(factor.levels, name, &Level::name);
  expects(found != factor.levels.end(), "a level of that name");
  return static_cast<std::size_t>(found - factor.levels.begin());
}

}  // namespace vantage
