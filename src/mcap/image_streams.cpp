// Images of the robot's camera and of the whole scene, drawn again from the recorded states.
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <memory>

#include "vantage/mcap/messages.hpp"
#include "vantage/mcap/run_streams.hpp"
#include "vantage/sim/render/overview.hpp"
#include "vantage/sim/robots/robot_names.hpp"

namespace vantage {
namespace {

constexpr const char* kCameraFrame = "camera";

/// Draws one view of the run; keeps the last image, of which there are several messages.
class Shots {
 public:
  Shots(RunToExport& run, std::shared_ptr<Renderer> renderer, CameraView view, bool for_people)
      : run_(run),
        renderer_(std::move(renderer)),
        view_(std::move(view)),
        for_people_(for_people) {}

  const RenderedImages& at(std::size_t state) {
    if (drawn_ == state) return images_;
    const World& world = run_.world_at(state);
    const RenderRequest request{.depth_and_segmentation = false, .for_people = for_people_};
    renderer_->render(world.model(), world.snapshot(), view_, request, images_);
    drawn_ = state;
    return images_;
  }

  std::string png(std::size_t state) {
    const RenderedImages& images = at(state);
    const cv::Mat rgb(images.height_px, images.width_px, CV_8UC3,
                      const_cast<std::uint8_t*>(images.rgb.data()));
    cv::Mat bgr;
    cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
    std::vector<unsigned char> bytes;
    cv::imencode(".png", bgr, bytes);
    return {bytes.begin(), bytes.end()};
  }

 private:
  RunToExport& run_;
  std::shared_ptr<Renderer> renderer_;
  CameraView view_;
  bool for_people_;
  RenderedImages images_;
  std::optional<std::size_t> drawn_;
};

void add_shots(const RunToExport& run, double period_s, const std::string& topic,
               const std::string& frame, const std::shared_ptr<Shots>& shots, Timeline& timeline) {
  const std::size_t images = timeline.add_stream(topic, "CompressedImage");
  for (const std::size_t state : run.states_every(period_s)) {
    const double time_s = run.time_s(state);
    timeline.add(images, time_s,
                 [=] { return compressed_image(time_s, frame, shots->png(state)); });
  }
}

/// Where the camera is and how it projects, beside its images.
void add_geometry(const RunToExport& run, double period_s, const std::shared_ptr<Shots>& shots,
                  Timeline& timeline) {
  const std::size_t transforms = timeline.add_stream("/camera/tf", "FrameTransforms");
  const std::size_t calibration = timeline.add_stream("/camera/calibration", "CameraCalibration");
  for (const std::size_t state : run.states_every(period_s)) {
    const double time_s = run.time_s(state);
    timeline.add(transforms, time_s, [=] {
      return frame_transforms(time_s, {{kCameraFrame, shots->at(state).T_world_camera}});
    });
    timeline.add(calibration, time_s, [=] {
      const RenderedImages& images = shots->at(state);
      return camera_calibration(time_s, kCameraFrame, images.width_px, images.height_px,
                                images.focal_px);
    });
  }
}

}  // namespace

void add_images(RunToExport& run, double period_s, int height_px, Timeline& timeline) {
  const mjModel& model = run.world().model();
  const std::shared_ptr<Renderer> renderer =
      make_offscreen_renderer(model, height_px * 4 / 3, height_px);
  if (const auto camera = robot_camera(model)) {
    const auto shots = std::make_shared<Shots>(run, renderer, FixedCamera{*camera}, false);
    add_shots(run, period_s, "/camera", kCameraFrame, shots, timeline);
    add_geometry(run, period_s, shots, timeline);
  }
  add_shots(run, period_s, "/overview", std::string(kWorldFrame),
            std::make_shared<Shots>(run, renderer, overview_camera(model), true), timeline);
}

}  // namespace vantage
