#include "vantage/planners/choice/oracle_lookahead.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "vantage/core/cancellation/stop_poll.hpp"
#include "vantage/planners/choice/view_choice.hpp"

namespace vantage {
namespace {

using Sequence = std::vector<std::size_t>;

constexpr std::size_t kCells = 130;  // more than two words

Candidate view_of(std::initializer_list<std::size_t> cells) {
  auto set = std::make_shared<CellSet>((kCells + 63) / 64);
  for (const std::size_t cell : cells) (*set)[cell / 64] |= std::uint64_t{1} << (cell % 64);
  Candidate view;
  view.true_new_cells = static_cast<double>(cells.size());
  view.true_new_cell_set = std::move(set);
  return view;
}

/// The middle view shows most at first, but the other two together all there is.
std::vector<Candidate> a_trap() {
  return {view_of({0, 1, 2, 3, 64}), view_of({1, 2, 3, 65, 66, 128}),
          view_of({65, 66, 67, 128, 129})};
}

std::vector<Candidate> random_views(std::size_t count, Rng& rng) {
  std::vector<Candidate> views;
  for (std::size_t i = 0; i < count; ++i) {
    views.push_back(view_of({}));
    auto set = std::make_shared<CellSet>((kCells + 63) / 64);
    const double share = rng.uniform(0.05, 0.4);
    for (std::size_t cell = 0; cell < kCells; ++cell) {
      if (rng.uniform(0.0, 1.0) < share) (*set)[cell / 64] |= std::uint64_t{1} << (cell % 64);
    }
    views.back().true_new_cell_set = std::move(set);
  }
  return views;
}

/// Sum over the steps of the cells shown by then.
std::size_t value_of(const std::vector<Candidate>& views, const Sequence& sequence) {
  CellSet shown((kCells + 63) / 64);
  std::size_t value = 0;
  for (const std::size_t i : sequence) {
    for (std::size_t w = 0; w < shown.size(); ++w) {
      shown[w] |= (*views[i].true_new_cell_set)[w];
      value += static_cast<std::size_t>(std::popcount(shown[w]));
    }
  }
  return value;
}

/// The greatest value of all sequences of `depth` different views.
std::size_t best_of_all(const std::vector<Candidate>& views, std::size_t depth) {
  Sequence order(views.size());
  std::iota(order.begin(), order.end(), 0U);
  std::size_t best = 0;
  do {
    best = std::max(best, value_of(views, Sequence(order.begin(), order.begin() + depth)));
  } while (std::ranges::next_permutation(order).found);
  return best;
}

TEST(OracleLookahead, FindsThePairThatTheOneStepOracleMisses) {
  const auto views = a_trap();
  Rng rng(1);
  EXPECT_EQ(choose_view(OracleView{}, views, rng), 1U);
  const Sequence found = OracleLookahead{.width = 8, .depth = 2}.best_sequence(views);
  EXPECT_EQ(found, (Sequence{0, 2}));
  EXPECT_EQ(value_of(views, found), 15U);
  EXPECT_EQ(value_of(views, {1, 0}), 14U) << "after the view that shows most";
  EXPECT_EQ(choose_view(OracleLookahead{.width = 8, .depth = 2}, views, rng), 0U);
}

TEST(OracleLookahead, OfAWideBeamIsTheBestOfAllSequences) {
  Rng rng(2);
  for (int trial = 0; trial < 40; ++trial) {
    const auto views = random_views(6, rng);
    for (const int depth : {1, 2, 3, 6}) {
      const Sequence found = OracleLookahead{.width = 1000, .depth = depth}.best_sequence(views);
      ASSERT_EQ(found.size(), static_cast<std::size_t>(depth));
      EXPECT_EQ(value_of(views, found), best_of_all(views, found.size()))
          << "trial " << trial << ", depth " << depth;
    }
  }
}

TEST(OracleLookahead, OneStepAheadOrOneSequenceWideItIsTheOneStepOracle) {
  Rng rng(3);
  for (int trial = 0; trial < 40; ++trial) {
    auto views = random_views(7, rng);
    for (Candidate& view : views) {
      std::size_t cells = 0;
      for (const auto word : *view.true_new_cell_set) {
        cells += static_cast<std::size_t>(std::popcount(word));
      }
      view.true_new_cells = static_cast<double>(cells);
      view.path_length_m = rng.uniform(0.0, 5.0);
    }
    const std::size_t oracle = choose_view(OracleView{}, views, rng);
    EXPECT_EQ(choose_view(OracleLookahead{.width = 50, .depth = 1}, views, rng), oracle);
    EXPECT_EQ(choose_view(OracleLookahead{.width = 1, .depth = 5}, views, rng), oracle);
  }
}

TEST(OracleLookahead, TakesNoViewTwice) {
  Sequence found = OracleLookahead{.width = 4, .depth = 1000}.best_sequence(a_trap());
  std::ranges::sort(found);
  EXPECT_EQ(found, (Sequence{0, 1, 2}));
}

TEST(OracleLookahead, LeavesOutWhatIsOutOfReachUnlessAllIs) {
  auto views = a_trap();
  views[0].reachable = false;
  const OracleLookahead choice{.width = 8, .depth = 2};
  EXPECT_EQ(choice.best_sequence(views), (Sequence{1, 2}));
  for (Candidate& view : views) view.reachable = false;
  EXPECT_EQ(choice.best_sequence(views), (Sequence{0, 2}));
}

TEST(OracleLookahead, OfEqualSequencesBeginsNear) {
  auto views = std::vector<Candidate>{view_of({0, 1}), view_of({2, 3})};
  views[0].path_length_m = 2.0;
  views[1].path_length_m = 1.0;
  EXPECT_EQ((OracleLookahead{.width = 8, .depth = 2}.best_sequence(views)), (Sequence{1, 0}));
  views[0].path_length_m = 1.0;
  EXPECT_EQ((OracleLookahead{.width = 8, .depth = 2}.best_sequence(views)), (Sequence{0, 1}));
}

TEST(OracleLookahead, LooksNoFartherThanTheScansThatAreLeft) {
  const ViewChoice choice = OracleLookahead{.width = 8, .depth = 5};
  EXPECT_EQ(std::get<OracleLookahead>(within_scans_left(choice, 2)).depth, 2);
  EXPECT_EQ(std::get<OracleLookahead>(within_scans_left(choice, 9)).depth, 5);
  Rng rng(1);
  EXPECT_EQ(choose_view(within_scans_left(choice, 2), a_trap(), rng), 0U);
  EXPECT_EQ(choose_view(within_scans_left(choice, 1), a_trap(), rng), 1U);
  EXPECT_TRUE(std::holds_alternative<GreedyGain>(within_scans_left(GreedyGain{}, 1)));
}

TEST(OracleLookaheadDeathTest, NeedsTheTruth) {
  auto views = a_trap();
  views[2].true_new_cell_set.reset();
  Rng rng(1);
  EXPECT_DEATH(choose_view(OracleLookahead{}, views, rng), "true_new_cell_set");
}

/// After either of the first two views the other one shows as much: the same two views in another
/// order are no second plan.
TEST(OracleLookahead, ABeamHoldsSetsOfViewsNotOrdersOfThem) {
  const std::vector<Candidate> views{view_of({0, 1}), view_of({2, 3}), view_of({0, 4}),
                                     view_of({1, 5})};
  const Sequence found = OracleLookahead{.width = 2, .depth = 3}.best_sequence(views);
  EXPECT_EQ(found, (Sequence{1, 2, 3}));
  EXPECT_EQ(value_of(views, found), 2U + 4U + 6U);
  EXPECT_EQ(value_of(views, {0, 1, 2}), 2U + 4U + 5U);
}

/// Once for the plan that is extended, and once for each of the two that are kept.
TEST(OracleLookahead, AsksWhetherToGoOn) {
  int asked = 0;
  const StopPoll poll([&] { ++asked; });
  EXPECT_EQ((OracleLookahead{.width = 2, .depth = 1}.best_sequence(a_trap())), Sequence{1});
  EXPECT_EQ(asked, 3);
}

}  // namespace
}  // namespace vantage
