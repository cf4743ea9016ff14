#include "vantage/planners/swept_gain.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "vantage/core/cancellation/stop_poll.hpp"
#include "vantage/core/parallel_for.hpp"

namespace vantage {
namespace {

/// Views from one position.
struct Station {
  std::vector<SweptView> views;
  std::vector<std::size_t> candidates;  ///< index of each view in the list of candidates
};

std::vector<Station> stations_of(std::span<const Candidate> candidates, const FieldOfView& field,
                                 const SweepOptions& options) {
  std::vector<Station> stations;
  std::map<std::array<double, 3>, std::size_t> station_at;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const ViewCone view(candidates[i].T_world_sensor, field);
    const Eigen::Vector3d& p_m = view.apex_m();
    const auto [known, is_new] =
        station_at.try_emplace({p_m.x(), p_m.y(), p_m.z()}, stations.size());
    if (is_new) stations.emplace_back();
    Station& station = stations[known->second];
    station.views.push_back({view, options, nullptr});
    station.candidates.push_back(i);
  }
  return stations;
}

/// The sum of each of the `count` candidates; 0 for those of no station.
std::vector<SampledSum> sum_views(const SweepTables& tables, std::span<const Station> stations,
                                  std::size_t count, int threads) {
  std::vector<std::vector<SampledSum>> parts(stations.size() * kPyramids.size());
  parallel_for(parts.size(), threads, [&](std::size_t i) {
    parts[i] = sweep_pyramid(tables, stations[i / kPyramids.size()].views,
                             kPyramids[i % kPyramids.size()]);
    poll_stop();
  });
  std::vector<SampledSum> sums(count);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Station& station = stations[i / kPyramids.size()];
    for (std::size_t view = 0; view < station.views.size(); ++view) {
      sums[station.candidates[view]] += parts[i][view];
    }
  }
  return sums;
}

/// The stations with views that are not settled, rays to be walked for those alone. The others keep
/// their part in how far the light is worked out, so that it is the same again.
std::vector<Station> unsettled(std::span<const SampledSum> sums,
                               std::span<const Station> stations) {
  std::vector<Station> left;
  for (Station station : stations) {
    bool any = false;
    for (std::size_t view = 0; view < station.views.size(); ++view) {
      const bool settled = sums[station.candidates[view]].is_settled();
      station.views[view].options = settled ? kNoRays : kEveryRay;
      any = any || !settled;
    }
    if (any) left.push_back(std::move(station));
  }
  return left;
}

}  // namespace

bool can_sweep(const Gain& gain) {
  return std::visit([]<class G>(const G&) { return AttenuationGain<G>; }, gain);
}

Attenuation attenuation_of(const Gain& gain, const GainContext& context) {
  expects(can_sweep(gain), "a gain that can be swept");
  return std::visit(
      [&]<class G>(const G& g) -> Attenuation {
        if constexpr (AttenuationGain<G>) return g.attenuation(context);
        return {};
      },
      gain);
}

std::vector<double> view_gains_bits(const Gain& gain, const GainContext& context,
                                    std::span<const Candidate> candidates,
                                    const FieldOfView& field_of_view, int threads) {
  return std::visit(
      [&](const auto& g) {
        return view_gains_bits(g, context, candidates, field_of_view, threads);
      },
      gain);
}

std::vector<double> swept_gains_bits(const Gain& gain, const GainContext& context,
                                     std::span<const Candidate> candidates,
                                     const FieldOfView& field_of_view, int threads,
                                     const SweepOptions& options) {
  return swept_gains_bits(attenuation_of(gain, context), context.grid, candidates, field_of_view,
                          threads, options);
}

std::vector<double> swept_gains_bits(const Attenuation& attenuation, const OccupancyGrid& grid,
                                     std::span<const Candidate> candidates,
                                     const FieldOfView& field_of_view, int threads,
                                     const SweepOptions& options) {
  expects(threads >= 1, "swept_gains_bits needs a thread");
  const SweepTables tables(grid, attenuation, threads);
  const auto stations = stations_of(candidates, field_of_view, options);
  const auto sums = sum_views(tables, stations, candidates.size(), threads);
  const auto exact = sum_views(tables, unsettled(sums, stations), candidates.size(), threads);
  std::vector<double> gains_bits;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double gain_bits =
        sums[i].is_settled() ? sums[i].estimate : sums[i].settled_by(exact[i].estimate);
    // Below zero is rounding, or half a sample more than four standard errors off.
    gains_bits.push_back(std::max(gain_bits, 0.0));
  }
  return gains_bits;
}

}  // namespace vantage
