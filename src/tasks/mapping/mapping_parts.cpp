#include "vantage/tasks/mapping/mapping_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "vantage/core/log.hpp"
#include "vantage/core/names.hpp"
#include "vantage/planners/prediction_bands.hpp"
#include "vantage/planners/swept_gain.hpp"
#include "vantage/runtime/episode_loop.hpp"

namespace vantage {
namespace {

/// NaN if that gain was not recorded.
double recorded_prediction(const ScanRecord& scan, std::string_view gain) {
  const auto found =
      std::ranges::find(scan.predicted_cells, gain, &std::pair<std::string, double>::first);
  return found == scan.predicted_cells.end() ? std::numeric_limits<double>::quiet_NaN()
                                             : found->second;
}

}  // namespace

MappingParts::MappingParts(const MappingContext& context, const MappingOptions& options,
                           const MapBelief& belief, std::vector<Predictor> predictors,
                           Navigator navigator, const ForecastLaw& trained)
    : episode_(context.options),
      robot_(context.robot),
      recorder_(context.recorder),
      navigator_(std::move(navigator)),
      budget_(options.budget, options.drive.controller.speed_m_s, robot_, navigator_),
      options_(options),
      evaluator_(context.evaluator),
      outside_(context.outside),
      belief_(belief),
      predictors_(std::move(predictors)),
      calibration_(options.forecast),
      interval_(options.intervals, trained),
      choice_rng_(choice_stream(options.choice, context.options.seed)) {
  recorder_.set_panel([this] { return panel(); });
  navigator_.on_plan = [this](const PlannedPath& path) { recorder_.route(path.waypoints); };
}

void MappingParts::look_round_at_start() {
  scans_tell_pose_ = navigator_.turn_in_place();
  predict(robot_.estimated_sensor());
}

void MappingParts::note_useless(int attempt) const {
  constexpr int kAttempts = 4;
  const std::string what = fmt::format(
      "scan {} shows nothing at {:.2f} s: its frames were lost, stale or without "
      "readings",
      scans_.size() + 1, robot_.time_s());
  if (attempt >= kAttempts)
    throw EpisodeFailed(fmt::format("{}, {} times in a row", what, attempt));
  log_warning(what + ": it is taken again");
}

MappingParts::Before MappingParts::before_update() {
  predicting_.finish();
  current_.predicted_cells = std::move(prediction_.cells);
  current_.by_distance = std::move(prediction_.by_distance);
  at_half_cells_ = prediction_.at_half_cells;
  return {wall_s(), belief_.grid(), robot_.dead_reckoned_base(), robot_.estimated_base()};
}

void MappingParts::correct_pose(const BeliefUpdate& update) {
  navigator_.correct_pose(update.T_world_base, update.information);
  robot_.restart_dead_reckoning();
}

void MappingParts::measure(const Before& before, const BeliefUpdate& update,
                           const Pose& T_world_sensor) {
  current_.map_time_s = wall_s() - before.start_s;
  const auto truth = [&] {
    evaluator_.measure(belief_.grid(), options_.metrics.tolerance_cells, current_);
  };
  BackgroundWork({truth, [&] { hold_forecast_against(before.grid); }}, in_background()).finish();
  current_.time_s = robot_.time_s();
  current_.energy_j = robot_.energy_used_j();
  current_.registered = update.registered;
  current_.unconstrained = update.unconstrained;
  current_.map_sigma_m =
      map_sigma_m(robot_.estimated_base(), navigator_.uncertainty().covariance());
  evaluator_.measure_pose({before.dead_reckoned, before.tracked, update.T_world_base}, current_);
  current_.T_world_sensor = T_world_sensor;
  current_.T_world_base = update.T_world_base;
  if (const LoopClosing* loops = navigator_.loops()) {
    current_.keyframe = loops->remembered().size() - 1;
    note_pose_sigmas(std::array{&current_});
  }
  if (!update.registered) {
    log_warning(fmt::format("scan {}: not registered, {}: the pose tracked on the way is kept",
                            scans_.size() + 1, update.registration_note));
  } else if (update.unconstrained > 0) {
    log_warning(
        fmt::format("scan {}: registered, but for {} of 3 directions, across which nothing is "
                    "seen: there the pose tracked on the way is kept",
                    scans_.size() + 1, update.unconstrained));
  }
}

double MappingParts::map_sigma_m(const Pose2& base, const Eigen::Matrix3d& covariance) const {
  constexpr double kSight_m = 2.0;
  const Eigen::Vector2d from(base.x_m, base.y_m);
  const Eigen::AlignedBox3d region = belief_.grid().frame.box();
  const Eigen::AlignedBox2d floor(region.min().head<2>(), region.max().head<2>());
  double sum_m2 = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    const Eigen::Vector2d to =
        floor.corner(static_cast<Eigen::AlignedBox2d::CornerType>(corner)) - from;
    const Eigen::Vector2d p = from + to * std::min(1.0, kSight_m / std::max(to.norm(), 1e-9));
    sum_m2 += std::pow(mapped_sigma_m(base, covariance, p), 2);
  }
  return std::sqrt(sum_m2 / 4.0);
}

std::string MappingParts::distrust() const {
  const auto worst = std::ranges::max_element(scans_, {}, &ScanRecord::map_sigma_m);
  const double tolerance_m = map_tolerance_m(options_);
  if (worst == scans_.end() || worst->map_sigma_m <= tolerance_m) return {};
  return fmt::format(
      "the map is not to be trusted: at scan {} the robot knew no better than {:.2f} m where it "
      "mapped, localisation.tolerance_cells {} allow {:.2f} m",
      worst - scans_.begin() + 1, worst->map_sigma_m, options_.localisation.tolerance_cells,
      tolerance_m);
}

const ScanRecord& MappingParts::record_scan() {
  current_.path_length_m = recorder_.path_length_m();
  current_.leg_length_m =
      current_.path_length_m - (scans_.empty() ? 0.0 : scans_.back().path_length_m);
  scans_.push_back(std::exchange(current_, {}));
  const ScanRecord& scan = scans_.back();
  budget_.observe(scan, scans_.size() > 1 ? &scans_[scans_.size() - 2] : nullptr);
  log_debug(fmt::format(
      "scan {}: view {}{}, {} new cells, {} observable left, pose error {:.1f} mm", scans_.size(),
      scan.chosen_view, scan.fallback ? " (fallback)" : "", scan.actual_new_cells,
      scan.observable_unobserved_cells, 1e3 * scan.pose_error_m));
  recorder_.scan(scan, scans_.size(), belief_.grid());
  return scan;
}

std::string MappingParts::limit_reached(const std::vector<Candidate>& views) const {
  if (static_cast<int>(scans_.size()) < options_.scans) {
    return budget_.used_up(views, scans_.size());
  }
  return fmt::format("limit of {} scans", options_.scans);
}

void MappingParts::start_decision() { decision_start_s_ = wall_s(); }

/// Of unobserved cells, as `adaptive` takes it.
BlockField MappingParts::transmission() const {
  return calibration_.transmission(belief_.hazard().transmission());
}

/// Cells that `adaptive` promises of the scan to come, had all hazards that factor.
std::vector<PredictionBand> MappingParts::forecast(double hazard_factor, double width_m) const {
  return predict_by_distance(
      {.transmission = calibration_.transmission(belief_.hazard().transmission(), hazard_factor)},
      belief_.filled_grid(), T_world_predicted_, robot_.view_field(), width_m, 1, in_sight_);
}

/// The first scan is left out: nothing was learnt yet.
void MappingParts::hold_forecast_against(const OccupancyGrid& before) {
  count_new_cells(before, belief_.grid(), T_world_predicted_, robot_.view_field(),
                  current_.by_distance, in_sight_);
  current_.actual_new_cells = 0.0;
  for (const PredictionBand& band : current_.by_distance) {
    current_.actual_new_cells += static_cast<double>(band.actual_cells);
  }
  if (scans_.empty()) {
    interval_.start(std::max(current_.actual_new_cells, 1.0));
    return;
  }
  double predicted_cells = 0.0;
  double inside_cells = 0.0;
  for (const PredictionBand& band : current_.by_distance) {
    predicted_cells += band.predicted_cells;
    inside_cells += static_cast<double>(band.actual_cells - band.outside_cells);
  }
  current_.forecast = {predicted_cells, interval_.of(predicted_cells)};
  interval_.observe(predicted_cells, current_.actual_new_cells);
  calibration_.observe(predicted_cells, at_half_cells_, inside_cells);
  current_.hazard_scale = calibration_.scale();
}

std::vector<double> MappingParts::gains_bits(const Gain& gain, std::span<const Candidate> views,
                                             int threads) const {
  const BlockField of_unobserved = transmission();
  return view_gains_bits(gain, {belief_.filled_grid(), &of_unobserved}, views, robot_.view_field(),
                         threads);
}

Approach MappingParts::approach(const Candidate& view,
                                const std::optional<Eigen::Vector2d>& look_at_m) {
  current_.planned_way_m = view.path_length_m;
  return navigator_.approach(robot_.base_for_sensor(view.T_world_sensor), look_at_m);
}

void MappingParts::warn_not_reached(const Candidate& view, const Approach& approach) const {
  log_warning(fmt::format(
      "view {} is {}: scanning from as near as possible", view.id,
      approach.turned_back ? "given up, since the budget allows no longer way" : "out of reach"));
}

/// The belief stays as it is until its next update: until then there is time.
void MappingParts::predict(const Pose& T_world_sensor, InSight in_sight) {
  predicting_.stop();
  T_world_predicted_ = T_world_sensor;
  in_sight_ = std::move(in_sight);
  prediction_ = {};
  predicting_ = BackgroundWork(parts_of_prediction(), in_background());
}

/// Of the scan to come; what is seen in which direction only gains tell that can be swept.
double MappingParts::predicted_by(const Gain& gain) const {
  if (!in_sight_ || !can_sweep(gain)) {
    std::array<Candidate, 1> view;
    view.front().T_world_sensor = T_world_predicted_;
    return gains_bits(gain, view, 1).front();
  }
  const BlockField of_unobserved = transmission();
  const OccupancyGrid& grid = belief_.filled_grid();
  const FieldOfView field = robot_.view_field();
  return predict_by_distance(attenuation_of(gain, {grid, &of_unobserved}), grid, T_world_predicted_,
                             field, field.range_max_m, 1, in_sight_)
      .front()
      .predicted_cells;
}

/// The longest first: gains that cannot be swept.
BackgroundWork::Parts MappingParts::parts_of_prediction() {
  BackgroundWork::Parts parts;
  prediction_.cells.resize(predictors_.size());
  for (const bool swept : {false, true}) {
    for (std::size_t i = 0; i < predictors_.size(); ++i) {
      const Predictor& predictor = predictors_[i];
      if (can_sweep(predictor.gain) != swept) continue;
      parts.emplace_back([this, i, &predictor] {
        prediction_.cells[i] = {predictor.label, predicted_by(predictor.gain)};
      });
    }
  }
  parts.emplace_back(
      [this] { prediction_.by_distance = forecast(1.0, options_.metrics.distance_band_m); });
  if (!options_.forecast.calibrate) return parts;
  parts.emplace_back([this] {
    const double all_m = robot_.view_field().range_max_m;
    prediction_.at_half_cells = forecast(0.5, all_m).front().predicted_cells;
  });
  return parts;
}

/// Where there is one thread, work waits until its result is asked for.
bool MappingParts::in_background() const { return episode_.threads > 1; }

MapPanelInput MappingParts::panel() const {
  MapPanelInput input;
  input.scans_planned = options_.scans;
  input.method = options_.method_name();
  for (const ScanRecord& scan : scans_) {
    input.T_world_chosen.push_back(scan.T_world_sensor);
    input.observable_unobserved_cells.push_back(
        static_cast<double>(scan.observable_unobserved_cells));
  }
  if (!scans_.empty()) {
    input.predicted_new_cells = recorded_prediction(scans_.back(), strategy_label(options_.gain));
    input.actual_new_cells = scans_.back().actual_new_cells;
  }
  input.grid = &belief_.grid();
  for (const Candidate& view : views_) input.T_world_candidates.push_back(view.T_world_sensor);
  if (current_.chosen_view >= 0) {
    const auto goal = static_cast<std::size_t>(current_.chosen_view);
    input.T_world_chosen.push_back(views_[goal].T_world_sensor);
    input.tour = tour_;
    for (PlannedStop& stop : input.tour.stops) {
      if (stop.id < 0) continue;
      const Candidate& view = views_[static_cast<std::size_t>(stop.id)];
      stop.place_m = view.T_world_sensor.translation().head<2>();
    }
  }
  input.T_world_base = robot_.estimated_base();
  input.path_m = navigator_.path_m();
  return input;
}

}  // namespace vantage
