// What interpolation would cost the hidden Markov model: `visibility_weighted` carried from layer
// to layer as the sweep does it, held against its exact rays. Accuracy only: the code is not tuned.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <optional>

#include "bench/measures.hpp"
#include "bench/situation.hpp"
#include "vantage/geometry/view_cone.hpp"
#include "vantage/planners/exact_gain.hpp"
#include "vantage/planners/visibility/cell_walk.hpp"
#include "vantage/tasks/tabletop/tabletop_session.hpp"

namespace vantage::bench {
namespace {
namespace fs = std::filesystem;

/// p(x = visible) of every cell from one place, each from up to four cells of the layer before.
class InterpolatedChain {
 public:
  InterpolatedChain(const OccupancyGrid& grid, const VisibilityModel& model,
                    const Eigen::Vector3d& p_sensor)
      : grid_(grid),
        model_(model),
        p_sensor_(p_sensor),
        source_((p_sensor - grid.frame.min_corner_m).array() / grid.frame.cell_size_m.array() -
                0.5),
        p_visible_(grid.size(), kUnknown) {
    std::vector<std::pair<double, std::size_t>> order;
    order.reserve(grid.size());
    for (std::size_t cell = 0; cell < grid.size(); ++cell) {
      order.emplace_back(offset(cell).abs().maxCoeff(), cell);
    }
    std::ranges::sort(order);
    for (const auto& [depth, cell] : order) {
      p_visible_[cell] = static_cast<float>(depth < 2.0 ? exact(cell) : from_layer_before(cell));
    }
  }

  [[nodiscard]] double p_visible(std::size_t cell) const {
    return static_cast<double>(p_visible_[cell]);
  }

 private:
  static constexpr float kUnknown = -1.0F;

  [[nodiscard]] Eigen::Array3d offset(std::size_t cell) const {
    return grid_.frame.cell(cell).cast<double>() - source_;
  }

  /// The ray leaves the n-th cell it passes.  [Potthast2016, (3.6)-(3.10)]
  [[nodiscard]] double leave(double visible, double p_occupied, int n) const {
    const double t = std::pow(model_.a, n);
    const double stay = visible * t + (1.0 - visible) * model_.p_reappear;
    const double seen = (1.0 - p_occupied) * stay;
    return seen / (seen + p_occupied * (1.0 - stay));
  }

  [[nodiscard]] double exact(std::size_t target) const {
    VisibilityChain chain(model_);
    walk_to_cell(grid_.frame, p_sensor_, grid_.frame.cell(target), [&](std::size_t cell) {
      chain.pass(grid_.p_occupied(cell));
      return true;
    });
    return chain.p_visible();
  }

  [[nodiscard]] double from_layer_before(std::size_t target) const {
    const GridFrame& frame = grid_.frame;
    const Eigen::Array3d d = offset(target);
    const Eigen::Array3d back = d / d.abs().maxCoeff();
    const Eigen::Vector3d p_target = frame.centre(frame.cell(target));
    const Eigen::Vector3d p_crossing = p_target - (back * frame.cell_size_m.array()).matrix();
    const Eigen::Array3i crossing = frame.cell_at(p_crossing);
    if (!frame.contains(crossing)) return exact(target);
    double visible = interpolated(frame.cell(target).cast<double>() - back);
    int n = cells_passed(crossing);
    bool arrived = false;
    walk_ray(frame, p_crossing, p_target, [&](std::size_t cell) {
      arrived = cell == target;
      if (!arrived) visible = leave(visible, grid_.p_occupied(cell), ++n);
      return !arrived;
    });
    return visible;
  }

  /// Of the neighbours worked out so far, by their bilinear weights.
  [[nodiscard]] double interpolated(const Eigen::Array3d& at) const {
    const Eigen::Array3i low = at.floor().cast<int>();
    double sum = 0.0;
    double weights = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Array3i up(corner & 1, corner >> 1 & 1, corner >> 2);
      const Eigen::Array3i cell = low + up;
      const Eigen::Array3d near = 1.0 - (at - cell.cast<double>()).abs();
      const double weight = near.max(0.0).prod();
      if (weight < 1e-9 || !grid_.frame.contains(cell)) continue;
      const float visible = p_visible_[grid_.frame.index(cell)];
      if (visible == kUnknown) continue;
      sum += weight * static_cast<double>(visible);
      weights += weight;
    }
    return weights > 0.0 ? sum / weights : 0.0;
  }

  /// By the ray to the cell, before it.
  [[nodiscard]] int cells_passed(const Eigen::Array3i& cell) const {
    const GridFrame& frame = grid_.frame;
    const Eigen::Vector3d p = frame.centre(cell);
    const double enter = clip_segment(frame.box(), p_sensor_, p).enter;
    const Eigen::Array3i first =
        frame.cell_at(p_sensor_ + enter * (p - p_sensor_)).max(0).min(frame.cells - 1);
    return (cell - first).abs().sum();
  }

  const OccupancyGrid& grid_;
  VisibilityModel model_;
  Eigen::Vector3d p_sensor_;
  Eigen::Array3d source_;
  std::vector<float> p_visible_;
};

double gain_bits(const InterpolatedChain& chain, const OccupancyGrid& grid, const Candidate& view,
                 const FieldOfView& field) {
  double sum = 0.0;
  const auto wanted = [&](std::size_t cell) { return grid.state(cell) == CellState::unobserved; };
  for_each_cell_in_view(grid.frame, ViewCone(view.T_world_sensor, field), wanted,
                        [&](const Eigen::Array3i&, std::size_t cell) {
                          sum += chain.p_visible(cell) * binary_entropy_bits(grid.p_occupied(cell));
                        });
  return sum;
}

std::vector<double> interpolated_gains_bits(const VisibilityModel& model, const Situation& s) {
  std::vector<double> gains;
  std::optional<InterpolatedChain> chain;  // of the views at one place, which follow each other
  Eigen::Vector3d p_sensor;
  for (const Candidate& view : s.views) {
    if (!chain || view.T_world_sensor.translation() != p_sensor) {
      p_sensor = view.T_world_sensor.translation();
      chain.emplace(s.grid, model, p_sensor);
    }
    gains.push_back(gain_bits(*chain, s.grid, view, s.field));
  }
  return gains;
}

void run_benchmark() {
  const fs::path directory = fs::temp_directory_path() / "vantage_bench_hmm";
  fs::create_directories(directory);
  double spearman_min = 1.0;
  double regret_max = 0.0;
  std::vector<double> relative_errors;
  std::string configuration;
  for (const int objects : {8, 25}) {
    const auto resolved =
        load_episode("assets/episodes/tabletop.yaml",
                     {fmt::format("scene=models/scenes/tabletop_{}/scene.xml", objects), "scans=4",
                      "metrics.predictors=[simple]"});
    const RunRequest request = lean_request(resolved, directory);
    configuration += request.config;
    TabletopSession<Watched<TabletopParts>> session(request, std::get<Tabletop>(resolved.task));
    run_episode(session.parts);
    for (const Situation& s : session.parts.situations) {
      const VisibilityWeightedGain gain;
      const auto exact = exact_gains_bits(gain, s.context(), s.views, s.field, kThreads);
      const auto fast = interpolated_gains_bits(gain.model, s);
      const auto chosen = static_cast<std::size_t>(std::ranges::max_element(fast) - fast.begin());
      spearman_min = std::min(spearman_min, spearman(fast, exact));
      regret_max = std::max(regret_max, 1.0 - exact[chosen] / *std::ranges::max_element(exact));
      for (std::size_t i = 0; i < exact.size(); ++i) {
        if (exact[i] > 0.0) relative_errors.push_back(std::abs(fast[i] / exact[i] - 1.0));
      }
    }
  }
  fs::remove_all(directory);
  const double mean_error = std::accumulate(relative_errors.begin(), relative_errors.end(), 0.0) /
                            static_cast<double>(relative_errors.size());
  print_figures("hmm", kThreads, configuration,
                {{"spearman_min", spearman_min},
                 {"regret_max", regret_max},
                 {"relative_error_mean", mean_error},
                 {"relative_error_max", *std::ranges::max_element(relative_errors)}});
}

}  // namespace
}  // namespace vantage::bench

int main() { return vantage::bench::run_main(vantage::bench::run_benchmark); }
