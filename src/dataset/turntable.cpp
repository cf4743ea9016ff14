#include "vantage/dataset/turntable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vantage {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

/// The camera looks at the axis at half the object's height.
double aim_height_m(const TurntableObject& object) { return 0.5 * object.box_m.sizes().z(); }

/// Of the sphere round the aim point that holds the object at any yaw.
double reach_m(const TurntableObject& object, const Session& session) {
  const Vector3d half = 0.5 * object.box_m.sizes();
  return std::hypot(half.head<2>().norm() + session.offset_m.norm(), half.z());
}

constexpr std::string_view kScene = R"(<mujoco model="turntable">
  <compiler angle="radian" convexhull="false"/>
  <statistic extent="1" center="0 0 0"/>
  <visual>
    <map znear="0.05" zfar="20"/>
    <quality shadowsize="0" offsamples="0"/>
    <headlight ambient="{ambient} {ambient} {ambient}" diffuse="0.2 0.2 0.2" specular="0 0 0"/>
  </visual>
  <asset>
    <mesh name="object" file="object.obj"/>
    <texture name="object" type="2d" file="object.png"/>
    <material name="object" texture="object" specular="{specular}" shininess="{shininess}"/>
    <material name="table" rgba="{table} {table} {table} 1" specular="0.1"/>
  </asset>
  <worldbody>
    <light directional="true" castshadow="false" dir="{lamp}" diffuse="0.5 0.5 0.5" specular="0.25 0.25 0.25"/>
    <geom name="table" type="cylinder" size="0.24 0.01" pos="0 0 -0.01" material="table"/>
    <geom name="floor" type="plane" size="3 3 0.1" pos="0 0 -0.12" rgba="0.42 0.4 0.38 1"/>
    <body name="object" mocap="true">
      <geom name="object" type="mesh" mesh="object" material="object" pos="{at}"/>
    </body>
    <camera name="camera" pos="{eye}" xyaxes="0 1 0 {up}" fovy="{fovy}"/>
  </worldbody>
</mujoco>
)";

std::string xyz(const Vector3d& v) { return fmt::format("{} {} {}", v.x(), v.y(), v.z()); }

/// The camera stands on the +x side of the axis.
std::string turntable_mjcf(const TurntableObject& object, const Session& session, int radius_px) {
  const double c = std::cos(session.elevation_rad);
  const double s = std::sin(session.elevation_rad);
  const Vector3d eye =
      session.distance_m * Vector3d(c, 0, s) + aim_height_m(object) * Vector3d::UnitZ();
  const Vector3d middle = object.box_m.center();
  const Vector3d at(session.offset_m.x() - middle.x(), session.offset_m.y() - middle.y(),
                    -object.box_m.min().z());
  const double lamp_level = std::cos(session.lamp_elevation_rad);
  const Vector3d lamp(-lamp_level * std::cos(session.lamp_heading_rad),
                      -lamp_level * std::sin(session.lamp_heading_rad),
                      -std::sin(session.lamp_elevation_rad));
  using namespace fmt::literals;
  return fmt::format(kScene, "ambient"_a = session.ambient, "specular"_a = object.specular,
                     "shininess"_a = 0.3 + 0.5 * object.specular, "table"_a = session.table,
                     "lamp"_a = xyz(lamp), "at"_a = xyz(at), "eye"_a = xyz(eye),
                     "up"_a = xyz({-s, 0, c}),
                     "fovy"_a = 360.0 / pi * std::atan((radius_px + 0.5) / kFocal_px));
}

ModelPtr compile(const TurntableObject& object, const std::string& mjcf, const std::string& name) {
  const std::array<MemoryFile, 2> files{MemoryFile{"object.obj", object.obj},
                                        MemoryFile{"object.png", object.png}};
  return load_model(mjcf, files, name).model;
}

}  // namespace

Session draw_session(const DatasetOptions& options, double elevation_rad, Rng& rng) {
  const auto varied = [&](double middle, double range) {
    return middle + options.lighting * range * rng.uniform(-1.0, 1.0);
  };
  Session session;
  session.elevation_rad = elevation_rad;
  session.distance_m = options.distance_m * rng.uniform(0.97, 1.03);
  const double heading = rng.uniform(-pi, pi);
  session.offset_m = options.placement_m * std::sqrt(rng.uniform()) *
                     Eigen::Vector2d(std::cos(heading), std::sin(heading));
  session.first_yaw_rad = rng.uniform(0.0, options.step_deg) * pi / 180.0;
  session.lamp_heading_rad = varied(0.6, 1.2);
  session.lamp_elevation_rad = varied(1.0, 0.25);
  session.ambient = std::clamp(varied(0.42, 0.06), 0.0, 1.0);
  session.table = std::clamp(varied(0.62, 0.12), 0.0, 1.0);
  const double exposure = varied(1.0, 0.08);
  for (double& gain : session.gain) gain = exposure * varied(1.0, 0.03);
  return session;
}

int window_radius_px(const TurntableObject& object, const Session& session,
                     const std::string& name) {
  constexpr int kEdge_px = 8;  // for the mask's growth and the crop's margin
  constexpr int kMax_px = kImageHeight_px / 2 - 1;
  const double reach = reach_m(object, session);
  if (reach < session.distance_m) {
    const double radius =
        kFocal_px * reach / std::sqrt(session.distance_m * session.distance_m - reach * reach);
    if (radius + kEdge_px <= kMax_px) return static_cast<int>(std::ceil(radius)) + kEdge_px;
  }
  throw InputError(fmt::format(
      "{}: reaches {:.3f} m from its middle, too far for the image at distance_m {:.3f}", name,
      reach, session.distance_m));
}

Turntable::Turntable(const TurntableObject& object, const Session& session,
                     const DatasetOptions& options, const std::string& name,
                     std::shared_ptr<OffscreenContext> context)
    : radius_px_(window_radius_px(object, session, name)),
      scene_(compile(object, turntable_mjcf(object, session, radius_px_), name),
             (2 * radius_px_ + 1) * options.supersampling,
             (2 * radius_px_ + 1) * options.supersampling, std::move(context)) {}

void Turntable::draw(double yaw_rad, RenderedImages& out) {
  scene_.set_pose("object", make_pose(Vector3d::Zero(), yaw_rad));
  scene_.render("camera", RenderRequest{}, out);
}

}  // namespace vantage
