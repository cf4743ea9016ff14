/// An object on a turntable before a camera: what one video of the dataset is taken of.
#pragma once

#include <memory>
#include <string>

#include "vantage/core/rng.hpp"
#include "vantage/dataset/object_source.hpp"
#include "vantage/sim/render/posed_scene.hpp"

namespace vantage {

/// What changes from one video to the next. Draws happen in the order of the members.
struct Session {
  double elevation_rad = 0.0;  ///< of the camera above the turntable
  double distance_m = 0.0;     ///< camera to the aim point on the axis
  Eigen::Vector2d offset_m;    ///< of the object's middle from the axis, at yaw 0
  double first_yaw_rad = 0.0;
  double lamp_heading_rad = 0.0;
  double lamp_elevation_rad = 0.0;
  double ambient = 0.0;           ///< brightness of light from everywhere, [0, 1]
  double table = 0.0;             ///< brightness of the turntable, [0, 1]
  Eigen::Vector3d gain{1, 1, 1};  ///< exposure and white balance, of red, green, blue
};
Session draw_session(const DatasetOptions& options, double elevation_rad, Rng& rng);

inline constexpr double kFocal_px = 570.3;
inline constexpr int kImageWidth_px = 640;
inline constexpr int kImageHeight_px = 480;

/// Half the side of the square window round the middle of the image that holds the object at any
/// yaw: the window's middle pixel lies on the optical axis.
/// @throws InputError naming the object if it does not fit into the image.
int window_radius_px(const TurntableObject& object, const Session& session,
                     const std::string& name);

/// Draws the window of a virtual camera of kImageWidth_px x kImageHeight_px px and kFocal_px.
class Turntable {
 public:
  /// @throws InputError if MuJoCo cannot use the mesh, RendererError without OpenGL.
  Turntable(const TurntableObject& object, const Session& session, const DatasetOptions& options,
            const std::string& name, std::shared_ptr<OffscreenContext> context);

  /// Supersampled images of the object turned by `yaw_rad` about the axis.
  void draw(double yaw_rad, RenderedImages& out);
  [[nodiscard]] int radius_px() const { return radius_px_; }
  [[nodiscard]] int object_geom() const { return scene_.geom_id("object"); }

 private:
  int radius_px_;
  PosedScene scene_;
};

}  // namespace vantage
