// The office decision: up to 30 panoramas by the sweep, by exact rays and by castRay, on maps that
// an episode in each of two offices builds.
#include <filesystem>

#include "bench/castray.hpp"
#include "bench/measures.hpp"
#include "bench/situation.hpp"
#include "vantage/core/log.hpp"
#include "vantage/tasks/exploration/exploration_session.hpp"

namespace vantage::bench {
namespace {
namespace fs = std::filesystem;

constexpr const char* kSmall = "assets/episodes/office_small.yaml";
constexpr const char* kLarge = "assets/episodes/office_large.yaml";
/// Every `kEvery`-th decision is held against exact rays: each of those takes a while.
constexpr std::size_t kEvery = 4;

std::vector<Situation> situations_of(const char* episode_file, const fs::path& directory,
                                     std::string& configuration) {
  const auto resolved = load_episode(episode_file, {"scans=14"});
  const RunRequest request = lean_request(resolved, directory);
  configuration += request.config;
  ExplorationSession<Watched<ExplorationParts>> session(request,
                                                        std::get<Exploration>(resolved.task));
  run_episode(session.parts);
  std::vector<Situation>& situations = session.parts.situations;
  std::vector<Situation> kept;
  for (std::size_t i = 0; i < situations.size(); i += kEvery) {
    kept.push_back(std::move(situations[i]));
  }
  return kept;
}

void run_benchmark() {
  const fs::path directory = fs::temp_directory_path() / "vantage_bench_office";
  fs::create_directories(directory);
  Agreement agreement;
  const Situation* most = nullptr;
  std::string configuration;
  const std::vector<Situation> small = situations_of(kSmall, directory, configuration);
  const std::vector<Situation> large = situations_of(kLarge, directory, configuration);
  for (const auto* situations : {&small, &large}) {
    for (const Situation& situation : *situations) {
      agreement.compare(SimpleGain{}, situation);
      agreement.compare(AdaptiveGain{}, situation);
      if (most == nullptr || situation.views.size() > most->views.size()) most = &situation;
    }
  }
  fs::remove_all(directory);
  const Task task = load_episode(kSmall, {}).task;
  const auto beams = image_beams(std::get<Exploration>(task).camera, most->field);
  const double castray = castray_ms(*most, beams, kThreads);  // a view is millions of rays
  print_decision("office", configuration, time_both(AdaptiveGain{}, *most), castray, agreement);
  print_figures("office_views", kThreads, configuration,
                {{"views", static_cast<double>(most->views.size())}});
}

}  // namespace
}  // namespace vantage::bench

int main() { return vantage::bench::run_main(vantage::bench::run_benchmark); }
