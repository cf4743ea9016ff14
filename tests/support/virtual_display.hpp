/// An X display in memory, and a user at it.
#pragma once

#include <Eigen/Core>

#include <string>

namespace vantage::support {

/// Starts Xvfb on a display number that is free, and ends it. `DISPLAY` names it meanwhile.
class VirtualDisplay {
 public:
  /// @throws std::runtime_error if there is no Xvfb
  VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;
  ~VirtualDisplay();

  [[nodiscard]] const std::string& name() const { return name_; }  ///< ":7"

 private:
  int process_ = -1;
  std::string name_;
};

/// Sends a window what its user would do there. Waits until a window with that in its title is on
/// the display.
class DesktopUser {
 public:
  /// @throws std::runtime_error if it does not come within a minute
  DesktopUser(const VirtualDisplay& display, const std::string& title);
  DesktopUser(const DesktopUser&) = delete;
  DesktopUser& operator=(const DesktopUser&) = delete;
  ~DesktopUser();

  void press(const std::string& keysym);  ///< "space", "q", "Right"
  /// @param button 1 left, 2 middle, 3 right
  void drag(int button, const Eigen::Vector2i& from_px, const Eigen::Vector2i& to_px);
  void turn_wheel(bool away);
  void close();  ///< as by the button in the title bar

 private:
  void* display_ = nullptr;
  unsigned long window_ = 0;
};

}  // namespace vantage::support
