// Writes bench/RESULTS.md, claims first, and the pages behind it from what benchmarks and studies
// left in bench/results.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>

#include "bench/claims/claims.hpp"
#include "bench/claims/recognition_claims.hpp"
#include "bench/measures.hpp"
#include "bench/pages/origins.hpp"
#include "bench/pages/pages.hpp"
#include "bench/pages/study_parts.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/data_root.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/core/yaml.hpp"

namespace vantage::bench {
namespace {
namespace fs = std::filesystem;

constexpr std::string_view kIntroduction =
    R"(# Results

Written by `bench/run all` and `bench/studies`; not edited by hand. First what is claimed, and whether
it holds; behind the links are the tables. Ratios of times are of one run on one machine. A goal that
names a time, or a multiple of real time, is about the machine named on the page of tables alone: its
times are medians, of `episode` of one run. Ratios and differences carry 95 % bootstrap intervals over
whole scenes, objects, starts or draws, as what is of one is alike; of two scenes it is the range of the
two. Means have theirs in the tables. Differences are paired over the same scene and start, `p` is that
of a sign-flip test, `x` the ratio of the means to the reference method. `scans_to_N` of an episode that
never gets there is all of its plan. Options were chosen on the development split, and on what a study
names; numbers are of the report split.
The dissertation is C. Potthast, *Information Theoretical Action Selection*, USC 2016.

`\*`: the code that it depends on has changed since the commit that it is of. `?`: whether it has is
unknown. `-dirty`: of that commit with changes that were not committed. `bench/studies verify` runs
episodes drawn at random again: how many came to the recorded
state hash, bit by bit, is told under "run again". "configurations" is one hash of those of all
episodes, which `results.csv` has. A claim on numbers that are not all there is "not run".
)";

/// "scene: dev_4, dev_8; start: start_0"
std::string split_text(const ConfigNode& study, const std::string& split) {
  const ConfigNode* splits = study.find("splits");
  const ConfigNode* levels = splits == nullptr ? nullptr : splits->find(split);
  if (levels == nullptr) return "-";
  std::vector<std::string> texts;
  for (const auto& [factor, names] : levels->entries) {
    std::vector<std::string> of_factor;
    for (const ConfigNode& name : names.items) of_factor.push_back(name.scalar);
    texts.push_back(fmt::format("{}: {}", factor, fmt::join(of_factor, ", ")));
  }
  return fmt::format("{}", fmt::join(texts, "; "));
}

fs::path study_file(const std::string& name) {
  return fs::path("assets/studies") / (name + ".yaml");
}

/// "3 of 3 on 5ecfa2e": episodes that `bench/studies verify` ran again to the recorded state hash.
std::string verified_text(const fs::path& file) {
  if (!fs::exists(file)) return "not yet";
  const CsvTable verified = read_csv(file);
  if (verified.rows.empty() || verified.rows.front().size() < 3) return "not yet";
  const auto& row = verified.rows.front();
  return fmt::format("{} of {} on {}", row[2], row[1], row[0]);
}

/// One hash of those of all episodes.
std::string configurations_text(const fs::path& results) {
  const std::set<std::string> hashes = entries_of(results, "config_hash");
  if (hashes.empty()) return "not recorded";
  return hash_text(hash_bytes(fmt::format("{}", fmt::join(hashes, " ")))).substr(0, 8);
}

bool is_of_a_mapping_task(const fs::path& file, const ConfigNode& study) {
  const ConfigNode* episode = study.find("episode");
  if (episode == nullptr) return false;
  const ConfigNode root = read_yaml(find_input(episode->scalar, file.parent_path(), "episode"));
  const ConfigNode* task = root.find("task");
  return task == nullptr || task->scalar == "tabletop" || task->scalar == "exploration";
}

/// A study with what it came to.
struct StudyResult {
  const StudyPart& part;
  StudyTables tables;
};

std::vector<StudyResult> read_studies(const fs::path& directory) {
  std::vector<StudyResult> studies;
  for (const StudyPart& part : study_parts()) {
    studies.push_back(
        {part, StudyTables(study_file(part.name), directory / part.name / "results.csv")});
  }
  return studies;
}

/// What options were chosen on, what is reported, and of what code and machine that is.
std::string splits_table(const fs::path& directory, const std::vector<StudyResult>& studies) {
  std::string text =
      "| study | development split | report split | episodes | commit | configurations | run again "
      "| threads, CPU |\n|---|---|---|---|---|---|---|---|\n";
  for (const auto& [part, study] : studies) {
    const fs::path results = directory / part.name / "results.csv";
    const fs::path timings = directory / part.name / "timings.csv";
    const ConfigNode file = read_yaml(study_file(part.name));
    const bool run = fs::exists(results);
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} {} |\n", part.name,
                        split_text(file, "development"), split_text(file, "report"), study.extent(),
                        run ? commits_text(entries_of(results, "commit"), results,
                                           is_of_a_mapping_task(study_file(part.name), file))
                            : "not run",
                        run ? configurations_text(results) : "-",
                        verified_text(directory / part.name / "verified.csv"),
                        fmt::join(entries_of(timings, "threads"), ", "),
                        fmt::join(entries_of(timings, "cpu"), ", "));
  }
  return text;
}

/// Of the runs that there are results of.
CsvTable bounds_of(const fs::path& study) {
  const fs::path bounds = study / "bounds.csv";
  const fs::path results = study / "results.csv";
  if (!fs::exists(bounds) || !fs::exists(results)) return {};
  return of_results(read_csv(bounds), read_csv(results));
}

/// Nothing, where it was not run.
Json json_or_nothing(const fs::path& file) {
  return fs::exists(file) ? read_json(file) : Json::object();
}

std::string reliability_picture(const fs::path& folder) {
  if (!fs::exists(folder / "unknown" / "reliability.svg")) return "";
  return "\n![Reliability of P(object)](results/recognition/unknown/reliability.svg)\n";
}

/// ", 2 threads of AMD EPYC"; "" of summaries that do not say.
std::string machine_text(const Json& summary) {
  if (!summary.contains("cpu") || !summary.contains("threads")) return "";
  return fmt::format(", {} threads of {}", summary["threads"].get<int>(),
                     summary["cpu"].get<std::string>());
}

/// Summaries that `vantage evaluate` wrote, and of which code each is.
class Evaluations {
 public:
  explicit Evaluations(fs::path folder) : folder_(std::move(folder)) {}

  Json summary(const std::string& part) {
    const fs::path file = folder_ / part / "summary.json";
    Json json = json_or_nothing(file);
    if (json.empty()) return json;
    const Json commit = json.value("commit", Json());
    const bool known = commit.is_string();
    parts_[commits_text(known ? std::set{commit.get<std::string>()} : std::set<std::string>{},
                        file) +
           machine_text(json)]
        .push_back(known ? part : part + " (intervals are over single starts)");
    return json;
  }
  /// "of 504fd34 \\*: unknown"
  [[nodiscard]] std::string commits() const {
    std::vector<std::string> texts;
    for (const auto& [commit, parts] : parts_) {
      texts.push_back(fmt::format("of {}: {}", commit, fmt::join(parts, ", ")));
    }
    return fmt::format("{}", fmt::join(texts, "; "));
  }

 private:
  fs::path folder_;
  std::map<std::string, std::vector<std::string>> parts_;
};

/// Of recognition, with simple features and kernel descriptors.
std::string recognition_claims(const fs::path& folder) {
  Evaluations evaluations(folder);
  const auto summary = [&](const char* part) { return evaluations.summary(part); };
  std::vector<Finding> findings = recognition_findings(summary("simple"));
  const auto add = [&](const std::vector<Finding>& more) {
    findings.insert(findings.end(), more.begin(), more.end());
  };
  add(change_findings(summary("changes")));
  add(kernel_findings(summary("kernel"), summary("simple_same_objects")));
  const Json unknown = summary("unknown");
  add(unknown_findings(unknown, "families left out"));
  add(unknown_findings(summary("unknown_scanned"), "scanned objects"));
  add(reliability_findings(unknown));
  return "`bench/studies recognition` and `bench/studies unknown`; " + evaluations.commits() +
         ". Options were chosen on objects of seed 1. Those of `recognition` are of seed 31, drawn "
         "for this report: one on seed 1 had shown a fault, which was mended. `unknown` is of "
         "recordings, and scanned objects, that its model was not trained on.\n\n" +
         findings_table(findings) + reliability_picture(folder);
}

struct Benchmarks {
  Figures figures;
  Origins origins;
};

Benchmarks read_benchmarks(const fs::path& directory) {
  Benchmarks all;
  for (const auto& entry : fs::directory_iterator(directory)) {
    const fs::path& file = entry.path();
    if (file.extension() != ".json") continue;
    const Json benchmark = read_json(file);
    const auto name = benchmark.at("name").get<std::string>();
    all.figures.emplace(name, benchmark.at("figures"));
    all.origins[name] = {marked_commit(name, benchmark.at("commit").get<std::string>(), file),
                         benchmark.value("config_hash", ""), benchmark.at("threads").get<int>(),
                         benchmark.at("cpu").get<std::string>()};
  }
  return all;
}

/// "of 57e465af \\*: decision, office; of ..": which benchmark is of which commit.
std::string commits_of(const Origins& origins) {
  std::map<std::string, std::vector<std::string>> by_commit;
  for (const auto& [name, origin] : origins) by_commit[origin.commit].push_back(name);
  std::vector<std::string> parts;
  for (const auto& [commit, names] : by_commit) {
    parts.push_back(fmt::format("of {}: {}", commit, fmt::join(names, ", ")));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string link(const std::string& page) { return fmt::format("\n[Tables](results/{}).\n", page); }

void write_results(const fs::path& directory) {
  const auto [figures, origins] = read_benchmarks(directory);
  const std::vector<StudyResult> studies = read_studies(directory);
  std::vector<Finding> speed = speed_findings(figures);
  std::ranges::move(study_time_findings("assets/studies", directory), std::back_inserter(speed));
  std::string text = std::string(kIntroduction) + "\n" + splits_table(directory, studies);
  text += "\n## Speed\n\n`bench/run all`; " + commits_of(origins) + "\n\n" + findings_table(speed) +
          link(write_speed_page(directory, figures, origins));
  for (const auto& [part, study] : studies) {
    std::vector<Finding> findings = part.findings(study);
    if (part.is_bounded) {
      findings.push_back(
          above_the_bound(StudyTables(study_file(part.name), bounds_of(directory / part.name))));
    }
    text += fmt::format("\n## {}\n\n`bench/studies {}`. {}\n\n", part.title, part.name,
                        opening_comment(study_file(part.name))) +
            findings_table(findings) +
            link(write_study_page(directory, part.name, part.title, study, part.tables));
  }
  text += "\n## Recognition (Tables 4.2-4.7, 4.10-4.15, Fig. 4.4)\n\n" +
          recognition_claims(directory / "recognition") + link(write_recognition_page(directory));
  text +=
      "\n## The cost of a flight ((5.8) - (5.11))\n\nAs (5.8) - (5.11) print it and as it is "
      "flown: [figures](results/" +
      write_cost_page(directory) + ").\n";
  write_file(directory.parent_path() / "RESULTS.md", text);
}

}  // namespace
}  // namespace vantage::bench

int main() {
  return vantage::bench::run_main([] { vantage::bench::write_results("bench/results"); });
}
