#include "vantage/study/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

#include "vantage/core/hash.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/study/study_reading.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

constexpr std::size_t kMaxEpisodes = 100'000;

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

/// Whether an episode can begin is asked once for each of these and each level.
std::string start_of(const EpisodeSetup& setup) {
  const RobotOptions& robot = setup.options.robot;
  const auto pose = robot.start_pose.value_or(std::array{0.0, 0.0, 0.0});
  return fmt::format("{}\n{}\n{}\n{}", setup.scene.string(), setup.robot.description.string(),
                     robot.start_site, fmt::join(pose, " "));
}

/// A draw that no other episode has: those of one start in two scenes would share it.
void draw_anew(const std::string& key, const std::string& episode, Overrides& overrides) {
  constexpr std::uint64_t kDraws = 1'000'000'000;
  for (auto& [name, value] : overrides) {
    if (name == key) value.scalar = fmt::to_string(1 + hash_bytes(episode) % kDraws);
  }
}

PlannedEpisode planned(const Study& study, ConfigNode root, EpisodeLevels levels) {
  PlannedEpisode episode{std::move(levels.name), std::move(levels.levels), {}};
  Overrides overrides = study.set;
  for (std::size_t f = 0; f < episode.levels.size(); ++f) {
    const Level& level = study.factors[f].levels[episode.levels[f]];
    overrides.insert(overrides.end(), level.overrides.begin(), level.overrides.end());
  }
  if (!study.draws.empty()) draw_anew(study.draws, episode.name, overrides);
  set_values(root, std::move(overrides));
  episode.resolved = resolve_episode(root, study.episode);
  return episode;
}

/// What a validation has tried: each start once, and each level, which may hold more.
struct Tried {
  std::set<std::string> starts;
  std::set<std::pair<std::size_t, std::string>> levels;  ///< of which factor
};

void try_starts(const fs::path& file, StudyReading& reading, Tried& tried) {
  const Study& study = reading.study;
  for (const PlannedEpisode& episode : plan_episodes(study, reading.problems)) {
    bool is_new = tried.starts.insert(start_of(episode.resolved.setup)).second;
    for (std::size_t f = 0; f < episode.levels.size(); ++f) {
      const std::string& level = study.factors[f].levels[episode.levels[f]].name;
      is_new = tried.levels.insert({f, level}).second || is_new;
    }
    if (!is_new) continue;
    reading.problems.attempt([&] { require_start(file, episode.resolved); });
  }
}

/// One without a name where the study has none, or wrong ones.
std::vector<std::string> names_of_splits(const fs::path& file) {
  const ConfigNode root = read_yaml(file);
  const ConfigNode* splits = root.find("splits");
  if (splits == nullptr || splits->entries.empty()) return {{}};
  std::vector<std::string> names;
  for (const auto& [name, levels] : splits->entries) names.push_back(name);
  return names;
}

}  // namespace

bool is_study(const fs::path& file) {
  if (file.extension() != ".yaml" && file.extension() != ".yml") return false;
  try {
    const ConfigNode root = read_yaml(file);
    return std::ranges::any_of(std::array{"factors", "episode", "seeds"},
                               [&](const char* key) { return root.find(key) != nullptr; });
  } catch (const Error&) {
    return false;
  }
}

Validation validate_study(const fs::path& file) {
  return validation_of([&] {
    Problems problems;
    Tried tried;
    for (const std::string& split : names_of_splits(file)) {
      StudyReading reading = read_study_file(file, {}, split);
      try_starts(file, reading, tried);
      problems.attempt([&] { reading.problems.throw_if_any(); });
    }
    return Validation{problems.texts(), {}, problems.code()};
  });
}

Study read_study(const fs::path& file, const std::vector<std::string>& overrides,
                 const std::string& split) {
  StudyReading reading = read_study_file(file, overrides, split);
  reading.problems.throw_if_any();
  return std::move(reading.study);
}

std::vector<EpisodeLevels> episode_levels(const Study& study) {
  std::vector<EpisodeLevels> episodes;
  const std::size_t count = episode_count(study);
  for (std::size_t number = 0; number < count; ++number) {
    EpisodeLevels episode{{}, levels_of(study, number)};
    for (std::size_t f = 0; f < episode.levels.size(); ++f) {
      episode.name += (f == 0 ? "" : "/") + study.factors[f].levels[episode.levels[f]].name;
    }
    episodes.push_back(std::move(episode));
  }
  return episodes;
}

std::vector<PlannedEpisode> plan_episodes(const Study& study, Problems& problems) {
  std::vector<PlannedEpisode> plan;
  std::vector<EpisodeLevels> all;
  ConfigNode base;
  if (study.episode.empty() || !problems.attempt([&] {
        all = episode_levels(study);
        base = read_yaml(study.episode);
      })) {
    return plan;
  }
  for (EpisodeLevels& levels : all) {
    problems.attempt([&] { plan.push_back(planned(study, base, std::move(levels))); });
  }
  return plan;
}

std::vector<KeyDescription> study_keys() {
  const auto key = [](const char* name, const char* type, const char* text) {
    return KeyDescription{.key = name, .type = type, .text = text};
  };
  std::vector<KeyDescription> keys{
      key("title", "text",
          "of the study's report; default: the name of its file, or of the folder of its results"),
      key("episode", "text", "file of the episode that every episode of the study begins with"),
      key("set", "section", "overrides of it, keys as those of --set"),
      key("factors", "section",
          "name of a factor: name of a level: overrides; the study is the product of all levels, "
          "the last factor changes fastest"),
      key("seeds", "1..20, or a list of whole numbers",
          "a factor called seed, a level for each; beside factors the last one"),
      key("splits", "section",
          "name of a split: name of a factor: list of its levels; a factor that a split does not "
          "name keeps all. Choose on one split, report on another"),
      key("split", "text", "the split that is run; default: the first. `--split` overrides it"),
      key("draws", "text",
          "key of an option that numbers random sequences, `choice.draw` say: every episode that "
          "sets it gets a number of its own, of its name, so that episodes of one seed in two "
          "scenes share no sequence; default: the numbers are as the levels say"),
      key("report", "section", "what is made of the results"),
      key("report.groups", "section",
          "name: list of levels of one factor that go by that name in panels and comparisons; "
          "draws of one pair are averaged")};
  for (KeyDescription& described : keys) described.section = described.type == "section";
  StudyReport report;
  report.fields(FieldDescriber(keys, "report."));
  return keys;
}

std::vector<PlannedEpisode> plan_study(const Study& study) {
  Problems problems;
  std::vector<PlannedEpisode> plan = plan_episodes(study, problems);
  problems.throw_if_any();
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
