// metrics.json of a run, compared, measured and made a page of.
#include <nlohmann/json.hpp>

#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/core/error.hpp"
#include "vantage/report/former_run.hpp"
#include "vantage/report/report.hpp"
#include "vantage/study/compare.hpp"
#include "vantage/study/measures.hpp"
#include "vantage/study/results.hpp"

namespace vantage::fuzz {

namespace {

using Json = nlohmann::ordered_json;

/// As a study measures it, which takes what JSON lacks for an answer.
void measure_as(const Task& task, const InputFolder& folder) {
  try {
    ResolvedEpisode episode;
    episode.task = task;
    Json metrics = read_json_or_null(folder.path() / "run/metrics.json");
    bring_up_to_date(metrics);
    measure(metrics, episode);
  } catch (const nlohmann::json::exception&) {
  }
}

}  // namespace

void read_input(std::string_view bytes, const InputFolder& folder) {
  folder.put("run/metrics.json", bytes);
  for_each_task([&](const auto& task) { measure_as(Task{task}, folder); });
  comparison_json(compare_folders(folder.path() / "run", folder.path() / "run", 0.01), 0.01);
}

}  // namespace vantage::fuzz
