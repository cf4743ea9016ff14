/// Lengths of the ways between many places.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "vantage/planners/navigation/path_field.hpp"

namespace vantage {

struct FloorGraph;

/// Ways that plan_path() would take over the cells of one field's map, by the same costs, but not
/// pulled straight: up to 8 % longer. What was asked for is remembered: places that come again cost
/// no search.
class PathLengths {
 public:
  explicit PathLengths(const PathField& field);
  ~PathLengths();
  PathLengths(PathLengths&&) noexcept;
  PathLengths& operator=(PathLengths&&) noexcept;

  /// Each place stands for the reachable cell it is in. Symmetric; infinite to and from places that
  /// are not reachable, 0 on the diagonal. The result does not depend on `threads`.
  [[nodiscard]] Eigen::MatrixXd between_m(std::span<const Eigen::Vector2d> places_m, int threads);

 private:
  [[nodiscard]] std::uint32_t node_of(const Eigen::Vector2d& p_m) const;
  void find(std::span<const std::uint32_t> nodes, int threads);

  FloorMap map_;
  std::vector<std::uint32_t> node_of_cell_;
  std::unique_ptr<const FloorGraph> graph_;
  std::unordered_set<std::uint32_t> met_;              ///< nodes that were asked for
  std::unordered_map<std::uint64_t, float> length_m_;  ///< of pairs of nodes
};

/// The same of places that nobody asks for again.
Eigen::MatrixXd path_lengths_m(const PathField& field, std::span<const Eigen::Vector2d> places_m,
                               int threads);

}  // namespace vantage
