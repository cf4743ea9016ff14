#include "vantage/bound/fewest_scans.hpp"

#include <ClpSimplex.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace vantage {
namespace {

/// Shares of views, between 0 and 1, of which there are to be few.
class ShareProgram {
 public:
  explicit ShareProgram(int views) {
    model_.setLogLevel(0);
    model_.resize(0, views);
    for (int i = 0; i < views; ++i) {
      model_.setColumnBounds(i, 0.0, 1.0);
      model_.setObjectiveCoefficient(i, 1.0);
    }
  }
  /// sum weights[i] x_i >= least
  void require(std::span<const double> weights, double least) {
    std::vector<int> columns;
    std::vector<double> values;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (weights[i] <= 0.0) continue;
      columns.push_back(static_cast<int>(i));
      values.push_back(weights[i] / least);  // rows of one scale
    }
    model_.addRow(static_cast<int>(columns.size()), columns.data(), values.data(), 1.0,
                  COIN_DBL_MAX);
  }
  /// Whether it has a solution.
  bool solve() { return model_.dual() == 0 && model_.isProvenOptimal(); }
  [[nodiscard]] double least() const { return model_.objectiveValue(); }
  [[nodiscard]] std::span<const double> shares() const {
    return {model_.primalColumnSolution(), static_cast<std::size_t>(model_.numberColumns())};
  }

 private:
  ClpSimplex model_;
};

/// Each cell's share shown: the sum over the views that show it.
std::vector<float> shown_shares(const CoverProblem& problem, std::span<const double> shares) {
  std::vector<float> shown(64 * problem.shows.front().size(), 0.0F);
  for (std::size_t view = 0; view < problem.views(); ++view) {
    const auto share = static_cast<float>(view == 0 ? 1.0 : shares[view - 1]);
    if (share <= 0.0F) continue;
    const CellBits& cells = problem.shows[view];
    for (std::size_t word = 0; word < cells.size(); ++word) {
      for (std::uint64_t bits = cells[word]; bits != 0; bits &= bits - 1) {
        shown[64 * word + static_cast<std::size_t>(__builtin_ctzll(bits))] += share;
      }
    }
  }
  return shown;
}

/// The cells that are shown in full, and what is shown of all.
struct FullyShown {
  CellBits cells;
  double total = 0.0;
};
FullyShown fully_shown(const std::vector<float>& shown) {
  constexpr float kFull = 1.0F - 1e-5F;
  FullyShown result{CellBits(shown.size() / 64, 0), 0.0};
  for (std::size_t cell = 0; cell < shown.size(); ++cell) {
    if (shown[cell] >= kFull) result.cells[cell / 64] |= std::uint64_t{1} << (cell % 64);
    result.total += static_cast<double>(std::min(shown[cell], 1.0F));
  }
  return result;
}

/// What each view shows beyond `given`, `most` at most.
std::vector<double> beyond(const CoverProblem& problem, const CellBits& given, double most) {
  std::vector<double> cells;
  for (std::size_t view = 1; view < problem.views(); ++view) {
    cells.push_back(std::min(static_cast<double>(count_without(problem.shows[view], given)), most));
  }
  return cells;
}

}  // namespace

std::optional<std::size_t> fewest_scans(const CoverProblem& problem,
                                        const ScanBoundOptions& options) {
  problem.check();
  if (count_cells(shown_by_all(problem)) < problem.needed) return std::nullopt;
  constexpr double kRounding = 1e-6;
  const auto needed = static_cast<double>(problem.needed);
  ShareProgram program(static_cast<int>(problem.views()) - 1);
  CellBits given = problem.shows.front();
  double least = 0.0;
  for (int round = 0; round < options.rounds; ++round) {
    const double lacking = needed - static_cast<double>(count_cells(given));
    if (lacking <= 0.0) break;
    program.require(beyond(problem, given, lacking), lacking);
    if (!program.solve()) break;
    least = std::max(least, program.least());
    const FullyShown shown = fully_shown(shown_shares(problem, program.shares()));
    if (shown.total >= needed * (1.0 - options.tolerance)) break;
    given = shown.cells;
  }
  return static_cast<std::size_t>(std::ceil(std::max(0.0, least - kRounding)));
}

}  // namespace vantage
