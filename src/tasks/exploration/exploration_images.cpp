// What the parts of exploration observe: which images are taken, and of those that come, which
// count.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "vantage/perception/clouds/usable_readings.hpp"
#include "vantage/tasks/exploration/exploration_parts.hpp"

namespace vantage {
namespace {

/// Discards readings that are none. @return false: it is stale
/// @param last image that came, then this one
bool keep_usable(CameraImages& image, CameraImages& last) {
  discard_unusable(image);
  if (is_repeated(last, image)) return false;
  last.depth_m = image.depth_m;
  return true;
}

/// Discards what says nothing: stale images, readings that are none. @return whether anything is
/// left
/// @param last of the observation before, then of this one
bool keep_usable(ExplorationObservation& observation, CameraImages& last) {
  discard_unusable(observation.base_scan);
  std::vector<HeadView> views;
  for (HeadView& view : observation.views) {
    if (keep_usable(view.image, last)) views.push_back(std::move(view));
  }
  observation.views = std::move(views);
  return std::ranges::any_of(observation.views, [](const HeadView& view) {
    return std::ranges::any_of(view.image.depth_m, [](float depth_m) { return depth_m > 0.0F; });
  });
}

}  // namespace

ExplorationObservation ExplorationParts::observe() {
  if (scans_.empty()) {
    const Pose2 start = robot_.estimated_base();
    p_start_m_ = {start.x_m, start.y_m};
    traverse(p_start_m_, task_.start_room_m);
    look_round_at_start();
  }
  return observed([this] {
    return first_usable<ExplorationObservation>([this](ExplorationObservation& observation) {
      observation = exploring_robot_.observe(images_);
      const std::size_t asked =
          images_.empty() ? exploring_robot_.sweep_images().gazes().size() : images_.size();
      const bool usable = keep_usable(observation, last_image_);
      missed_images_ = observation.views.size() < asked;
      if (usable) return true;
      take_all_images();
      return false;
    });
  });
}

/// A few may well look past all that is in range, time and again; all of them never do.
void ExplorationParts::take_all_images() {
  if (images_.empty()) return;
  images_.clear();
  current_.scan_share = 1.0;
  predict(robot_.estimated_sensor());
}

/// What the image shows is in the map at once: the next look is to be at something else. Holes are
/// filled when the robot is there.
void ExplorationParts::look_on_the_way() {
  constexpr double kSteady_rad = 0.02;  // turned since it was last told
  if (scans_.empty()) return;           // it turns once before the first
  const Pose2 base = robot_.estimated_base();
  const double turned_rad =
      wrap_angle(base.yaw_rad - std::exchange(yaw_on_the_way_rad_, base.yaw_rad));
  if (last_look_) {
    const double gone_m = std::hypot(base.x_m - last_look_->x_m, base.y_m - last_look_->y_m);
    if (gone_m < task_.gaze.on_the_way_m || std::abs(turned_rad) > kSteady_rad ||
        !exploring_robot_.head_rests()) {
      return;
    }
    take_image(base);
  }
  last_look_ = base;
  const SweepImages& sweep = exploring_robot_.sweep_images();
  const auto gains = gains_of_images(sweep, lookout(belief_.grid(), robot_.estimated_sensor()));
  const auto best = std::ranges::max_element(gains) - gains.begin();
  exploring_robot_.look(sweep.gazes()[static_cast<std::size_t>(best)]);
}

void ExplorationParts::take_image(const Pose2& T_world_base) {
  auto view = exploring_robot_.take_image();
  if (!view || !keep_usable(view->image, last_image_)) return;
  belief_.update(*view, T_world_base);
  ++current_.images_on_the_way;
  if (navigator_.loops() == nullptr) return;
  const auto& remembered = navigator_.loops()->remembered();
  belief_.keep(*view, compose(inverse(remembered.back().T_world_base), T_world_base),
               remembered.size() - 1);
}

void ExplorationParts::choose_images() {
  const SweepImages& sweep = partial_scans_->images;
  const Pose T_world_sweep = robot_.estimated_sensor();
  images_ = images_worth_taking(T_world_sweep, robot_.time_s() - scans_.back().time_s);
  current_.scan_share =
      static_cast<double>(images_.size()) / static_cast<double>(sweep.gazes().size());
  predict(T_world_sweep, [sweep, images = images_](const Eigen::Vector3d& p) {
    return sweep.any_shows(images, p);
  });
}

}  // namespace vantage
