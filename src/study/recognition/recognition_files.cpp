#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <array>
#include <set>
#include <string>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/runtime/json.hpp"
#include "vantage/runtime/manifest.hpp"
#include "vantage/study/recognition/recognition_study.hpp"

namespace vantage {
namespace {
using Json = nlohmann::ordered_json;

constexpr auto kStudyFiles = std::to_array<const char*>(
    {"config.yaml", "results.csv", "changes.csv", "recognition.md", "summary.json"});

std::string with_interval(const Estimate& e) {
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", e.mean, e.interval.low, e.interval.high);
}

Json json_of(const Estimate& e) {
  return {{"mean", e.mean}, {"interval", {e.interval.low, e.interval.high}}};
}

Json json_of(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

/// "-" where there is none.
std::string number(const std::optional<double>& value, int digits) {
  return value ? fmt::format("{:.{}f}", *value, digits) : "-";
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
  return json;
}

Json json_of(const ChangeTrials& change) {
  double observations = 0.0;
  double time_s = 0.0;
  for (const ChangeTrial& trial : change.trials) {
    observations += trial.observations;
    time_s += trial.time_s;
  }
  const auto count = static_cast<double>(change.trials.size());
  return {{"scenario", to_string(change.scenario)},
          {"method", change.method},
          {"accuracy_percent", 100.0 * change.accuracy()},
          {"kind_percent", 100.0 * change.kind_accuracy()},
          {"detectable_percent", 100.0 * change.detectable_accuracy()},
          {"detectable_share_percent", 100.0 * change.detectable_share()},
          {"observations", observations / count},
          {"time_s", time_s / count}};
}

Json summary_json(const RecognitionStudy& study) {
  Json json{{"objects", study.states.objects.size()},
            {"categories", study.states.categories.size()},
            {"starts", study.options.starts},
            {"seed", study.options.seed},
            {"commit", version_text()},
            {"methods", Json::array()},
            {"changes", Json::array()}};
  for (const MethodSummary& summary : summaries(study)) json["methods"].push_back(json_of(summary));
  for (const ChangeTrials& change : study.changes) json["changes"].push_back(json_of(change));
  return json;
}

std::string trials_csv(const RecognitionStudy& study) {
  std::string csv =
      "method,start,object,estimate,correct,category_correct,observations,bin_error,features,"
      "entropy_bits,feature_time_s,selection_time_s,view_time_s\n";
  const auto name = [&](int object) {
    return study.states.objects[static_cast<std::size_t>(object)];
  };
  for (const MethodTrials& method : study.methods) {
    for (std::size_t i = 0; i < method.trials.size(); ++i) {
      const Trial& t = method.trials[i];
      csv += fmt::format("\"{}\",{},{},{},{:d},{:d},{},", method.method, i, t.name,
                         name(t.estimate), t.correct, t.category_correct, t.observations);
      csv += method.label_only
                 ? ",,,,,\n"
                 : fmt::format("{},{},{:.6g},{:.6g},{:.6g},{:.6g}\n", t.bin_error, t.features,
                               t.entropy_bits, t.feature_time_s, t.selection_time_s, t.view_time_s);
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

std::string method_table(const std::vector<MethodSummary>& all) {
  std::string text =
      "| method | accuracy % | category % | observations | bin error | features | feature s | "
      "selection s | view s | total s |\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (const MethodSummary& m : all) {
    const std::optional<double> total_s =
        m.feature_time_s ? std::optional(*m.feature_time_s + *m.selection_time_s + *m.view_time_s)
                         : std::nullopt;
    text +=
        fmt::format("| {} | {} | {:.2f} | {} | {} | {} | {} | {} | {} | {} |\n", m.method,
                    with_interval(m.accuracy_percent), m.category_percent,
                    with_interval(m.observations), m.bin_error ? with_interval(*m.bin_error) : "-",
                    number(m.features, 2), number(m.feature_time_s, 4),
                    number(m.selection_time_s, 4), number(m.view_time_s, 4), number(total_s, 4));
  }
  return text;
}

std::string difference_table(const std::vector<MethodSummary>& all) {
  std::string text =
      "| method | less | accuracy, points | p | observations |\n|---|---|---|---|---|\n";
  for (const MethodSummary& m : all) {
    for (const PairedEstimate& d : m.differences) {
      text +=
          fmt::format("| {} | {} | {} | {:.2g} | {} |\n", m.method, d.reference,
                      with_interval(d.accuracy_percent), d.p_value, with_interval(d.observations));
    }
  }
  return text;
}

/// Nothing if all objects are known.
std::string unseen_text(const RecognitionStudy& study) {
  std::set<std::string> unseen, seen;
  for (const Trial& trial : study.methods.front().trials) {
    (trial.object < 0 ? unseen : seen).insert(trial.name);
  }
  if (unseen.empty()) return {};
  return fmt::format(
      "{} of {} objects are not in the model: accuracy is that of the others, category that of all "
      "({}).\n\n",
      unseen.size(), unseen.size() + seen.size(), fmt::join(unseen, ", "));
}

/// Changes that the model does not tell from none are counted, and counted apart.
std::string change_table(const RecognitionStudy& study) {
  std::string text =
      "| what changed | method | accuracy % | of detectable ones % | those are % | says which % | "
      "observations | cost s |\n|---|---|---|---|---|---|---|---|\n";
  for (const ChangeTrials& change : study.changes) {
    const Json j = json_of(change);
    const auto value = [&](const char* key) { return j[key].get<double>(); };
    const bool none = change.scenario == Change::none;
    text += fmt::format("| {} | {} | {:.2f} | {} | {} | {:.2f} | {:.2f} | {:.4f} |\n",
                        to_string(change.scenario), change.method, value("accuracy_percent"),
                        none ? "-" : fmt::format("{:.2f}", value("detectable_percent")),
                        none ? "-" : fmt::format("{:.1f}", value("detectable_share_percent")),
                        value("kind_percent"), value("observations"), value("time_s"));
  }
  return text;
}

}  // namespace

std::string recognition_tables(const RecognitionStudy& study) {
  const std::vector<MethodSummary> all = summaries(study);
  std::string text = fmt::format(
      "# Recognition of {} objects in {} categories\n\n{} starts, the same for every method; means "
      "with 95 % bootstrap intervals, over objects. Features are counted at their measured "
      "cost.\n\n",
      study.states.objects.size(), study.states.categories.size(), study.options.starts);
  text += unseen_text(study) + method_table(all) + "\n## Paired differences\n\n" +
          difference_table(all);
  if (!study.changes.empty()) text += "\n## Change detection\n\n" + change_table(study);
  return text;
}

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
  if (study.changes.empty()) {
    std::error_code ignored;
    std::filesystem::remove(directory / "changes.csv", ignored);  // of a study that is replaced
  } else {
    write_file(directory / "changes.csv", changes_csv(study));
  }
  write_file(directory / "recognition.md", recognition_tables(study));
  write_file(directory / "summary.json", json_text(summary_json(study)));
}

}  // namespace vantage
