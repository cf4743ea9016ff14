#include "vantage/study/study_levels.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "vantage/core/error.hpp"
#include "vantage/core/strategy.hpp"
#include "vantage/core/yaml.hpp"

namespace vantage {
namespace {

std::vector<std::string> names_in(const ConfigNode& list) {
  detail::require_kind(list, ConfigNode::Kind::list);
  std::vector<std::string> names;
  for (const ConfigNode& name : list.items) {
    detail::require_kind(name, ConfigNode::Kind::scalar);
    names.push_back(name.scalar);
  }
  return names;
}

std::vector<std::string_view> keys_of(const ConfigNode& map) {
  std::vector<std::string_view> keys;
  for (const auto& [key, value] : map.entries) keys.emplace_back(key);
  return keys;
}

const Level* find_level(const Factor& factor, const std::string& name) {
  const auto found = std::ranges::find(factor.levels, name, &Level::name);
  return found == factor.levels.end() ? nullptr : &*found;
}

std::vector<std::string> level_names(const Factor& factor) {
  std::vector<std::string> names;
  for (const Level& level : factor.levels) names.push_back(level.name);
  return names;
}

/// Leaves the named levels of a factor, in the factor's order.
void leave_levels(const std::string& name, const ConfigNode& list, Study& study) {
  const auto factor = std::ranges::find(study.factors, name, &Factor::name);
  if (factor == study.factors.end()) {
    throw ConfigError(fmt::format("{}: the study has no factor '{}'", list.where(), name));
  }
  const std::vector<std::string> wanted = names_in(list);
  if (wanted.empty()) throw ConfigError(list.where() + ": a split needs a level");
  for (const std::string& level : wanted) {
    if (find_level(*factor, level) != nullptr) continue;
    throw ConfigError(fmt::format("{}: factor '{}' has no level '{}'; it has {}", list.where(),
                                  name, level, fmt::join(level_names(*factor), ", ")));
  }
  std::erase_if(factor->levels, [&](const Level& level) {
    return std::ranges::find(wanted, level.name) == wanted.end();
  });
}

}  // namespace

void take_split(ConfigNode& root, const std::string& wanted, Study& study, Problems& problems) {
  const ConfigNode* splits = root.find("splits");
  const ConfigNode* said = root.find("split");
  problems.attempt([&] {
    if (splits == nullptr) {
      if (wanted.empty() && said == nullptr) return;
      throw ConfigError(fmt::format("{}: the study has no splits",
                                    wanted.empty() ? said->where() : "--split " + wanted));
    }
    detail::require_kind(*splits, ConfigNode::Kind::map);
    if (splits->entries.empty()) throw ConfigError(splits->where() + ": expected a split");
    study.split = !wanted.empty()   ? wanted
                  : said != nullptr ? said->scalar
                                    : splits->entries.front().first;
    const ConfigNode* split = splits->find(study.split);
    if (split == nullptr) {
      throw ConfigError((wanted.empty() && said ? said->where() : std::string("--split")) + ": " +
                        unknown_strategy("split", study.split, keys_of(*splits)));
    }
    for (const auto& [name, other] : splits->entries) {  // a wrong one is told whichever is taken
      detail::require_kind(other, ConfigNode::Kind::map);
      Study tried = study;
      for (const auto& [factor, levels] : other.entries) leave_levels(factor, levels, tried);
    }
    for (const auto& [factor, levels] : split->entries) leave_levels(factor, levels, study);
    root.set("split", ConfigNode::make_scalar(study.split));
  });
}

void require_drawn(const ConfigNode& root, const Study& study, Problems& problems) {
  if (study.draws.empty()) return;
  const auto sets_it = [&](const Overrides& overrides) {
    return std::ranges::find(overrides, study.draws, &KeyValue::first) != overrides.end();
  };
  const auto has_it = [&](const Factor& factor) {
    return std::ranges::any_of(factor.levels, sets_it, &Level::overrides);
  };
  problems.attempt([&] {
    if (sets_it(study.set) || std::ranges::any_of(study.factors, has_it)) return;
    throw ConfigError(
        fmt::format("{}: no level sets '{}'", root.find("draws")->where(), study.draws));
  });
}

ConfigNode take_groups(const ConfigNode& root, std::vector<LevelGroup>& groups,
                       Problems& problems) {
  ConfigNode rest = root;
  const ConfigNode* report = root.find("report");
  const ConfigNode* given = report == nullptr ? nullptr : report->find("groups");
  if (given == nullptr) return rest;
  problems.attempt([&] {
    detail::require_kind(*given, ConfigNode::Kind::map);
    for (const auto& [name, levels] : given->entries) groups.push_back({name, names_in(levels)});
  });
  ConfigNode without = *report;
  std::erase_if(without.entries, [](const auto& entry) { return entry.first == "groups"; });
  rest.set("report", std::move(without));
  return rest;
}

void check_groups(const ConfigNode& root, const Study& study, Problems& problems) {
  std::vector<std::string> taken;
  for (const LevelGroup& group : study.report.groups) {
    problems.attempt([&] {
      const std::string where = root.find("report")->find("groups")->find(group.name)->where();
      const auto has_all = [&](const Factor& factor) {
        return std::ranges::all_of(group.levels, [&](const std::string& level) {
          return find_level(factor, level) != nullptr;
        });
      };
      // A split may leave some levels of a group, or none.
      const auto known = [&](const std::string& level) {
        return std::ranges::any_of(study.factors, [&](const Factor& factor) {
          return find_level(factor, level) != nullptr;
        });
      };
      if (group.levels.empty()) throw ConfigError(where + ": a group needs a level");
      if (std::ranges::all_of(group.levels, known) &&
          std::ranges::none_of(study.factors, has_all)) {
        throw ConfigError(where + ": the levels of a group are of one factor");
      }
      for (const std::string& level : group.levels) {
        if (study.split.empty() && !known(level)) {
          throw ConfigError(fmt::format("{}: no factor has a level '{}'", where, level));
        }
        if (std::ranges::find(taken, level) != taken.end()) {
          throw ConfigError(fmt::format("{}: level '{}' is of two groups", where, level));
        }
        taken.push_back(level);
      }
    });
  }
}

}  // namespace vantage
