/// A window on the desktop: shows images that are drawn elsewhere and tells what was done in it.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "vantage/sim/render/renderer.hpp"

namespace vantage {

/// A character typed, or one of the keys below.
struct KeyPressed {
  char key = 0;
};
namespace keys {
inline constexpr char escape = 27;
inline constexpr char left = 1;
inline constexpr char right = 2;
inline constexpr char up = 3;
inline constexpr char down = 4;
inline constexpr char page_up = 5;
inline constexpr char page_down = 6;
inline constexpr char home = 7;
inline constexpr char end = 8;
}  // namespace keys

enum class MouseButton { left, right, middle };
/// Places are in px of the image, y down.
struct MousePressed {
  MouseButton button = MouseButton::left;
  Eigen::Vector2d at_px = Eigen::Vector2d::Zero();
};
struct MouseDragged {
  MouseButton button = MouseButton::left;
  Eigen::Vector2d at_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d by_px = Eigen::Vector2d::Zero();  ///< since the event before
};
struct WheelTurned {
  double notches = 0.0;  ///< > 0: away from the user
};
using WindowEvent = std::variant<KeyPressed, MousePressed, MouseDragged, WheelTurned>;

struct PixelSize {
  int width_px = 0;
  int height_px = 0;
  friend bool operator==(const PixelSize&, const PixelSize&) = default;
};

/// One at a time, in the main thread. Its OpenGL is the display's: nothing else may draw in that
/// thread.
class Window {
 public:
  /// @throws RendererError if there is no display, or no OpenGL on it.
  Window(const std::string& title, PixelSize size);
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
  ~Window();

  /// What draws on the display, as renderer_name() says it. @throws RendererError as a window does
  static std::string display_renderer_name();

  [[nodiscard]] PixelSize size() const;  ///< of the image that fills it
  [[nodiscard]] bool closed() const;     ///< the user asked for that
  /// What was done, in order, after at most `timeout_s` of waiting for it.
  std::vector<WindowEvent> wait(double timeout_s);
  /// Shows the colours of `image`, stretched if its size is not that of the window.
  void show(const RenderedImages& image);
  /// The same, and what the window then holds.
  RenderedImages show_and_read(const RenderedImages& image);

 private:
  void draw(const RenderedImages& image);
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

}  // namespace vantage
