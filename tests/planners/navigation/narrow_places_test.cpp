// Which narrow places are worth a search, in drawn floors: 'o' open, 't' room at some heading, '#'
// neither. Answers have 'p' for passages and 'n' for nooks; '.' is thin and left out.
#include "vantage/planners/navigation/narrow_places.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace vantage {
namespace {

using DrawnPlaces = std::vector<std::string>;

/// A nook begins 3 cells from what is open; searches go 2 cells about passages, 5 about nooks and 8
/// about the robot.
constexpr double kPlaceCell_m = 0.125;
constexpr double kFourCells_m2 = 4.0 * kPlaceCell_m * kPlaceCell_m;

DrawnPlaces found_in(const DrawnPlaces& rows,
                     const std::optional<Eigen::Array2i>& start = std::nullopt) {
  const auto ny = static_cast<int>(rows.size());
  const FloorMap floor(Eigen::Vector2d::Zero(), kPlaceCell_m, static_cast<int>(rows.front().size()),
                       ny);
  const auto drawn = [&](std::size_t cell) {
    const Eigen::Array2i at = floor.cell(cell);
    return rows[static_cast<std::size_t>(ny - 1 - at.y())][static_cast<std::size_t>(at.x())];
  };
  std::vector<std::uint8_t> open(floor.size());
  std::vector<std::uint8_t> may_stand(floor.size());
  for (std::size_t cell = 0; cell < floor.size(); ++cell) {
    open[cell] = drawn(cell) == 'o' ? 1 : 0;
    may_stand[cell] = drawn(cell) == 't' ? 1 : 0;
  }
  const auto start_cell = start ? std::optional(floor.index(*start)) : std::nullopt;
  const auto leeway = find_narrow_places(floor, open, may_stand, kFourCells_m2, start_cell);
  DrawnPlaces answer = rows;
  for (std::size_t cell = 0; cell < floor.size(); ++cell) {
    const Eigen::Array2i at = floor.cell(cell);
    char& mark =
        answer[static_cast<std::size_t>(ny - 1 - at.y())][static_cast<std::size_t>(at.x())];
    if (leeway[cell] == Leeway::open) mark = 'o';
    if (leeway[cell] == Leeway::passage) mark = 'p';
    if (leeway[cell] == Leeway::nook) mark = 'n';
    if (leeway[cell] == Leeway::none && drawn(cell) != '#') mark = '.';
  }
  return answer;
}

/// Along the wall below both rooms there is a seam, of which only what is about the door counts.
TEST(NarrowPlacesDrawn, APassageIsWhereSeamsOfTwoRoomsMeet) {
  EXPECT_EQ(found_in({"ooooooooo###ooooooooo",  //
                      "ooooooooottttoooooooo",  //
                      "ttttttttttttttttttttt"}),
            (DrawnPlaces{"ooooooooo###ooooooooo",  //
                         "oooooooooppppoooooooo",  //
                         "......pppppppppp....."}));
}

TEST(NarrowPlacesDrawn, ANookIsFarFromWhatIsOpenAndHasItsWayThere) {
  EXPECT_EQ(found_in({"oo##############tttttttttt",  //
                      "oottttttttttttttt#########",  //
                      "oo########################"}),
            (DrawnPlaces{"oo##############nnnnnnnnnn",  //
                         "oopppnnnnnnnnnnnn#########",  //
                         "oo########################"}));
  EXPECT_EQ(found_in({"oooooooooooooooo##########",  //
                      "tttttttttttttttttttttttttt"}),
            (DrawnPlaces{"oooooooooooooooo##########",  //
                         "..............pppppnnnnnnn"}));
}

/// Four cells are worth going there, three are as narrow as what is about them; cells that touch by
/// a corner are no open place together.
TEST(NarrowPlacesDrawn, AnOpenPlaceIsSoLarge) {
  EXPECT_EQ(found_in({"oo####oo##",  //
                      "oottttottt",  //
                      "##########"}),
            (DrawnPlaces{"oo####oo##",  //
                         "oopppnonnn",  //
                         "##########"}));
  EXPECT_EQ(found_in({"oo##oo####",  //
                      "oottttoott",  //
                      "#########t"}),
            (DrawnPlaces{"oo##oo####",  //
                         "oopppnoonn",  //
                         "#########n"}));
}

/// A nook of four cells counts, in parts that touch by a corner too; one of three does not.
TEST(NarrowPlacesDrawn, ANookIsSoLarge) {
  EXPECT_EQ(found_in({"oo##########",  //
                      "oo#tt#######",  //
                      "oo###tt#####"}),
            (DrawnPlaces{"oo##########",  //
                         "oo#nn#######",  //
                         "oo###nn#####"}));
  EXPECT_EQ(found_in({"oo#########t",  //
                      "oo#ttt####tt",  //
                      "oo#########o"}),
            (DrawnPlaces{"oo#########n",  //
                         "oo#...####nn",  //
                         "oo#########o"}));
}

TEST(NarrowPlacesDrawn, ARobotThatStandsInASeamGetsOutOfIt) {
  const DrawnPlaces seam{"oooooooooooooooooooooooo",  //
                         "ttttttttttt#tttttttttttt",  //
                         "###########t############"};
  EXPECT_EQ(found_in(seam, Eigen::Array2i(5, 1)),
            (DrawnPlaces{"oooooooooooooooooooooooo",  //
                         "ppppppppppp#pp..........",  //
                         "###########p############"}));
  const DrawnPlaces none{"oooooooooooooooooooooooo",  //
                         "...........#............",  //
                         "###########.############"};
  EXPECT_EQ(found_in(seam), none);
  EXPECT_EQ(found_in(seam, Eigen::Array2i(5, 2)), none) << "it stands in the open";
}

}  // namespace
}  // namespace vantage
