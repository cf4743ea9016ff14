#include "vantage/view/session.hpp"

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <atomic>
#include <chrono>
#include <csignal>
#include <limits>
#include <thread>
#include <utility>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/view/input.hpp"
#include "vantage/view/painter.hpp"

namespace vantage {
namespace {

constexpr double kPoll_s = 1.0 / 60.0;
/// The painter leaves a core to the simulation.
constexpr std::chrono::milliseconds kBetweenFrames{30};
constexpr std::chrono::milliseconds kStillPoll{5};

void write_png(const std::filesystem::path& path, RenderedImages image) {
  const cv::Mat rgb(image.height_px, image.width_px, CV_8UC3, image.rgb.data());
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  write_file_with(path, [&](const auto& part) { return cv::imwrite(part.string(), bgr); });
}

/// A live episode goes on if the folder takes no picture.
void keep_picture(const std::filesystem::path& path, RenderedImages image) {
  try {
    write_png(path, std::move(image));
    log_info("written: " + path.string());
  } catch (const OutputError& e) {
    log_warning(e.what());
  }
}

/// The painter's and the player's threads, which end with it.
class Crew {
 public:
  Crew(const ViewScene& scene, World& world, const Player& player, double speed,
       const ViewControls& controls)
      : gate(speed) {
    link.set_controls(controls);  // the first frame is drawn with them
    painter_ = std::thread([&, scene] { guarded([&] { paint(world, scene); }); });
    player_ = std::thread([&] {
      guarded([&] { code_ = player(link, gate); });
      ended_ = true;
    });
  }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;
  ~Crew() { dismiss(); }

  /// @return what the player came to. @throws what a thread threw
  ExitCode finish() {
    dismiss();
    link.rethrow();
    return code_;
  }

  [[nodiscard]] bool ended() const { return ended_; }  ///< the player is

  ViewLink link;
  PlaybackGate gate;

 private:
  void guarded(const std::function<void()>& work) {
    try {
      work();
    } catch (...) {
      link.fail(std::current_exception());
    }
  }
  void paint(World& world, const ViewScene& scene) {
    ViewPainter painter(world, scene);
    while (const auto work = link.wait_for_work()) {
      const auto next = std::chrono::steady_clock::now() + kBetweenFrames;
      link.deliver(painter.paint(*work));
      std::this_thread::sleep_until(next);
    }
  }
  void dismiss() {
    gate.close();
    link.close();
    if (painter_.joinable()) painter_.join();
    if (player_.joinable()) player_.join();
  }

  ExitCode code_ = ExitCode::done;
  std::atomic<bool> ended_ = false;
  std::thread painter_;
  std::thread player_;
};

ViewControls first_controls(const World& world, const ViewSubject& subject,
                            const ViewOptions& options) {
  ViewControls controls{.size = options.size,
                        .camera = options.camera,
                        .overview = overview_of(world, vantage::window(subject.resolved)),
                        .follow = follow_of_robot(),
                        .map = options.map,
                        .gains = options.gains,
                        .playback = {},
                        .duration_s = std::nullopt};
  if (options.screenshot.empty()) controls.duration_s = subject.duration_s;
  return controls;
}

std::string playback_text(const Crew& crew, bool recorded) {
  std::string pace = fmt::format("{:g} x", crew.gate.speed());
  if (crew.gate.paused()) pace = "paused";
  if (crew.ended()) pace = "ended";
  return fmt::format("{}    {}    h: help", recorded ? "recording" : "live", pace);
}

/// The image of the still moment, drawn in memory: no window has a part in it.
void take_still(Crew& crew, const std::filesystem::path& file) {
  while (interrupt_signal() == 0) {
    crew.link.rethrow();
    const auto frame = crew.link.take_frame();
    if (frame && frame->still) {
      write_png(file, frame->image);
      return;
    }
    std::this_thread::sleep_for(kStillPoll);
  }
  throw Interrupted(interrupt_signal());
}

void keep_open(Window& window, Crew& crew, ViewControls controls, const ViewSubject& subject) {
  ViewInput input{.controls = controls,
                  .gate = crew.gate,
                  .tick_s = subject.resolved.setup.options.simulation.control_period_s};
  RenderedImages shown;
  while (!window.closed() && !input.quit && interrupt_signal() == 0) {
    const auto events = window.wait(kPoll_s);
    for (const WindowEvent& event : events) std::visit(input, event);
    crew.link.rethrow();
    const std::string playback = playback_text(crew, subject.duration_s.has_value());
    if (!events.empty() || playback != controls.playback || controls.size != window.size()) {
      controls.playback = playback;
      controls.size = window.size();
      crew.link.set_controls(controls);
    }
    if (auto frame = crew.link.take_frame()) {
      input.shown_s = frame->time_s;
      shown = std::move(frame->image);
      window.show(shown);
    }
    if (!std::exchange(input.screenshot, false) || shown.rgb.empty()) continue;
    keep_picture(fmt::format("vantage-view-{:.2f}s.png", input.shown_s),
                 window.show_and_read(shown));
  }
}

/// Until the still moment is drawn, or the window is closed.
ExitCode look(std::optional<Window>& window, World& world, const ViewSubject& subject,
              const ViewOptions& options, const Player& player) {
  const ResolvedEpisode& resolved = subject.resolved;
  const ViewScene scene{method_name(resolved.task), vantage::window(resolved)};
  const ViewControls controls = first_controls(world, subject, options);
  Crew crew(scene, world, player, window ? 1.0 : std::numeric_limits<double>::infinity(), controls);
  if (window) {
    keep_open(*window, crew, controls, subject);
  } else {
    take_still(crew, options.screenshot);
  }
  window.reset();  // an episode may take a moment to write what there is
  return crew.finish();
}

}  // namespace

ExitCode show(const ViewSubject& subject, const ViewOptions& options, const Player& player) {
  catch_interrupts();
  const ResolvedEpisode& resolved = subject.resolved;
  const bool still = !options.screenshot.empty();
  if (options.map && !vantage::window(resolved).map) {
    log_warning(
        fmt::format("--map: an episode of {} makes no map of the room, only of what the "
                    "object is: there are no cells to show",
                    strategy_name_of(resolved.task)));
  }
  std::optional<Window> window;
  if (!still) window.emplace(subject.title, options.size);
  World world(model_source(resolved), resolved.setup.options.simulation);
  add_outside_effects(resolved, world);
  const ExitCode code = look(window, world, subject, options, player);
  return still && code == ExitCode::interrupted ? ExitCode::done : code;
}

}  // namespace vantage
