/// What the three threads behind a window hand each other: the player (an episode that runs, or a
/// recording) gives moments, the window gives controls, the painter makes images of both.
#pragma once

#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "vantage/runtime/log/event_log.hpp"
#include "vantage/sim/render/renderer.hpp"
#include "vantage/sim/render/window.hpp"

namespace vantage {

/// `follow` circles the robot, `robot` is what its own camera sees.
enum class ViewCamera { overview, follow, robot };

struct ViewControls {
  PixelSize size{1280, 720};
  ViewCamera camera = ViewCamera::overview;
  FreeCamera overview;
  FreeCamera follow;   ///< `lookat_m` from the middle of the base
  bool map = false;    ///< occupied cells over the scene
  bool gains = false;  ///< candidate views, the one chosen and the way there
  bool help = false;
  std::string playback;              ///< how it is played, for the corner; empty: not said
  std::optional<double> duration_s;  ///< of a recording, whose timeline is shown then
};

struct ViewMoment {
  std::vector<double> state;  ///< World::state()
  std::size_t events = 0;     ///< of the event log so far
  bool still = false;         ///< the player waits here for a screenshot
};

struct ViewFrame {
  RenderedImages image;
  double time_s = 0.0;  ///< simulated
  bool still = false;
};

class ViewLink {
 public:
  /// The player: adds to the event log; gives the moment to show from now on.
  void tell(const EpisodeEvent& event);
  void show(std::vector<double> state, std::size_t events, bool still);
  [[nodiscard]] std::size_t events() const;

  struct Work {
    ViewMoment moment;
    ViewControls controls;
    std::vector<EpisodeEvent> new_events;  ///< since the work before
  };
  /// The painter: waits for something to draw that has not been drawn. Empty once closed.
  std::optional<Work> wait_for_work();
  void deliver(ViewFrame frame);

  /// The window.
  void set_controls(ViewControls controls);
  std::optional<ViewFrame> take_frame();
  void close();

  /// Any thread: what went wrong in it, for the window's to throw.
  void fail(std::exception_ptr error);
  void rethrow();

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<EpisodeEvent> event_log_;
  std::size_t told_ = 0;  ///< events that the painter has
  ViewMoment moment_;
  ViewControls controls_;
  std::optional<ViewFrame> frame_;
  bool drawn_ = true;
  bool closed_ = false;
  std::exception_ptr error_;
};

}  // namespace vantage
