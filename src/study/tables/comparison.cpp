#include "vantage/study/tables/comparison.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

#include "vantage/study/figures/figure.hpp"

namespace vantage {
namespace {

constexpr std::uint64_t kSeed = 1;

struct Group {
  std::string panel;
  std::optional<std::size_t> only;  ///< none: every panel
};

/// Mean of the draws of one pair.
struct PairMean {
  double sum = 0.0;
  double draws = 0.0;
  std::size_t cluster = 0;
  [[nodiscard]] double value() const { return sum / draws; }
};
using Pairs = std::map<std::size_t, PairMean>;

Pairs values_by_pair(const std::vector<Sample>& samples, const Group& group, std::size_t level) {
  Pairs values;
  for (const Sample& sample : samples) {
    if (sample.level == level && (!group.only || sample.panel == *group.only)) {
      PairMean& pair = values[sample.pair];
      pair.sum += sample.value;
      pair.draws += 1.0;
      pair.cluster = sample.cluster.value_or(sample.pair);
    }
  }
  return values;
}

Difference difference(const Pairs& values, const Pairs& reference, const std::string& stream) {
  std::vector<double> ours;
  std::vector<double> theirs;
  std::vector<double> differences;
  std::vector<std::size_t> marks;
  for (const auto& [pair, mine] : values) {
    const auto other = reference.find(pair);
    if (other == reference.end()) continue;
    ours.push_back(mine.value());
    theirs.push_back(other->second.value());
    differences.push_back(ours.back() - theirs.back());
    marks.push_back(mine.cluster);
  }
  Difference result;
  result.pairs = differences.size();
  if (differences.empty()) return result;
  const Clusters clusters = clusters_of(marks);
  result.clusters = clusters.size();
  Rng bootstrap = Rng::stream(kSeed, stream + "/difference");
  Rng ratio = Rng::stream(kSeed, stream + "/ratio");
  Rng test = Rng::stream(kSeed, stream + "/test");
  result.mean = mean(differences);
  result.interval = bootstrap_mean(differences, clusters, bootstrap);
  if (mean(theirs) != 0.0) {
    result.ratio = mean(ours) / mean(theirs);
    result.ratio_interval = bootstrap_ratio(ours, theirs, clusters, ratio);
  }
  result.p_value = sign_flip_p_value(cluster_sums(differences, clusters), test);
  return result;
}

std::vector<Group> groups_of(const std::vector<std::string>& panels) {
  std::vector<Group> groups;
  for (std::size_t i = 0; i < panels.size(); ++i) groups.push_back({panels[i], i});
  if (panels.size() > 1) groups.push_back({"all", std::nullopt});
  return groups;
}

}  // namespace

Comparison compare_levels(std::string name, std::string title,
                          const std::vector<std::string>& panels,
                          const std::vector<std::string>& levels, std::size_t reference,
                          const std::vector<Sample>& samples) {
  Comparison comparison{
      std::move(name), std::move(title), levels.at(reference), {}, Better::unsaid};
  for (const Group& group : groups_of(panels)) {
    const auto reference_values = values_by_pair(samples, group, reference);
    for (std::size_t level = 0; level < levels.size(); ++level) {
      const auto by_pair = values_by_pair(samples, group, level);
      if (by_pair.empty()) continue;
      std::vector<double> values;
      std::vector<std::size_t> marks;
      for (const auto& [pair, one] : by_pair) {
        values.push_back(one.value());
        marks.push_back(one.cluster);
      }
      const Clusters clusters = clusters_of(marks);
      const std::string stream =
          fmt::format("{}/{}/{}", comparison.name, group.panel, levels[level]);
      Rng rng = Rng::stream(kSeed, stream);
      ComparisonRow row{.panel = group.panel,
                        .level = levels[level],
                        .count = values.size(),
                        .clusters = clusters.size(),
                        .mean = mean(values),
                        .interval = bootstrap_mean(values, clusters, rng),
                        .least = std::ranges::min(values),
                        .most = std::ranges::max(values),
                        .difference = std::nullopt};
      if (level != reference) row.difference = difference(by_pair, reference_values, stream);
      if (row.difference && row.difference->pairs == 0) row.difference.reset();
      comparison.rows.push_back(std::move(row));
    }
  }
  return comparison;
}

std::string comparison_csv(const Comparison& comparison) {
  std::string text =
      "panel,level,episodes,mean,low,high,pairs,difference,difference_low,difference_high,ratio,"
      "ratio_low,ratio_high,p_value\n";
  for (const ComparisonRow& row : comparison.rows) {
    text += fmt::format("{},{},{},{},{},", row.panel, row.level, row.count, row.mean,
                        interval_csv(row.interval, row.clusters));
    if (!row.difference) {
      text += ",,,,,,,\n";
      continue;
    }
    const Difference& d = *row.difference;
    text += fmt::format("{},{},{},", d.pairs, d.mean, interval_csv(d.interval, d.clusters));
    text += d.ratio ? fmt::format("{},{},", *d.ratio, interval_csv(*d.ratio_interval, d.clusters))
                    : ",,,";
    text += fmt::format("{}\n", d.p_value);
  }
  return text;
}

nlohmann::ordered_json comparison_json(const Comparison& comparison) {
  using Json = nlohmann::ordered_json;
  const auto interval = [](const Interval& i, std::size_t count) {
    return has_interval(count) ? Json{i.low, i.high} : Json();
  };
  Json json = Json::object();
  for (const ComparisonRow& row : comparison.rows) {
    Json entry = {{"episodes", row.count},
                  {"mean", row.mean},
                  {"interval", interval(row.interval, row.clusters)},
                  {"least", row.least},
                  {"most", row.most}};
    if (row.difference) {
      const Difference& d = *row.difference;
      entry["difference"] = {{"to", comparison.reference},
                             {"pairs", d.pairs},
                             {"mean", d.mean},
                             {"interval", interval(d.interval, d.clusters)},
                             {"p_value", d.p_value}};
      if (d.ratio) {
        entry["difference"]["ratio"] = *d.ratio;
        entry["difference"]["ratio_interval"] = interval(*d.ratio_interval, d.clusters);
      }
    }
    json[row.panel][row.level] = std::move(entry);
  }
  return json;
}

}  // namespace vantage
