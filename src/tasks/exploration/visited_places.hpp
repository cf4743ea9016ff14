/// Where not to go again: what keeps exploration from going on for ever.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace vantage {

/// Discs round places that were chosen or scanned from. Each radius is at least one positive
/// number, and a place inside a disc is never chosen: those chosen keep that distance from each
/// other, so that a bounded floor holds finitely many.
class VisitedPlaces {
 public:
  void add(const Eigen::Vector2d& p_m, double radius_m) { discs_.push_back({p_m, radius_m}); }
  /// Where the discs are, in order, to be moved.
  [[nodiscard]] std::size_t size() const { return discs_.size(); }
  [[nodiscard]] const Eigen::Vector2d& place(std::size_t disc) const { return discs_[disc].p_m; }
  void move(std::size_t disc, const Eigen::Vector2d& p_m) { discs_[disc].p_m = p_m; }
  [[nodiscard]] bool covers(const Eigen::Vector2d& p_m) const {
    for (const Disc& disc : discs_) {
      if ((disc.p_m - p_m).norm() < disc.radius_m) return true;
    }
    return false;
  }

 private:
  struct Disc {
    Eigen::Vector2d p_m;
    double radius_m;
  };
  std::vector<Disc> discs_;
};

}  // namespace vantage
