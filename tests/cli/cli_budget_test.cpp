// Budgets that cannot be kept, as a user meets them: a failed episode is recorded, and one line
// says why.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command_line.hpp"

namespace vantage {
namespace {

using nlohmann::json;

std::string wall(double x0, double y0, double x1, double y1) {
  return fmt::format("<geom type=\"box\" pos=\"{} {} 1\" size=\"{} {} 1\"/>\n", 0.5 * (x0 + x1),
                     0.5 * (y0 + y1), 0.5 * (x1 - x0), 0.5 * (y1 - y0));
}

/// A recess of 1.65 x 1.6 m, and a room of 3 x 3.2 m to which it is open. A door slides shut before
/// the recess within 90 s: a spring far off pulls it, and the damping lets it go at 19 mm/s.
std::string recess_that_is_shut() {
  return "<mujoco model=\"recess\"><worldbody>\n"
         "<light directional=\"true\" pos=\"0 0 3\" dir=\"-0.4 0.3 -1\"/>\n"
         "<geom type=\"plane\" size=\"4 3 0.1\"/>\n" +
         wall(-3.1, -1.7, 3.1, -1.6) + wall(-3.1, 1.6, 3.1, 1.7) + wall(-3.1, -1.6, -1.7, 1.6) +
         wall(3.0, -1.6, 3.1, 1.6) + wall(-1.7, -1.6, -0.05, -0.8) + wall(-1.7, 0.8, -0.05, 1.6) +
         wall(2.4, -1.5, 2.9, -1.3) +
         R"(<body pos="-0.12 1.7 1">
  <joint type="slide" axis="0 1 0" limited="true" range="-1.7 0" stiffness="1" springref="-10" damping="529"/>
  <geom type="box" size="0.04 0.78 0.95" mass="20" contype="0" conaffinity="0"/>
</body>
<site name="start" pos="-1 0 0"/>
</worldbody></mujoco>
)";
}

class BudgetCommands : public CommandLine {
 protected:
  /// The one line that says why, and the same in metrics.json.
  void expect_failed(const Result& result, const std::string& reason) {
    EXPECT_EQ(result.exit_code, 1) << result.output;
    EXPECT_THAT(result.output, HasSubstr("error: failed: " + reason));
    const json metrics = json::parse(read_file(folder_ / "run/metrics.json"));
    EXPECT_EQ(metrics["status"], "failed");
    EXPECT_THAT(metrics["reason"].get<std::string>(), HasSubstr(reason));
    EXPECT_EQ(metrics["budget"]["kept"], false);
  }
};

TEST_F(BudgetCommands, OneTooSmallToMoveIsAFailureThatSaysSo) {
  expect_failed(vantage("run --set scans=2 --set laser.scan_duration_s=2 "
                        "--set 'map.cells=[33,33,17]' --set budget.time_s=10 -q --out run"),
                "budget.time_s 10: too small to go anywhere");
}

TEST_F(BudgetCommands, AHomeThatIsOutOfReachIsAFailureThatSaysSo) {
  file("recess.xml", recess_that_is_shut());
  expect_failed(
      vantage("run " VANTAGE_SOURCE_DIR
              "/assets/episodes/office_small.yaml --out run -q --set scene=recess.xml "
              "--set robot.start_site=start --set scans=2 --set enough.scans=0 "
              "--set 'map.size_m=[6.2,3.4,2]' --set 'map.cells=[104,57,34]' "
              "--set floor_map.half_size_m=4 --set camera.width_px=160 --set camera.height_px=120 "
              "--set stride_px=1 --set frontiers.min_cells=20 --set budget.return_to_start=true"),
      "budget.return_to_start: the start was not reached");
  const json metrics = json::parse(read_file(folder_ / "run/metrics.json"));
  EXPECT_EQ(metrics["scans"].size(), 2U);
  EXPECT_EQ(metrics["collisions"], 0) << "it stops before the door";
}

}  // namespace
}  // namespace vantage
