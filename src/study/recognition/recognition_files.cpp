#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/runtime/manifest.hpp"
#include "vantage/study/recognition/recognition_study.hpp"
#include "vantage/study/recognition/recognition_tables.hpp"

namespace vantage {
namespace {
using Json = nlohmann::ordered_json;

constexpr auto kStudyFiles = std::to_array<const char*>(
    {"config.yaml", "results.csv", "unknown.csv", "changes.csv", "recognition.md", "summary.json",
     "reliability.svg", "reliability.csv"});

Json json_of(const Estimate& e) {
  return {{"mean", e.mean}, {"interval", {e.interval.low, e.interval.high}}};
}

Json json_of(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json json_of(const Interval& interval) { return {interval.low, interval.high}; }

Json json_of(const Reliability& reliability) {
  Json json{{"expected_calibration_error", reliability.error},
            {"interval", json_of(reliability.error_interval)},
            {"confidence", reliability.confidence},
            {"bins", Json::array()}};
  for (const ReliabilityBin& bin : reliability.bins) {
    if (bin.count == 0) continue;
    json["bins"].push_back({{"trials", bin.count},
                            {"objects", bin.objects},
                            {"confidence", bin.confidence},
                            {"accuracy", bin.accuracy},
                            {"interval", json_of(bin.interval)}});
  }
  return json;
}

/// null of NaN.
Json json_of(const UnknownDetection& unknown) {
  return {{"area_under_curve", unknown.area},
          {"area_interval", json_of(unknown.area_interval)},
          {"threshold_at_90_percent_found", unknown.threshold},
          {"false_alarms_at_90_percent_found", unknown.false_alarms},
          {"false_alarms_interval", json_of(unknown.false_alarms_interval)},
          {"found", unknown.found},
          {"known_held_for_unknown", unknown.known_missed},
          {"category_right_where_known", unknown.category_known_right},
          {"category_right_where_unknown", unknown.category_unknown_right}};
}

Json json_of(const MethodSummary& summary) {
  Json json{{"method", summary.method},
            {"accuracy_percent", json_of(summary.accuracy_percent)},
            {"category_percent", summary.category_percent},
            {"category_interval", {summary.category_interval.low, summary.category_interval.high}},
            {"observations", json_of(summary.observations)},
            {"bin_error", summary.bin_error ? json_of(*summary.bin_error) : Json(nullptr)},
            {"features", json_of(summary.features)},
            {"feature_time_s", json_of(summary.feature_time_s)},
            {"selection_time_s", json_of(summary.selection_time_s)},
            {"view_time_s", json_of(summary.view_time_s)},
            {"differences", Json::array()}};
  for (const PairedEstimate& d : summary.differences) {
    json["differences"].push_back({{"reference", d.reference},
                                   {"accuracy_percent", json_of(d.accuracy_percent)},
                                   {"observations", json_of(d.observations)},
                                   {"p_value", d.p_value}});
  }
  json["reliability"] = summary.reliability ? json_of(*summary.reliability) : Json(nullptr);
  json["unknown"] = summary.unknown ? json_of(*summary.unknown) : Json(nullptr);
  return json;
}

Json summary_json(const RecognitionStudy& study) {
  Json json{{"objects", study.states.objects.size()},
            {"categories", study.states.categories.size()},
            {"starts", study.options.starts},
            {"unknown_starts", study.options.unknown_starts},
            {"seed", study.options.seed},
            {"commit", version_text()},
            {"config_hash", hash_text(hash_bytes(to_yaml(write_node(study.options))))},
            {"cpu", cpu_name()},
            {"threads", study.threads},
            {"methods", Json::array()},
            {"changes", Json::array()}};
  for (const MethodSummary& summary : summaries(study)) json["methods"].push_back(json_of(summary));
  for (const ChangeTrials& change : study.changes) json["changes"].push_back(change_json(change));
  return json;
}

/// Of a trial's object or estimate.
std::string name_of(const ObjectStates& states, int object) {
  return object < states.object_count() ? states.objects[static_cast<std::size_t>(object)]
                                        : std::string(kUnknown);
}

std::string trials_csv(const RecognitionStudy& study) {
  std::string csv =
      "method,start,object,estimate,correct,category_correct,observations,bin_error,features,"
      "entropy_bits,probability,unknown_probability,feature_time_s,selection_time_s,view_time_s\n";
  const auto name = [&](int object) { return name_of(study.states, object); };
  for (const MethodTrials& method : study.methods) {
    for (std::size_t i = 0; i < method.trials.size(); ++i) {
      const Trial& t = method.trials[i];
      csv +=
          fmt::format("\"{}\",{},{},{},{:d},{:d},{},", method.method, i, csv_field(t.name),
                      csv_field(name(t.estimate)), t.correct, t.category_correct, t.observations);
      csv += method.label_only
                 ? ",,,,,,,\n"
                 : fmt::format("{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", t.bin_error,
                               t.features, t.entropy_bits, t.probability, t.unknown_probability,
                               t.feature_time_s, t.selection_time_s, t.view_time_s);
    }
  }
  return csv;
}

std::string unknown_csv(const RecognitionStudy& study) {
  std::string csv =
      "method,start,object,category_known,estimate,category_correct,observations,unknown_"
      "probability\n";
  for (const MethodTrials& method : study.methods) {
    for (std::size_t i = 0; i < method.unknown.trials.size(); ++i) {
      const Trial& t = method.unknown.trials[i];
      csv += fmt::format("\"{}\",{},{},{:d},{},{:d},{},{:.6g}\n", method.method, i,
                         csv_field(t.name), bool{method.unknown.category_known[i]},
                         csv_field(name_of(study.states, t.estimate)), t.category_correct,
                         t.observations, t.unknown_probability);
    }
  }
  return csv;
}

std::string changes_csv(const RecognitionStudy& study) {
  std::string csv = "scenario,method,start,decision,detectable,p_changed,observations,time_s\n";
  for (const ChangeTrials& change : study.changes) {
    for (std::size_t i = 0; i < change.trials.size(); ++i) {
      const ChangeTrial& t = change.trials[i];
      csv += fmt::format("{},{},{},{},{:d},{:.6g},{},{:.6g}\n", to_string(change.scenario),
                         change.method, i, to_string(t.decision), t.detectable, t.p_changed,
                         t.observations, t.time_s);
    }
  }
  return csv;
}

std::vector<ReliabilityPanel> reliability_panels(const RecognitionStudy& study) {
  std::vector<ReliabilityPanel> panels{{"a single view", {}}, {"views by information", {}}};
  for (const MethodTrials& method : study.methods) {
    if (!method.drawn_as) continue;
    panels[method.several_views ? 1 : 0].methods.emplace_back(
        *method.drawn_as, reliability_of(method.trials, study.options.seed));
  }
  return panels;
}

}  // namespace

void prepare_recognition_study(const std::filesystem::path& directory, bool overwrite) {
  std::error_code ignored;
  for (const char* name : kStudyFiles) {
    if (overwrite || !std::filesystem::exists(directory / name, ignored)) continue;
    refuse_to_replace(fmt::format("--out {}", directory.string()),
                      fmt::format("holds {} already", name));
  }
  make_writable_directory(directory);
}

void write_recognition_study(const RecognitionStudy& study,
                             const std::filesystem::path& directory) {
  make_writable_directory(directory);
  write_file(directory / "config.yaml", to_yaml(write_node(study.options)));
  write_file(directory / "results.csv", trials_csv(study));
  const auto write_or_remove = [&](bool there, const char* name, const auto& text) {
    std::error_code ignored;
    if (there) {
      write_file(directory / name, text());
    } else {
      std::filesystem::remove(directory / name, ignored);  // of a study that is replaced
    }
  };
  write_or_remove(!study.changes.empty(), "changes.csv", [&] { return changes_csv(study); });
  write_or_remove(shows_unknown(study), "unknown.csv", [&] { return unknown_csv(study); });
  const Figure figure = reliability_figure(reliability_panels(study));
  write_or_remove(study.options.reliability, "reliability.svg", [&] { return figure_svg(figure); });
  write_or_remove(study.options.reliability, "reliability.csv", [&] { return figure_csv(figure); });
  write_file(directory / "recognition.md", recognition_tables(study));
  write_file(directory / "summary.json", json_text(summary_json(study)));
}

}  // namespace vantage
