#include "vantage/sim/render/renderer.hpp"

#include <GL/osmesa.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

#include "vantage/core/error.hpp"
#include "vantage/sim/render/gl_scene.hpp"

namespace vantage {
namespace {

struct DestroyContext {
  void operator()(OSMesaContext context) const { OSMesaDestroyContext(context); }
};

}  // namespace

/// An OSMesa context with the memory it draws into.
class OffscreenContext {
 public:
  OffscreenContext() : context_(OSMesaCreateContextExt(OSMESA_RGBA, 24, 8, 0, nullptr)) {
    if (!context_) throw RendererError("OSMesa: no OpenGL context");
  }

  void make_current(int width_px, int height_px) {
    const auto pixels = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
    pixels_.resize(std::max(pixels_.size(), 4 * pixels));
    if (!OSMesaMakeCurrent(context_.get(), pixels_.data(), GL_UNSIGNED_BYTE, width_px, height_px)) {
      throw RendererError(fmt::format("OSMesa: context cannot be made current, {} x {} pixels",
                                      width_px, height_px));
    }
  }

 private:
  std::vector<unsigned char> pixels_;
  std::unique_ptr<std::remove_pointer_t<OSMesaContext>, DestroyContext> context_;
};

namespace {

/// MuJoCo takes OpenGL's entry points from the first of EGL, OSMesa, GLX whose lookup function it
/// finds in the process; EGL's would draw nowhere here.
void require_osmesa_first() {
  if (dlsym(RTLD_DEFAULT, "eglGetProcAddress") != nullptr) {
    throw RendererError(
        "libEGL is loaded into this process and would be used instead of OSMesa; "
        "run without it (LD_PRELOAD, plugins)");
  }
}

class OffscreenRenderer : public Renderer {
 public:
  OffscreenRenderer(const mjModel& model, int width_px, int height_px,
                    std::shared_ptr<OffscreenContext> context)
      : width_px_(width_px), height_px_(height_px), context_(std::move(context)) {
    context_->make_current(width_px, height_px);
    scene_ = std::make_unique<GlScene>(model);
  }
  ~OffscreenRenderer() override {
    context_->make_current(width_px_, height_px_);
    scene_.reset();
  }

  [[nodiscard]] int width_px() const override { return width_px_; }
  [[nodiscard]] int height_px() const override { return height_px_; }
  void render(const mjModel& model, const mjData& data, const CameraView& view,
              const RenderRequest& request, RenderedImages& out) override {
    expects(&model == &scene_->model(), "the model the renderer was made for");
    context_->make_current(width_px_, height_px_);
    scene_->render(data, view, request, width_px(), height_px(), out);
  }

 private:
  int width_px_;
  int height_px_;
  std::shared_ptr<OffscreenContext> context_;
  std::unique_ptr<GlScene> scene_;
};

}  // namespace

std::unique_ptr<Renderer> make_offscreen_renderer(const mjModel& model, int width_px,
                                                  int height_px) {
  return make_offscreen_renderer(model, width_px, height_px, make_offscreen_context());
}

std::shared_ptr<OffscreenContext> make_offscreen_context() {
  require_osmesa_first();
  return std::make_shared<OffscreenContext>();
}

std::unique_ptr<Renderer> make_offscreen_renderer(const mjModel& model, int width_px, int height_px,
                                                  std::shared_ptr<OffscreenContext> context) {
  expects(width_px > 0 && height_px > 0, "image size above 0");
  expects(context != nullptr, "a context to draw in");
  return std::make_unique<OffscreenRenderer>(model, width_px, height_px, std::move(context));
}

std::string renderer_name() {
  OffscreenContext context;
  context.make_current(16, 16);
  using GetString = const GLubyte* (*)(GLenum);
  const auto get_string = reinterpret_cast<GetString>(OSMesaGetProcAddress("glGetString"));
  if (get_string == nullptr) throw RendererError("OSMesa: no glGetString");
  const auto text = [&](GLenum name) {
    const GLubyte* value = get_string(name);
    return std::string(value != nullptr ? reinterpret_cast<const char*>(value) : "unknown");
  };
  return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

}  // namespace vantage
