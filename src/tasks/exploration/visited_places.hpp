/// Where not to go again: what keeps exploration from going on for ever.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace vantage {

/// Discs round places that were chosen or scanned from. Each radius is at least one positive
/// number, and a place inside a disc is never chosen: those chosen keep that distance from each
/// other, so that a bounded floor holds finitely many. A place where images were lost may be gone
/// to once more.
class VisitedPlaces {
 public:
  /// @param missed part of what was to be seen from there
  void add(const Eigen::Vector2d& p_m, double radius_m, bool missed = false) {
    discs_.push_back({p_m, radius_m, missed && !is_reopened(p_m)});
  }
  /// Allows the places where something was missed, each of them once. @return whether there are any
  bool reopen() {
    bool any = false;
    for (std::size_t i = 0; i < discs_.size(); ++i) {
      if (!discs_[i].missed || discs_[i].reopened) continue;
      const Disc missed = discs_[i];
      for (Disc& disc : discs_) disc.reopened |= missed.holds(disc.p_m);
      any = true;
    }
    return any;
  }
  /// Where the discs are, in order, to be moved.
  [[nodiscard]] std::size_t size() const { return discs_.size(); }
  [[nodiscard]] const Eigen::Vector2d& place(std::size_t disc) const { return discs_[disc].p_m; }
  void move(std::size_t disc, const Eigen::Vector2d& p_m) { discs_[disc].p_m = p_m; }
  [[nodiscard]] bool covers(const Eigen::Vector2d& p_m) const {
    return std::ranges::any_of(discs_,
                               [&](const Disc& disc) { return !disc.reopened && disc.holds(p_m); });
  }

 private:
  struct Disc {
    Eigen::Vector2d p_m;
    double radius_m;
    bool missed;
    bool reopened = false;
    [[nodiscard]] bool holds(const Eigen::Vector2d& other_m) const {
      return (p_m - other_m).norm() < radius_m;
    }
  };
  [[nodiscard]] bool is_reopened(const Eigen::Vector2d& p_m) const {
    return std::ranges::any_of(discs_,
                               [&](const Disc& disc) { return disc.reopened && disc.holds(p_m); });
  }
  std::vector<Disc> discs_;
};

}  // namespace vantage
