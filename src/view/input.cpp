#include "vantage/view/input.hpp"

#include <algorithm>
#include <cctype>
#include <limits>

#include "vantage/view/orbit_camera.hpp"
#include "vantage/view/overlays.hpp"

namespace vantage {
namespace {

constexpr double kSlowest = 1.0 / 16.0;
constexpr double kFastest = 64.0;
constexpr double kJump_s = 5.0;

ViewCamera after(ViewCamera camera) {
  if (camera == ViewCamera::overview) return ViewCamera::follow;
  return camera == ViewCamera::follow ? ViewCamera::robot : ViewCamera::overview;
}

}  // namespace

void ViewInput::operator()(const KeyPressed& event) {
  const char key = static_cast<char>(std::tolower(static_cast<unsigned char>(event.key)));
  switch (key) {
    case keys::escape:
    case 'q': quit = true; return;
    case 's': screenshot = true; return;
    case 'm': controls.map = !controls.map; return;
    case 'g': controls.gains = !controls.gains; return;
    case 'h': controls.help = !controls.help; return;
    case 'c': controls.camera = after(controls.camera); return;
    default: playback_key(key);
  }
}

void ViewInput::playback_key(char key) {
  switch (key) {
    case ' ': gate.toggle_pause(); return;
    case '.':
    case keys::right: gate.step(); return;
    case '+':
    case '=':
    case keys::up: gate.set_speed(std::min(2.0 * gate.speed(), kFastest)); return;
    case '-':
    case keys::down: gate.set_speed(std::max(0.5 * gate.speed(), kSlowest)); return;
    default:
      if (controls.duration_s) recording_key(key);
  }
}

void ViewInput::recording_key(char key) {
  switch (key) {
    case 'r':
    case keys::home: gate.seek(0.0); return;
    case keys::end: gate.seek(std::numeric_limits<double>::infinity()); return;
    case keys::page_up: gate.seek(shown_s - kJump_s); return;
    case keys::page_down: gate.seek(shown_s + kJump_s); return;
    case ',':
    case keys::left:
      gate.pause();
      gate.seek(shown_s - tick_s);
      return;
    default: return;
  }
}

/// The right edge is the end: a tick after the last state.
void ViewInput::scrub_to(double x_px) {
  const double share = std::clamp(x_px / (controls.size.width_px - 1), 0.0, 1.0);
  gate.seek(share * (*controls.duration_s + tick_s));
}

void ViewInput::operator()(const MousePressed& event) {
  const int height_px = controls.size.height_px;
  scrubbing = controls.duration_s && event.button == MouseButton::left &&
              event.at_px.y() >= height_px - timeline_height_px(height_px);
  if (scrubbing) scrub_to(event.at_px.x());
}

void ViewInput::operator()(const MouseDragged& event) {
  if (scrubbing) {
    scrub_to(event.at_px.x());
    return;
  }
  FreeCamera* camera = moved_camera();
  if (camera == nullptr) return;
  const Eigen::Vector2d drag = event.by_px / controls.size.height_px;
  *camera = event.button == MouseButton::left ? orbited(*camera, drag) : panned(*camera, drag);
}

void ViewInput::operator()(const WheelTurned& event) {
  if (FreeCamera* camera = moved_camera()) *camera = zoomed(*camera, event.notches);
}

FreeCamera* ViewInput::moved_camera() {
  if (controls.camera == ViewCamera::robot) return nullptr;
  return controls.camera == ViewCamera::overview ? &controls.overview : &controls.follow;
}

}  // namespace vantage
