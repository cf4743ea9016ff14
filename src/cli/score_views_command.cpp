#include "vantage/cli/score_views_command.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "vantage/cli/common_flags.hpp"
#include "vantage/cli/hints/text_check.hpp"
#include "vantage/cli/view_scoring.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/planners/views/view_list.hpp"
#include "vantage/runtime/json.hpp"

namespace vantage {
namespace {

struct ScoreViewsArguments {
  ScoreArguments score;
  std::filesystem::path write_views;
  bool overwrite = false;
  bool json = false;
};

std::string footer() {
  return "Outside the region (by default the box of the map's known cells) nothing counts. Cells\n"
         "with 0.4 < p(occupied) < 0.6, and those not in the map, are unobserved.\n"
         "Keys of --set with their defaults. Left open (~): transmission_per_m is 0.5 and sets\n"
         "gain.a unless that is given; the region is the box of the known cells; views.height_m "
         "is\n"
         "any height.\n\n" +
         to_yaml(write_node(ViewScoring{}));
}

ExitCode score_views_command(const ScoreViewsArguments& arguments) {
  require_absent(arguments.write_views, arguments.overwrite, "--write-views");
  const ScoredViews scored = run_view_scoring(arguments.score);
  if (scored.views.front().gain_bits <= 0.0) {
    log_warning(fmt::format(
        "no view sees anything of worth: do map and views share a frame, and "
        "is there anything unobserved in [{:g}] to [{:g}] m?",
        fmt::join(scored.region_m.min(), ", "), fmt::join(scored.region_m.max(), ", ")));
  }
  if (!arguments.write_views.empty()) write_file(arguments.write_views, views_csv(scored.views));
  std::fputs((arguments.json ? json_text(scores_json(scored)) : scores_text(scored)).c_str(),
             stdout);
  return ExitCode::done;
}

}  // namespace

std::function<ExitCode()> declare_score_views(CLI::App& app) {
  auto arguments = std::make_shared<ScoreViewsArguments>();
  ScoreArguments& score = arguments->score;
  app.add_option("--map", score.map, "OctoMap of your robot, .bt or .ot")->required();
  app.add_option("--views", score.views,
                 "CSV of sensor poses: x_m,y_m,z_m,yaw_rad[,pitch_rad][,id]; pitch looks down. "
                 "Default: sampled in the map's free space, see the keys views")
      ->check(not_empty);
  app.add_option("--sensor", score.sensor,
                 "YAML of the keys sensor below. Default: an RGB-D camera, 57.8 x 45 deg, 3.5 m")
      ->check(not_empty);
  app.add_option(
         "--gain", score.gain,
         "what a view is worth, one of `vantage list gains`. Default: beer_lambert, half of "
         "a beam passing each metre of unobserved space (transmission_per_m)")
      ->check(not_empty);
  app.add_option("--set", score.overrides, "key=value of the keys below")
      ->type_size(1)
      ->allow_extra_args(false);
  app.add_option("--seed", score.seed, "of sampled views")->check(whole_number);
  app.add_option("--write-views", arguments->write_views, "write the views, best first, as CSV")
      ->check(not_empty);
  add_overwrite(app, arguments->overwrite);
  add_json(app, arguments->json);
  app.footer(footer);
  return [arguments] { return score_views_command(*arguments); };
}

}  // namespace vantage
