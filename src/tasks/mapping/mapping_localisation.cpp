// What mapping parts make of the navigator's loops: records that have moved, how sure poses are,
// and whether the map is in doubt.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "vantage/core/log.hpp"
#include "vantage/tasks/mapping/mapping_parts.hpp"

namespace vantage {
namespace {

std::vector<ScanRecord*> pointers_to(std::vector<ScanRecord>& scans) {
  std::vector<ScanRecord*> pointers;
  for (ScanRecord& scan : scans) pointers.push_back(&scan);
  return pointers;
}

/// Why the map is in doubt; empty if it is not.
/// @param lost scans that should tell the pose, and do not
std::string doubt_of(const LocalisationSummary& found, std::size_t lost, std::size_t scans,
                     const MappingOptions& options) {
  const LocalisationOptions& limits = options.localisation;
  const double contradicted = found.contradicted_share.value_or(0.0);
  if (static_cast<double>(lost) > limits.max_unregistered * static_cast<double>(scans)) {
    return fmt::format(
        "the map is in doubt: {} of {} scans fit nowhere near where the wheels say, which may have "
        "slipped (localisation.max_unregistered)",
        lost, scans);
  }
  if (contradicted > limits.max_contradicted) {
    return fmt::format(
        "the map is in doubt: {:.1f} % of the beams go through walls of it, walls may be drawn "
        "twice (localisation.max_contradicted)",
        100.0 * contradicted);
  }
  if (found.pose_sigma_m > map_tolerance_m(options)) {
    return fmt::format(
        "the map is in doubt: by what the scans say of each other a pose is known to {:.2f} m, and "
        "no loop says better (localisation.tolerance_cells)",
        found.pose_sigma_m);
  }
  return {};
}

}  // namespace

void MappingParts::correct_records(const PoseCorrection& correction, const Pose& T_base_sensor,
                                   bool scanning) {
  std::vector<ScanRecord*> records = pointers_to(scans_);
  if (scanning) records.push_back(&current_);
  double most_m = 0.0;
  for (ScanRecord* record : records) {
    const Pose2 before = record->T_world_base;
    const Pose2 base = correction.moved(before, record->keyframe);
    most_m = std::max(most_m, std::hypot(base.x_m - before.x_m, base.y_m - before.y_m));
    GroundTruthMapEvaluator::measure_moved_pose(base, *record);
    record->T_world_sensor = to_se3(base) * T_base_sensor;
  }
  if (intended_m_ && !scans_.empty()) {
    intended_m_ = correction.moved(*intended_m_, scans_.back().keyframe);
  }
  // The map is made anew at these poses: it is as sure as they are.
  const auto covariances = note_pose_sigmas(records);
  for (std::size_t i = 0; i < records.size(); ++i) {
    records[i]->map_sigma_m = map_sigma_m(records[i]->T_world_base, covariances[i]);
  }
  robot_.restart_dead_reckoning();
  if (scanning) evaluator_.measure(belief_.grid(), options_.metrics.tolerance_cells, current_);
  log_info(fmt::format(
      "{}: back at a place of before: poses corrected by up to {:.3f} m, map made anew",
      scanning ? fmt::format("scan {}", scans_.size() + 1) : "after the last scan", most_m));
}

std::vector<Eigen::Matrix3d> MappingParts::note_pose_sigmas(
    std::span<ScanRecord* const> records) const {
  const LoopClosing* loops = navigator_.loops();
  if (loops == nullptr) return {};
  std::vector<std::size_t> keyframes;
  for (const ScanRecord* record : records) keyframes.push_back(record->keyframe);
  auto covariances = loops->graph().covariances(keyframes);
  for (std::size_t i = 0; i < records.size(); ++i) {
    records[i]->pose_sigma_m = std::sqrt(covariances[i].topLeftCorner<2, 2>().trace());
  }
  return covariances;
}

void MappingParts::note_agreeing_loops() {
  const LoopClosing* loops = navigator_.loops();
  if (loops == nullptr || loops->graph().loops() == 0) return;
  const std::vector<ScanRecord*> records = pointers_to(scans_);
  const auto covariances = note_pose_sigmas(records);
  const double off_m = loops->disagreement_m();
  for (std::size_t i = 0; i < records.size(); ++i) {
    const double by_loops_m =
        std::hypot(off_m, map_sigma_m(records[i]->T_world_base, covariances[i]));
    records[i]->map_sigma_m = std::min(records[i]->map_sigma_m, by_loops_m);
  }
}

LocalisationSummary MappingParts::localisation() {
  LocalisationSummary summary;
  const std::vector<ScanRecord*> records = pointers_to(scans_);
  note_pose_sigmas(records);
  for (const ScanRecord& scan : scans_) {
    summary.pose_sigma_m = std::max(summary.pose_sigma_m, scan.pose_sigma_m);
  }
  const LoopClosing* loops = navigator_.loops();
  if (loops != nullptr) {
    summary.loops = loops->graph().loops();
    summary.loops_refused = loops->graph().refused();
    summary.corrections = loops->corrections();
    summary.contradicted_share = loops->contradicted_share();
  }
  // Where nothing is to be seen that fixes a pose, scans that fit nowhere are no sign of slip.
  const auto lost = std::ranges::count(scans_, false, &ScanRecord::registered);
  summary.doubt = doubt_of(summary, scans_tell_pose_ ? static_cast<std::size_t>(lost) : 0,
                           scans_.size(), options_);
  return summary;
}

}  // namespace vantage
