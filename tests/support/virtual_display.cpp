#include "tests/support/virtual_display.hpp"

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>

namespace vantage::support {
namespace {

/// Xvfb writes the number of its display there once it answers.
std::string read_line(int pipe) {
  std::string line;
  for (char c = 0; ::read(pipe, &c, 1) == 1 && c != '\n';) line += c;
  return line;
}

/// Any window below `parent` with `title` in its name; 0 if there is none.
Window find_window(Display* display, Window parent, const std::string& title) {
  Window root = 0;
  Window above = 0;
  Window* children = nullptr;
  unsigned int count = 0;
  if (XQueryTree(display, parent, &root, &above, &children, &count) == 0) return 0;
  Window found = 0;
  for (unsigned int i = 0; i < count && found == 0; ++i) {
    char* name = nullptr;
    if (XFetchName(display, children[i], &name) != 0 && name != nullptr) {
      if (std::string(name).find(title) != std::string::npos) found = children[i];
      XFree(name);
    }
  }
  if (children != nullptr) XFree(children);
  return found;
}

/// Between two events of a user, so that a window sees them one by one.
void pause() { std::this_thread::sleep_for(std::chrono::milliseconds(40)); }

}  // namespace

VirtualDisplay::VirtualDisplay() {
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) throw std::runtime_error("no pipe");
  const std::string to = std::to_string(pipe[1]);
  process_ = ::fork();
  if (process_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // a test that crashes leaves no display behind
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDERR_FILENO);
    ::close(pipe[0]);
    ::execlp("Xvfb", "Xvfb", "-displayfd", to.c_str(), "-screen", "0", "1600x1200x24", "-nolisten",
             "tcp", nullptr);
    ::_exit(127);
  }
  ::close(pipe[1]);
  const std::string number = read_line(pipe[0]);
  ::close(pipe[0]);
  if (number.empty()) {
    ::waitpid(process_, nullptr, 0);
    throw std::runtime_error("Xvfb does not start: apt-get install xvfb");
  }
  name_ = ":" + number;
  ::setenv("DISPLAY", name_.c_str(), 1);
}

VirtualDisplay::~VirtualDisplay() {
  ::unsetenv("DISPLAY");
  ::kill(process_, SIGTERM);
  ::waitpid(process_, nullptr, 0);
}

DesktopUser::DesktopUser(const VirtualDisplay& display, const std::string& title) {
  Display* opened = XOpenDisplay(display.name().c_str());
  if (opened == nullptr) throw std::runtime_error("no display " + display.name());
  display_ = opened;
  for (int attempt = 0; attempt < 600 && window_ == 0; ++attempt) {
    window_ = find_window(opened, DefaultRootWindow(opened), title);
    if (window_ == 0) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  if (window_ != 0) return;
  XCloseDisplay(opened);
  throw std::runtime_error("no window called " + title);
}

DesktopUser::~DesktopUser() { XCloseDisplay(static_cast<Display*>(display_)); }

void DesktopUser::press(const std::string& keysym) {
  auto* display = static_cast<Display*>(display_);
  XEvent event{};
  event.xkey.display = display;
  event.xkey.window = window_;
  event.xkey.root = DefaultRootWindow(display);
  event.xkey.time = CurrentTime;
  event.xkey.same_screen = True;
  event.xkey.keycode = XKeysymToKeycode(display, XStringToKeysym(keysym.c_str()));
  event.type = KeyPress;
  XSendEvent(display, window_, True, KeyPressMask, &event);
  event.type = KeyRelease;
  XSendEvent(display, window_, True, KeyReleaseMask, &event);
  XSync(display, False);
  pause();
}

void DesktopUser::drag(int button, const Eigen::Vector2i& from_px, const Eigen::Vector2i& to_px) {
  auto* display = static_cast<Display*>(display_);
  const auto send = [&](int type, const Eigen::Vector2i& at_px) {
    XEvent event{};
    if (type == MotionNotify) {
      event.xmotion.x = at_px.x();
      event.xmotion.y = at_px.y();
    } else {
      event.xbutton.button = static_cast<unsigned int>(button);
      event.xbutton.x = at_px.x();
      event.xbutton.y = at_px.y();
    }
    event.xany.type = type;
    event.xany.display = display;
    event.xany.window = window_;
    XSendEvent(display, window_, True, NoEventMask, &event);
    XSync(display, False);
    pause();
  };
  send(MotionNotify, from_px);
  send(ButtonPress, from_px);
  send(MotionNotify, to_px);
  send(ButtonRelease, to_px);
}

void DesktopUser::turn_wheel(bool away) {
  auto* display = static_cast<Display*>(display_);
  XEvent event{};
  event.xbutton.type = ButtonPress;
  event.xbutton.display = display;
  event.xbutton.window = window_;
  event.xbutton.button = away ? Button4 : Button5;
  XSendEvent(display, window_, True, NoEventMask, &event);
  XSync(display, False);
  pause();
}

void DesktopUser::close() {
  auto* display = static_cast<Display*>(display_);
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.window = window_;
  event.xclient.message_type = XInternAtom(display, "WM_PROTOCOLS", False);
  event.xclient.format = 32;
  event.xclient.data.l[0] = static_cast<long>(XInternAtom(display, "WM_DELETE_WINDOW", False));
  XSendEvent(display, window_, False, NoEventMask, &event);
  XSync(display, False);
}

}  // namespace vantage::support
