#include "vantage/planners/swept_gain.hpp"

#include <algorithm>
#include <array>

#include "vantage/core/parallel_for.hpp"
#include "vantage/planners/exact_gain.hpp"

namespace vantage {
namespace {

/// Views from one position.
struct Station {
  std::vector<ViewCone> views;
  std::vector<std::size_t> candidates;  ///< index of each view in the list of candidates
};

std::vector<Station> stations_of(std::span<const Candidate> candidates, const FieldOfView& field) {
  std::vector<Station> stations;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const ViewCone view(candidates[i].T_world_sensor, field);
    auto station = std::ranges::find_if(
        stations, [&](const Station& s) { return s.views.front().apex_m() == view.apex_m(); });
    if (station == stations.end()) station = stations.emplace(stations.end());
    station->views.push_back(view);
    station->candidates.push_back(i);
  }
  return stations;
}

}  // namespace

bool can_sweep(const Gain& gain) {
  return std::visit([]<class G>(const G&) { return AttenuationGain<G>; }, gain);
}

std::vector<double> view_gains_bits(const Gain& gain, const GainContext& context,
                                    std::span<const Candidate> candidates,
                                    const FieldOfView& field_of_view, int threads) {
  return can_sweep(gain) ? swept_gains_bits(gain, context, candidates, field_of_view, threads)
                         : exact_gains_bits(gain, context, candidates, field_of_view, threads);
}

std::vector<double> swept_gains_bits(const Gain& gain, const GainContext& context,
                                     std::span<const Candidate> candidates,
                                     const FieldOfView& field_of_view, int threads,
                                     const SweepOptions& options) {
  expects(can_sweep(gain), "a gain that can be swept");
  expects(threads >= 1, "swept_gains_bits needs a thread");
  const Attenuation attenuation = std::visit(
      [&]<class G>(const G& g) -> Attenuation {
        if constexpr (AttenuationGain<G>) return g.attenuation(context);
        return {};
      },
      gain);
  const SweepTables tables(context.grid, attenuation, threads);
  const auto stations = stations_of(candidates, field_of_view);
  std::vector<std::vector<double>> parts(stations.size() * kPyramids.size());
  parallel_for(parts.size(), threads, [&](std::size_t i) {
    parts[i] = sweep_pyramid(tables, stations[i / kPyramids.size()].views,
                             kPyramids[i % kPyramids.size()], options);
  });
  std::vector<double> gains_bits(candidates.size(), 0.0);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Station& station = stations[i / kPyramids.size()];
    for (std::size_t view = 0; view < station.views.size(); ++view) {
      gains_bits[station.candidates[view]] += parts[i][view];
    }
  }
  return gains_bits;
}

}  // namespace vantage
