#include "vantage/study/recognition/recognition_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

std::string with_interval(const Estimate& e) {
  if (std::isnan(e.mean)) return "-";
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", e.mean, e.interval.low, e.interval.high);
}

/// "-" where there is none.
std::string number(const std::optional<double>& value, int digits) {
  return value ? fmt::format("{:.{}f}", *value, digits) : "-";
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

std::string reliability_table(const std::vector<MethodSummary>& all) {
  std::string text =
      "| method | accuracy % | mean probability % | expected calibration error |\n"
      "|---|---|---|---|\n";
  for (const MethodSummary& m : all) {
    if (!m.reliability) continue;
    const Estimate error{
        100.0 * m.reliability->error,
        {100.0 * m.reliability->error_interval.low, 100.0 * m.reliability->error_interval.high}};
    text +=
        fmt::format("| {} | {:.2f} | {:.2f} | {} |\n", m.method, 100.0 * m.reliability->accuracy,
                    100.0 * m.reliability->confidence, with_interval(error));
  }
  return text;
}

std::string unknown_table(const std::vector<MethodSummary>& all) {
  std::string text =
      "| method | area under the curve | false alarms % at 90 % found | found % above 0.5 | known "
      "ones above 0.5 % | category right %, known | held for of no known category %, unknown |\n"
      "|---|---|---|---|---|---|---|\n";
  const auto percent = [](double share) {
    return std::isnan(share) ? std::string("-") : fmt::format("{:.1f}", 100.0 * share);
  };
  for (const MethodSummary& m : all) {
    if (!m.unknown) continue;
    const UnknownDetection& u = *m.unknown;
    text += fmt::format(
        "| {} | {:.4f} [{:.4f}, {:.4f}] | {:.2f} [{:.2f}, {:.2f}] | {} | {} | {} | {} |\n",
        m.method, u.area, u.area_interval.low, u.area_interval.high, 100.0 * u.false_alarms,
        100.0 * u.false_alarms_interval.low, 100.0 * u.false_alarms_interval.high, percent(u.found),
        percent(u.known_missed), percent(u.category_known_right),
        percent(u.category_unknown_right));
  }
  return text;
}

/// Changes that the model does not tell from none are counted, and counted apart.
std::string change_table(const RecognitionStudy& study) {
  std::string text =
      "| what changed | method | accuracy % | of detectable ones % | those are % | says which % | "
      "observations | cost s |\n|---|---|---|---|---|---|---|---|\n";
  for (const ChangeTrials& change : study.changes) {
    const Json j = change_json(change);
    const auto value = [&](const char* key) { return j[key].get<double>(); };
    const std::string detectable =
        std::isnan(value("detectable_percent")) ? "-" : number(value("detectable_percent"), 2);
    const bool none = change.scenario == Change::none;
    text += fmt::format("| {} | {} | {:.2f} | {} | {} | {:.2f} | {:.2f} | {:.4f} |\n",
                        to_string(change.scenario), change.method, value("accuracy_percent"),
                        none ? "-" : detectable,
                        none ? "-" : fmt::format("{:.1f}", value("detectable_share_percent")),
                        value("kind_percent"), value("observations"), value("time_s"));
  }
  return text;
}

}  // namespace

bool shows_unknown(const RecognitionStudy& study) {
  return std::ranges::any_of(study.methods,
                             [](const MethodTrials& m) { return !m.unknown.trials.empty(); });
}

nlohmann::ordered_json change_json(const ChangeTrials& change) {
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

namespace {

/// Nothing if all objects are known.
std::string unseen_text(const RecognitionStudy& study) {
  std::set<std::string> unseen, seen;
  for (const Trial& trial : study.methods.front().trials) {
    (trial.object < 0 ? unseen : seen).insert(trial.name);
  }
  if (unseen.empty()) return {};
  if (seen.empty()) {
    return fmt::format(
        "None of the {} objects is in the model, so that the accuracy is of none; of the category, "
        "unknown is right where the model does not have it ({}).\n\n",
        unseen.size(), fmt::join(unseen, ", "));
  }
  return fmt::format(
      "{} of {} objects are not in the model: accuracy is that of the others, category that of all "
      "({}).\n\n",
      unseen.size(), unseen.size() + seen.size(), fmt::join(unseen, ", "));
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
  text += "\n## Probabilities\n\nOf the estimate, in " + std::to_string(kReliabilityBins) +
          " bins of equal width; intervals over objects.\n\n" + reliability_table(all);
  if (shows_unknown(study)) {
    text += fmt::format(
        "\n## Unknown objects\n\nBy the probability that it is none of the model's objects; {} "
        "starts of unknown ones; intervals over objects.\n\n",
        study.options.unknown_starts);
    text += unknown_table(all);
  }
  if (!study.changes.empty()) text += "\n## Change detection\n\n" + change_table(study);
  return text;
}

}  // namespace vantage
