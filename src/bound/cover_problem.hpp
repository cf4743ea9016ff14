/// How little suffices to see enough: which views show which cells, and how far they are apart.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vantage {

/// A set of cells: cell i is bit i % 64 of word i / 64.
using CellBits = std::vector<std::uint64_t>;

std::size_t count_cells(const CellBits& cells);
/// |a without b|
std::size_t count_without(const CellBits& a, const CellBits& b);
void unite(CellBits& cells, const CellBits& others);

/// A robot stands at view 0 and has taken it. It may take any others, in any order.
struct CoverProblem {
  std::vector<CellBits> shows;  ///< per view, all of one length
  std::size_t needed = 0;       ///< cells that are to be shown, view 0 counting
  Eigen::MatrixXd way_m;        ///< symmetric; no way between two views is shorter
  double speed_m_s = 1.0;       ///< nothing drives faster
  double scan_s = 0.0;          ///< no view takes less

  [[nodiscard]] std::size_t views() const { return shows.size(); }
  [[nodiscard]] double between_m(std::size_t a, std::size_t b) const {
    return way_m(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
  }
  [[nodiscard]] double time_s(double driven_m, std::size_t scans) const {
    return driven_m / speed_m_s + static_cast<double>(scans) * scan_s;
  }
  void check() const;  ///< asserts that sizes fit
};

/// Of all views together.
CellBits shown_by_all(const CoverProblem& problem);

/// The same problem with groups of views made one each, which shows what any of them shows and is
/// as near as the nearest of them: what suffices there is no more than what suffices here.
/// @param group of each view, counted from 0 in the order of their first views
CoverProblem merged(const CoverProblem& problem, std::span<const std::size_t> group);

/// Groups of views within that distance of the first of each.
std::vector<std::size_t> places_of(const CoverProblem& problem, double within_m);

/// Length of the shortest way from view 0 through these, ending anywhere; through more than
/// kMaxExactWay no longer than that. Ways are to obey the triangle inequality.
double shortest_way_m(const CoverProblem& problem, std::span<const std::size_t> views);
inline constexpr std::size_t kMaxExactWay = 12;

/// Length of the shortest way from place 0 through each set of the others, ending anywhere; bit i
/// of a set is place i + 1. [HeldKarp1962]
/// @param way_m symmetric, between all places
std::vector<double> ways_through_sets_m(const Eigen::MatrixXd& way_m);

}  // namespace vantage
