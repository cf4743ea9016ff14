/// How likely each cell of a ray is seen, and what would then be known of it: the hidden Markov
/// model and the posterior chain.  [Potthast2016, 3.1]
#pragma once

#include <span>
#include <vector>

#include "vantage/core/fields.hpp"

namespace vantage {

/// Transition of the state x in {visible, not visible} from one cell of a ray to the next.
///
/// To the letter, visibility returns behind a wall: `p_reappear` lifts it within about ten cells
/// that are not occupied, and every free cell is taken as evidence that the ray is still in sight.
/// An occupied cell hides what lies behind it at once only where its odds exceed those of staying
/// visible, t / (1 - t).
struct VisibilityModel {
  double a = 0.997;
  double p_reappear = 0.1;
  void fields(auto&& f) {
    f("a", a,
      "a of t = a^N, the probability that a ray stays visible after N cells; higher sees deeper "
      "into unobserved space",
      between(0.0, 1.0));
    f("p_reappear", p_reappear,
      "probability that a cell is visible behind one that is not; higher sees behind obstacles; 0: "
      "hidden stays hidden",
      between(0.0, 1.0));
  }
};

namespace detail {
/// Probabilities of two states up to a common factor, which drops out of every ratio: a filter that
/// keeps them so saves a division per cell.
struct StatePair {
  double first = 1.0;
  double second = 0.0;

  [[nodiscard]] double p_first() const { return first / (first + second); }

  /// Call after each update: keeps the factor off the end of the floating-point range. Where a
  /// certain measurement contradicts a certain prediction and both states vanish, p(first) is
  /// `p_lost`.
  void rescale(double p_lost) {
    constexpr double kSmall = 1e-100;
    if (first + second >= kSmall) return;
    const double p = first + second > 0.0 ? p_first() : p_lost;
    first = p;
    second = 1.0 - p;
  }
};
}  // namespace detail

/// p(x_m = visible), cell by cell.
class VisibilityChain {
 public:
  explicit VisibilityChain(const VisibilityModel& model) : model_(model) {}

  /// Of the cell the ray stands in; 1 in the first.
  [[nodiscard]] double p_visible() const { return state_.p_first(); }

  /// Leaves a cell of occupancy p(o_{m-1}) for the next one.
  void pass(double p_occupied) {
    const auto [visible, hidden] = state_;
    t_ *= model_.a;  // [Potthast2016, (3.10)]
    const double stay_visible = visible * t_ + hidden * model_.p_reappear;  // (3.9)
    const double stay_hidden = visible + hidden - stay_visible;
    state_ = {(1.0 - p_occupied) * stay_visible, p_occupied * stay_hidden};  // (3.6), (3.7)
    state_.rescale(0.0);
  }

 private:
  VisibilityModel model_;
  double t_ = 1.0;
  detail::StatePair state_;  // visible, not visible
};

struct PosteriorModel {
  VisibilityModel visibility;
  double p_occupied_at_sensor = 0.05;
  void fields(auto&& f) {
    f("visibility", visibility, "how likely each cell of a ray is visible");
    f("p_occupied_at_sensor", p_occupied_at_sensor,
      "p(occupied) of the place that a ray starts in; higher learns less, and at 0.5 nothing from "
      "unobserved cells alone",
      between(0.0, 1.0));
  }
};

/// Posterior p(o_m | x_m, z_{1:m}), cell by cell.
class PosteriorChain {
 public:
  explicit PosteriorChain(const PosteriorModel& model)
      : visibility_(model.visibility),
        state_{model.p_occupied_at_sensor, 1.0 - model.p_occupied_at_sensor} {}

  /// Of the cell entered last.
  [[nodiscard]] double p_occupied() const { return state_.p_first(); }

  /// Enters a cell whose occupancy in the map is p(o_m).
  void enter(double p_occupied) {
    const auto [occupied, free] = state_;
    const double t = 0.5 + 0.5 * visibility_.p_visible();      // [Potthast2016, (3.15)]
    state_ = {p_occupied * (t * occupied + (1.0 - t) * free),  // (3.11), (3.12), (3.14)
              (1.0 - p_occupied) * ((1.0 - t) * occupied + t * free)};
    state_.rescale(0.5);
    visibility_.pass(p_occupied);
  }

 private:
  VisibilityChain visibility_;
  detail::StatePair state_;  // occupied, free
};

/// p(x_m = visible) for each cell of a ray whose cells are occupied with probability `p_occupied`,
/// the cell of the sensor first.
std::vector<double> visibility_along_ray(std::span<const double> p_occupied,
                                         const VisibilityModel& model = {});

/// Posterior occupancy of each cell of the same ray.
std::vector<double> posterior_along_ray(std::span<const double> p_occupied,
                                        const PosteriorModel& model = {});

}  // namespace vantage
