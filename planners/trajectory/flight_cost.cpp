#include "vantage/planners/trajectory/flight_cost.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vantage {
namespace {

constexpr double kHere_m = 0.05;  ///< a place so near lies in no direction

/// A place in the axes of the body: x ahead, y left, z up.
Eigen::Vector3d in_body(const Eigen::Vector4d& waypoint, const Eigen::Vector3d& p_world) {
  const double c = std::cos(waypoint[3]);
  const double s = std::sin(waypoint[3]);
  const Eigen::Vector3d d = p_world - waypoint.head<3>();
  return {c * d.x() + s * d.y(), c * d.y() - s * d.x(), d.z()};
}

Eigen::Vector3d in_camera(const FlightCamera& camera, const Eigen::Vector4d& waypoint,
                          const Eigen::Vector3d& p_world) {
  return camera.T_body_camera.linear().transpose() *
         (in_body(waypoint, p_world) - camera.T_body_camera.translation());
}

/// Distance in the image plane if z is in front, else 1; and a small part that grows with the angle
/// from the axis and leads out of where that is flat.
double off_axis(const FlightCostOptions& options, const Eigen::Vector2d& v, double z, double away) {
  const double in_plane = z > 0.0 ? std::min(v.squaredNorm(), 1.0) : 1.0;
  return in_plane + options.bearing_weight * 0.5 * (1.0 - z / away);
}

/// Metres that are missing at a waypoint and half way to its neighbours: the nearest surface.
class NearestSurface {
 public:
  NearestSurface(const FlightCostOptions& options, const Esdf& surface, const Horizon& horizon)
      : between_(options.between_waypoints), surface_(surface), horizon_(horizon) {
    if (between_) ahead_m_ = half_way(-1);
  }

  /// Of the points in order.
  double next_m(Eigen::Index i) {
    const double here_m = surface_.distance_m(horizon_.points.col(i).head<3>());
    if (!between_) return here_m;
    const double behind_m = std::exchange(ahead_m_, half_way(i));
    return std::min({here_m, behind_m, ahead_m_});
  }

 private:
  [[nodiscard]] double half_way(Eigen::Index i) const {
    return surface_.distance_m(0.5 *
                               (horizon_.point(i).head<3>() + horizon_.point(i + 1).head<3>()));
  }
  bool between_;
  const Esdf& surface_;
  const Horizon& horizon_;
  double ahead_m_ = 0.0;
};

class Evaluator {
 public:
  Evaluator(const FlightCostOptions& options, const FlightCamera& camera, FlightSurroundings scene)
      : options_(options), camera_(camera), scene_(std::move(scene)) {}

  void operator()(const Horizon& horizon, Eigen::Ref<Eigen::VectorXd> cost_of_point) const {
    cost_of_point.setZero();
    if (options_.literal) {
      add_obstacle_centres(horizon, cost_of_point);
    } else if (scene_.surface != nullptr) {
      add_surface(horizon, cost_of_point);
    }
    for (Eigen::Index i = 0; i < horizon.count(); ++i) {
      cost_of_point[i] += options_.centre_weight * view_cost(horizon, i);
      if (const auto& target = target_of(i); target && target->flown_to) {
        cost_of_point[i] += options_.recognition_weight *
                            information_cost(options_, target->entropy_nats) *
                            recognition_cost(options_, *target, horizon.points.col(i).head<3>());
      }
    }
  }

 private:
  [[nodiscard]] const std::optional<ObservationTarget>& target_of(Eigen::Index i) const {
    const auto& of_point = scene_.target_of_point;
    return of_point.empty() ? scene_.target : of_point[static_cast<std::size_t>(i)];
  }

  [[nodiscard]] double view_cost(const Horizon& horizon, Eigen::Index i) const {
    const Eigen::Vector4d waypoint = horizon.points.col(i);
    if (const auto& target = target_of(i)) {
      return centre_cost(options_, camera_, waypoint, target->p_world_object_m);
    }
    const Eigen::Vector3d next = horizon.point(i + 1).head<3>();
    return options_.literal ? centre_cost(options_, camera_, waypoint, next)
                            : heading_cost(options_, camera_, waypoint, next);
  }

  [[nodiscard]] double speed_m_s(const Horizon& horizon, Eigen::Index i) const {
    const Eigen::Vector3d moved = (horizon.point(i + 1) - horizon.point(i - 1)).head<3>();
    return moved.norm() / (2.0 * options_.segment_s);
  }

  void add_surface(const Horizon& horizon, Eigen::Ref<Eigen::VectorXd> cost_of_point) const {
    NearestSurface nearest(options_, *scene_.surface, horizon);
    for (Eigen::Index i = 0; i < horizon.count(); ++i) {
      const double distance_m = nearest.next_m(i);
      const double speed = std::max(speed_m_s(horizon, i), options_.speed_floor_m_s);
      cost_of_point[i] +=
          options_.obstacle_weight * obstacle_cost(options_, distance_m, speed) +
          options_.clearance_weight * std::max(options_.clearance_m - distance_m, 0.0);
    }
  }

  void add_obstacle_centres(const Horizon& horizon,
                            Eigen::Ref<Eigen::VectorXd> cost_of_point) const {
    for (Eigen::Index i = 0; i < horizon.count(); ++i) {
      for (const Eigen::Vector3d& p : scene_.p_world_obstacles_m) {
        const double distance_m = (horizon.points.col(i).head<3>() - p).norm();
        if (distance_m >= options_.delta_m) continue;
        cost_of_point[i] +=
            options_.obstacle_weight * obstacle_cost(options_, distance_m, speed_m_s(horizon, i));
      }
    }
  }

  FlightCostOptions options_;
  FlightCamera camera_;
  FlightSurroundings scene_;
};

}  // namespace

FlightCamera flight_camera(const Pose& T_body_camera, int width_px, int height_px,
                           double vertical_fov_rad) {
  const double focal_px = 0.5 * height_px / std::tan(0.5 * vertical_fov_rad);
  return {.T_body_camera = T_body_camera,
          .horizontal_fov_rad = 2.0 * std::atan(0.5 * width_px / focal_px),
          .vertical_fov_rad = vertical_fov_rad};
}

Pose camera_ahead(double pitch_rad, const Eigen::Vector3d& p_body_camera_m) {
  const double c = std::cos(pitch_rad);
  const double s = std::sin(pitch_rad);
  Pose T_body_camera = Pose::Identity();
  T_body_camera.translation() = p_body_camera_m;
  T_body_camera.linear().col(0) = -Eigen::Vector3d::UnitY();     // right
  T_body_camera.linear().col(1) = Eigen::Vector3d(-s, 0.0, -c);  // down
  T_body_camera.linear().col(2) = Eigen::Vector3d(c, 0.0, -s);   // along the axis
  return T_body_camera;
}

double obstacle_cost(const FlightCostOptions& options, double distance_m, double speed_m_s) {
  return std::max(options.epsilon_m + options.body_radius_m - distance_m, 0.0) * speed_m_s;
}

std::optional<Eigen::Vector2d> in_frame(const FlightCamera& camera, const Eigen::Vector4d& waypoint,
                                        const Eigen::Vector3d& p_world) {
  const Eigen::Vector3d p = in_camera(camera, waypoint, p_world);
  if (p.z() <= 0.0) return std::nullopt;
  return Eigen::Vector2d(p.x() / p.z() / std::tan(0.5 * camera.horizontal_fov_rad),
                         p.y() / p.z() / std::tan(0.5 * camera.vertical_fov_rad));
}

double centre_cost(const FlightCostOptions& options, const FlightCamera& camera,
                   const Eigen::Vector4d& waypoint, const Eigen::Vector3d& p_world) {
  if (options.literal) return 1.0;  // min(|v|^2, 1) of v = [vx, vy, 1]
  const Eigen::Vector3d p = in_camera(camera, waypoint, p_world);
  const Eigen::Vector2d v(p.x() / p.z() / std::tan(0.5 * camera.horizontal_fov_rad),
                          p.y() / p.z() / std::tan(0.5 * camera.vertical_fov_rad));
  const double away = p.norm();
  return away < kHere_m ? 1.0 : off_axis(options, v, p.z(), away);
}

double heading_cost(const FlightCostOptions& options, const FlightCamera& camera,
                    const Eigen::Vector4d& waypoint, const Eigen::Vector3d& p_world) {
  const Eigen::Vector2d to = in_body(waypoint, p_world).head<2>();
  const double away = to.norm();
  const Eigen::Vector2d axis = camera.T_body_camera.linear().col(2).head<2>().normalized();
  if (away < kHere_m) return 0.0;
  const double z = axis.dot(to);
  const double x = axis.x() * to.y() - axis.y() * to.x();
  const Eigen::Vector2d v(x / z / std::tan(0.5 * camera.horizontal_fov_rad), 0.0);
  return off_axis(options, v, z, away);
}

double recognition_cost(const FlightCostOptions& options, const ObservationTarget& target,
                        const Eigen::Vector3d& p_world) {
  const Eigen::Vector3d direction = (target.p_world_view_m - target.p_world_object_m).normalized();
  const Eigen::Vector3d from_object = p_world - target.p_world_object_m;
  const double along = direction.dot(from_object);
  if (options.literal) return from_object.norm() + (from_object - along * direction).norm();
  return (p_world - target.p_world_view_m).norm() +
         (from_object - std::max(along, 0.0) * direction).norm();
}

double information_cost(const FlightCostOptions& options, double entropy_nats) {
  return options.information && entropy_nats < options.tau_nats ? 0.0 : 1.0;
}

PathCost flight_cost(const FlightCostOptions& options, const FlightCamera& camera,
                     FlightSurroundings scene) {
  return Evaluator(options, camera, std::move(scene));
}

}  // namespace vantage
