/// The page of an arena.
#pragma once

#include "vantage/arena/leaderboard.hpp"
#include "vantage/study/figures/figure.hpp"

namespace vantage {

/// Share seen against time: a panel for each of the study's, and before them all of them against
/// the share of the budget of time.
Figure overall_figure(const StudyResults& results, const Leaderboard& board);
Figure scene_figure(const StudyResults& results, const Leaderboard& board);

/// Writes `arena.html` and `leaderboard.csv` into the arena's folder: static, self-contained,
/// without script.
/// @throws OutputError
void write_arena_page(const StudyResults& results, const Leaderboard& board);

}  // namespace vantage
