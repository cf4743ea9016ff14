#include "vantage/sim/render/window.hpp"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

[[noreturn]] void fail(const std::string& what) {
  const char* why = nullptr;
  glfwGetError(&why);
  throw RendererError(what + (why == nullptr ? "" : std::string(": ") + why));
}

/// GLFW as long as there is a window.
struct Library {
  Library() {
    if (glfwInit() == GLFW_FALSE) fail("no display");
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  ~Library() { glfwTerminate(); }
};

template <class Function>
void look_up(Function& function, const char* name) {
  function = reinterpret_cast<Function>(glfwGetProcAddress(name));
  if (function == nullptr) fail(std::string("no OpenGL function ") + name);
}

/// From the display's OpenGL: the functions linked under these names are OSMesa's.
struct OpenGl {
  decltype(&glGetString) get_string = nullptr;
  decltype(&glViewport) viewport = nullptr;
  decltype(&glPixelStorei) pixel_store = nullptr;
  decltype(&glPixelZoom) pixel_zoom = nullptr;
  decltype(&glRasterPos2f) raster_position = nullptr;
  decltype(&glDrawPixels) draw_pixels = nullptr;
  decltype(&glReadBuffer) read_buffer = nullptr;
  decltype(&glReadPixels) read_pixels = nullptr;

  void look_up_all() {
    look_up(get_string, "glGetString");
    look_up(viewport, "glViewport");
    look_up(pixel_store, "glPixelStorei");
    look_up(pixel_zoom, "glPixelZoom");
    look_up(raster_position, "glRasterPos2f");
    look_up(draw_pixels, "glDrawPixels");
    look_up(read_buffer, "glReadBuffer");
    look_up(read_pixels, "glReadPixels");
    pixel_store(GL_UNPACK_ALIGNMENT, 1);
    pixel_store(GL_PACK_ALIGNMENT, 1);
  }
};

constexpr std::array<std::pair<int, char>, 9> kKeys{{{GLFW_KEY_ESCAPE, keys::escape},
                                                     {GLFW_KEY_LEFT, keys::left},
                                                     {GLFW_KEY_RIGHT, keys::right},
                                                     {GLFW_KEY_UP, keys::up},
                                                     {GLFW_KEY_DOWN, keys::down},
                                                     {GLFW_KEY_PAGE_UP, keys::page_up},
                                                     {GLFW_KEY_PAGE_DOWN, keys::page_down},
                                                     {GLFW_KEY_HOME, keys::home},
                                                     {GLFW_KEY_END, keys::end}}};

constexpr std::array<std::pair<int, MouseButton>, 3> kButtons{
    {{GLFW_MOUSE_BUTTON_LEFT, MouseButton::left},
     {GLFW_MOUSE_BUTTON_RIGHT, MouseButton::right},
     {GLFW_MOUSE_BUTTON_MIDDLE, MouseButton::middle}}};

template <class Table>
auto find_in(const Table& table, int code) -> std::optional<decltype(table[0].second)> {
  const auto found = std::ranges::find(table, code, [](const auto& entry) { return entry.first; });
  if (found == table.end()) return std::nullopt;
  return found->second;
}

PixelSize framebuffer_size(GLFWwindow* window) {
  PixelSize size;
  glfwGetFramebufferSize(window, &size.width_px, &size.height_px);
  return {std::max(size.width_px, 1), std::max(size.height_px, 1)};
}

}  // namespace

struct Window::Handle {
  Library library;
  GLFWwindow* window = nullptr;
  OpenGl gl;
  std::vector<WindowEvent> events;
  Eigen::Vector2d cursor_px = Eigen::Vector2d::Zero();

  static Handle& of(GLFWwindow* window) {
    return *static_cast<Handle*>(glfwGetWindowUserPointer(window));
  }
  void open(const std::string& title, PixelSize size);
  void listen();
  void key(int code) {
    if (const auto key = find_in(kKeys, code)) events.emplace_back(KeyPressed{*key});
  }
  void move_cursor(double x, double y);
};

void Window::Handle::move_cursor(double x, double y) {
  int width = 1;
  int height = 1;
  glfwGetWindowSize(window, &width, &height);
  const PixelSize size = framebuffer_size(window);
  const Eigen::Vector2d at_px(x * size.width_px / std::max(width, 1),
                              y * size.height_px / std::max(height, 1));
  for (const auto& [code, button] : kButtons) {
    if (glfwGetMouseButton(window, code) != GLFW_PRESS) continue;
    events.emplace_back(MouseDragged{button, at_px, at_px - cursor_px});
    break;
  }
  cursor_px = at_px;
}

void Window::Handle::listen() {
  glfwSetWindowUserPointer(window, this);
  glfwSetKeyCallback(window, [](GLFWwindow* w, int code, int, int action, int) {
    if (action != GLFW_RELEASE) of(w).key(code);
  });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned int code) {
    if (code < 128) of(w).events.emplace_back(KeyPressed{static_cast<char>(code)});
  });
  glfwSetCursorPosCallback(window,
                           [](GLFWwindow* w, double x, double y) { of(w).move_cursor(x, y); });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int code, int action, int) {
    const auto button = find_in(kButtons, code);
    if (button && action == GLFW_PRESS) {
      of(w).events.emplace_back(MousePressed{*button, of(w).cursor_px});
    }
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double notches) {
    of(w).events.emplace_back(WheelTurned{notches});
  });
}

void Window::Handle::open(const std::string& title, PixelSize size) {
  window = glfwCreateWindow(size.width_px, size.height_px, title.c_str(), nullptr, nullptr);
  if (window == nullptr) fail("no OpenGL on this display");
  glfwMakeContextCurrent(window);
  gl.look_up_all();
}

Window::Window(const std::string& title, PixelSize size) : handle_(std::make_unique<Handle>()) {
  handle_->open(title, size);
  glfwSwapInterval(1);
  handle_->listen();
}

Window::~Window() = default;

PixelSize Window::size() const { return framebuffer_size(handle_->window); }

bool Window::closed() const { return glfwWindowShouldClose(handle_->window) != 0; }

std::vector<WindowEvent> Window::wait(double timeout_s) {
  glfwWaitEventsTimeout(timeout_s);
  return std::exchange(handle_->events, {});
}

void Window::draw(const RenderedImages& image) {
  expects(!image.rgb.empty(), "an image with colours");
  const OpenGl& gl = handle_->gl;
  const PixelSize shown = size();
  gl.viewport(0, 0, shown.width_px, shown.height_px);
  gl.raster_position(-1.0F, 1.0F);
  gl.pixel_zoom(static_cast<float>(shown.width_px) / static_cast<float>(image.width_px),
                -static_cast<float>(shown.height_px) / static_cast<float>(image.height_px));
  gl.draw_pixels(image.width_px, image.height_px, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
}

void Window::show(const RenderedImages& image) {
  draw(image);
  glfwSwapBuffers(handle_->window);
}

RenderedImages Window::show_and_read(const RenderedImages& image) {
  draw(image);
  const PixelSize shown = size();
  RenderedImages held;
  held.width_px = shown.width_px;
  held.height_px = shown.height_px;
  const auto row_bytes = 3 * static_cast<std::size_t>(shown.width_px);
  held.rgb.resize(row_bytes * static_cast<std::size_t>(shown.height_px));
  handle_->gl.read_buffer(GL_BACK);
  for (int row = 0; row < shown.height_px; ++row) {  // OpenGL's bottom row comes first
    handle_->gl.read_pixels(0, shown.height_px - 1 - row, shown.width_px, 1, GL_RGB,
                            GL_UNSIGNED_BYTE,
                            held.rgb.data() + row_bytes * static_cast<std::size_t>(row));
  }
  glfwSwapBuffers(handle_->window);
  return held;
}

std::string Window::display_renderer_name() {
  Handle hidden;
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  hidden.open("", {16, 16});
  const auto text = [&](GLenum name) {
    return std::string(reinterpret_cast<const char*>(hidden.gl.get_string(name)));
  };
  return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

}  // namespace vantage
