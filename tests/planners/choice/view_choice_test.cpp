#include "vantage/planners/choice/view_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "vantage/core/fields.hpp"

namespace vantage {
namespace {

Candidate view(int id, double gain_bits, double path_length_m, double true_new_cells) {
  Candidate candidate;
  candidate.id = id;
  candidate.gain_bits = gain_bits;
  candidate.path_length_m = path_length_m;
  candidate.true_new_cells = true_new_cells;
  candidate.true_new_cell_set = std::make_shared<CellSet>(1, std::uint64_t{1} << id);
  return candidate;
}

std::vector<Candidate> five_views() {
  return {view(0, 5.0, 1.0, 3.0), view(1, 9.0, 2.0, 7.0), view(2, 9.0, 1.0, 2.0),
          view(3, 9.0, 1.0, 8.0), view(4, 1.0, 0.0, 8.0)};
}

std::vector<ViewChoice> every_choice() {
  std::vector<ViewChoice> choices;
  for (const auto name : strategy_names<ViewChoice>()) {
    choices.push_back(make_strategy<ViewChoice>(name));
  }
  return choices;
}

std::vector<ViewChoice> choices_of_one_view() {
  std::vector<ViewChoice> choices = every_choice();
  std::erase_if(choices, [](const ViewChoice& choice) {
    return plans_views(choice) || asks_outside(choice);  // that is no function
  });
  return choices;
}

TEST(EveryViewChoice, NamesAViewTheSameForTheSameSeed) {
  const auto views = five_views();
  for (const ViewChoice& choice : choices_of_one_view()) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      Rng first(seed);
      Rng second(seed);
      const std::size_t chosen = choose_view(choice, views, first);
      EXPECT_LT(chosen, views.size());
      EXPECT_EQ(choose_view(choice, views, second), chosen) << strategy_name_of(choice);
    }
  }
}

TEST(EveryViewChoice, TakesTheOnlyView) {
  const std::vector<Candidate> views{view(17, 0.0, 3.0, 0.0)};
  Rng rng(1);
  for (const ViewChoice& choice : choices_of_one_view())
    EXPECT_EQ(choose_view(choice, views, rng), 0U);
}

TEST(EveryViewChoice, LeavesExhaustedViewsOutUnlessAllAre) {
  Rng rng(1);
  for (const ViewChoice& choice : choices_of_one_view()) {
    auto views = five_views();
    for (Candidate& candidate : views) candidate.exhausted = candidate.id != 3 && candidate.id != 0;
    std::set<std::size_t> chosen;
    for (int i = 0; i < 50; ++i) chosen.insert(choose_view(choice, views, rng));
    for (const std::size_t index : chosen) EXPECT_FALSE(views[index].exhausted);
    for (Candidate& candidate : views) candidate.exhausted = true;
    EXPECT_LT(choose_view(choice, views, rng), views.size());
  }
}

TEST(EveryViewChoice, MayTakeAnUnreachableView) {
  std::vector<Candidate> views{view(0, 1.0, 1.0, 1.0)};
  views[0].reachable = false;
  Rng rng(1);
  for (const ViewChoice& choice : choices_of_one_view())
    EXPECT_EQ(choose_view(choice, views, rng), 0U);
}

TEST(EveryViewChoice, ReadsBackFromItsName) {
  for (ViewChoice choice : every_choice()) {
    if (auto* external = std::get_if<ExternalChoice>(&choice)) external->command = {"planner"};
    ViewChoice read;
    read_into(write_node(choice), read);
    EXPECT_EQ(read.index(), choice.index());
  }
}

TEST(ViewChoice, OfAnUnknownNameListsTheKnown) {
  try {
    make_strategy<ViewChoice>("gredy");
    FAIL() << "no error";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "unknown view choice 'gredy'; did you mean greedy? known: random, greedy, oracle, "
                 "oracle_lookahead, nearest_frontier, gain_over_distance, information_rate, "
                 "receding_horizon, frontier_tour, two_level_tour, tour, rollout, oracle_tour, "
                 "external");
  }
}

TEST(RandomView, TakesEveryViewAboutEquallyOften) {
  const auto views = five_views();
  std::vector<int> taken(views.size());
  Rng rng(2);
  for (int i = 0; i < 5000; ++i) ++taken[choose_view(RandomView{}, views, rng)];
  for (const int count : taken) EXPECT_NEAR(count, 1000, 150);
}

TEST(RandomView, EveryDrawIsASequenceOfItsOwn) {
  const auto views = five_views();
  const auto sequence = [&](const ViewChoice& choice, std::uint64_t seed) {
    Rng rng = choice_stream(choice, seed);
    std::vector<std::size_t> taken;
    for (int i = 0; i < 20; ++i) taken.push_back(choose_view(choice, views, rng));
    return taken;
  };
  std::set<std::vector<std::size_t>> sequences;
  for (const std::uint64_t seed : {1U, 2U}) {
    for (const int draw : {0, 1, 2, 10}) sequences.insert(sequence(RandomView{draw}, seed));
  }
  EXPECT_EQ(sequences.size(), 8U);
  EXPECT_EQ(sequence(RandomView{1}, 1), sequence(RandomView{1}, 1));
}

TEST(ChoiceStream, OfTheFirstDrawIsThatOfEveryOtherChoice) {
  const auto first = [](Rng rng) { return rng.next(); };
  const std::uint64_t common = first(Rng::stream(7, "view choice"));
  EXPECT_EQ(first(choice_stream(RandomView{}, 7)), common);
  EXPECT_EQ(first(choice_stream(RecedingHorizon{}, 7)), common);
  EXPECT_EQ(first(choice_stream(RandomView{3}, 7)), first(Rng::stream(7, "view choice 3")));
}

TEST(GreedyGain, BreaksTiesByPathThenById) {
  Rng rng(1);
  EXPECT_EQ(choose_view(GreedyGain{}, five_views(), rng), 2U);
}

TEST(OracleView, KnowsWhatAViewShows) {
  Rng rng(1);
  EXPECT_EQ(choose_view(OracleView{}, five_views(), rng), 4U);
}

TEST(OracleViewDeathTest, NeedsTheTruth) {
  auto views = five_views();
  views[2].true_new_cells.reset();
  Rng rng(1);
  EXPECT_DEATH(choose_view(OracleView{}, views, rng), "true_new_cells");
}

TEST(NearestFrontier, TakesTheShortestPathThenTheLowestId) {
  Rng rng(1);
  auto views = five_views();
  EXPECT_EQ(choose_view(NearestFrontier{}, views, rng), 4U);
  views[4].path_length_m = 5.0;
  EXPECT_EQ(choose_view(NearestFrontier{}, views, rng), 0U);
}

TEST(ViewChoice, OnlyThoseThatWeighGainsNeedThem) {
  const auto weighing = [] {
    std::vector<std::string_view> names;
    for (const std::string_view name : strategy_names<ViewChoice>()) {
      if (weighs_gain(make_strategy<ViewChoice>(name))) names.push_back(name);
    }
    return names;
  };
  EXPECT_EQ(weighing(), (std::vector<std::string_view>{
                            "greedy", "gain_over_distance", "information_rate", "receding_horizon",
                            "two_level_tour", "tour", "rollout", "external"}));
}

TEST(GainOverDistance, WeighsGainAgainstTheWay) {
  // 10 exp(-5 l) = 6 exp(-l) at l = ln(10 / 6) / 4, about 0.128.
  const std::vector<Candidate> views{view(0, 10.0, 5.0, 0.0), view(1, 6.0, 1.0, 0.0)};
  Rng rng(1);
  EXPECT_EQ(choose_view(GainOverDistance{.lambda_per_m = 0.12}, views, rng), 0U);
  EXPECT_EQ(choose_view(GainOverDistance{.lambda_per_m = 0.14}, views, rng), 1U);
}

TEST(GainOverDistance, WithoutDiscountIsGreedy) {
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    auto views = five_views();
    for (Candidate& candidate : views) {
      candidate.gain_bits = std::floor(rng.uniform(0.0, 3.0));
      candidate.path_length_m = rng.uniform(0.0, 9.0);
    }
    EXPECT_EQ(choose_view(GainOverDistance{.lambda_per_m = 0.0}, views, rng),
              choose_view(GreedyGain{}, views, rng));
  }
}

TEST(GainOverDistance, OfASteepDiscountIsTheNearestView) {
  Rng rng(1);
  EXPECT_EQ(choose_view(GainOverDistance{.lambda_per_m = 50.0}, five_views(), rng), 4U);
}

TEST(ChoicesThatWeighPaths, TakeAnUnreachableViewOnlyWhereNoOtherIsLeft) {
  auto views = five_views();
  for (Candidate& candidate : views) {
    candidate.reachable = candidate.id == 1;
    if (!candidate.reachable) candidate.path_length_m = std::numeric_limits<double>::infinity();
  }
  Rng rng(1);
  for (const ViewChoice& choice : {ViewChoice(NearestFrontier{}), ViewChoice(GainOverDistance{}),
                                   ViewChoice(GainOverDistance{.lambda_per_m = 0.0})}) {
    EXPECT_EQ(choose_view(choice, views, rng), 1U) << strategy_name_of(choice);
    auto none = views;
    none[1].reachable = false;
    EXPECT_LT(choose_view(choice, none, rng), none.size());
  }
}

TEST(ViewChoiceDeathTest, OfAPlanNeedsAProblem) {
  Rng rng(1);
  EXPECT_DEATH(choose_view(ViewChoice(TourChoice{}), five_views(), rng),
               "a function of candidates");
}

/// Two views that show one block, the second one nearer.
TEST(ViewChoiceDeathTest, PlansWhatTheChoicePlansForAProblemWhoseSizesFit) {
  PlanningProblem problem;
  problem.cells = {5.0F};
  problem.shows = {{{0}, {1.0F}}, {{0}, {1.0F}}};
  problem.place_m.resize(2, Eigen::Vector2d::Zero());
  problem.travel_s = Eigen::MatrixXd::Constant(3, 2, 4.0);
  problem.travel_s(2, 1) = 1.0;
  Rng rng(1);
  EXPECT_EQ(plan_views(FrontierTour{}, problem, rng).order, (std::vector<std::size_t>{1, 0}));
  EXPECT_EQ(plan_views(InformationRate{}, problem, rng).order, std::vector<std::size_t>{1});
  EXPECT_DEATH(plan_views(GreedyGain{}, problem, rng), "a choice that plans ahead");
  problem.place_m.pop_back();
  EXPECT_DEATH(plan_views(FrontierTour{}, problem, rng), "a place of each view");
}

TEST(ViewChoiceDeathTest, NeedsACandidate) {
  Rng rng(1);
  EXPECT_DEATH(choose_view(GreedyGain{}, {}, rng), "needs a candidate");
}

TEST(ExternalChoice, NamesAProgram) {
  const auto check = [](const std::vector<std::string>& command) {
    ExternalChoice choice;
    choice.command = command;
    check_options(choice);
  };
  EXPECT_THROW(check({}), ConfigError);
  EXPECT_THROW(check({std::string()}), ConfigError);
  EXPECT_THROW(check({std::string(), std::string("x")}), ConfigError);
  EXPECT_NO_THROW(check({std::string("planner"), std::string()}));
}

TEST(OpenCandidates, AreAllWhereEachIsExhausted) {
  auto views = five_views();
  views[1].exhausted = views[4].exhausted = true;
  EXPECT_EQ(open_candidates(views), (std::vector<std::size_t>{0, 2, 3}));
  for (Candidate& candidate : views) candidate.exhausted = true;
  EXPECT_EQ(open_candidates(views), (std::vector<std::size_t>{0, 1, 2, 3, 4}));
}

}  // namespace
}  // namespace vantage
