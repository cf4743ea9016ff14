#include "vantage/planners/visibility/ray_visibility.hpp"

namespace vantage {

std::vector<double> visibility_along_ray(std::span<const double> p_occupied,
                                         const VisibilityModel& model) {
  VisibilityChain chain(model);
  std::vector<double> p_visible;
  p_visible.reserve(p_occupied.size());
  for (const double p : p_occupied) {
    p_visible.push_back(chain.p_visible());
    chain.pass(p);
  }
  return p_visible;
}

std::vector<double> posterior_along_ray(std::span<const double> p_occupied,
                                        const PosteriorModel& model) {
  PosteriorChain chain(model);
  std::vector<double> posterior;
  posterior.reserve(p_occupied.size());
  for (const double p : p_occupied) {
    chain.enter(p);
    posterior.push_back(chain.p_occupied());
  }
  return posterior;
}

}  // namespace vantage
