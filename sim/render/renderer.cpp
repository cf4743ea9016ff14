#include "vantage/sim/render/renderer.hpp"

#include <GL/osmesa.h>
#include <dlfcn.h>

#include <type_traits>

#include "vantage/core/error.hpp"
#include "vantage/sim/render/gl_scene.hpp"

namespace vantage {
namespace {

struct DestroyContext {
  void operator()(OSMesaContext context) const { OSMesaDestroyContext(context); }
};

/// An OSMesa context with the memory it draws into.
class OsmesaContext {
 public:
  OsmesaContext(int width_px, int height_px)
      : width_px_(width_px),
        height_px_(height_px),
        pixels_(4 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)),
        context_(OSMesaCreateContextExt(OSMESA_RGBA, 24, 8, 0, nullptr)) {
    if (!context_) throw RendererError("OSMesa: no OpenGL context");
    make_current();
  }

  void make_current() {
    if (!OSMesaMakeCurrent(context_.get(), pixels_.data(), GL_UNSIGNED_BYTE, width_px_,
                           height_px_)) {
      throw RendererError("OSMesa: context cannot be made current, " + std::to_string(width_px_) +
                          " x " + std::to_string(height_px_) + " pixels");
    }
  }

  [[nodiscard]] int width_px() const { return width_px_; }
  [[nodiscard]] int height_px() const { return height_px_; }

 private:
  int width_px_;
  int height_px_;
  std::vector<unsigned char> pixels_;
  std::unique_ptr<std::remove_pointer_t<OSMesaContext>, DestroyContext> context_;
};

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
  OffscreenRenderer(const mjModel& model, int width_px, int height_px)
      : context_(width_px, height_px), scene_(std::make_unique<GlScene>(model)) {}
  ~OffscreenRenderer() override {
    context_.make_current();
    scene_.reset();
  }

  [[nodiscard]] int width_px() const override { return context_.width_px(); }
  [[nodiscard]] int height_px() const override { return context_.height_px(); }
  void render(const mjModel& model, const mjData& data, const CameraView& view,
              const RenderRequest& request, RenderedImages& out) override {
    expects(&model == &scene_->model(), "the model the renderer was made for");
    context_.make_current();
    scene_->render(data, view, request, width_px(), height_px(), out);
  }

 private:
  OsmesaContext context_;
  std::unique_ptr<GlScene> scene_;
};

}  // namespace

std::unique_ptr<Renderer> make_offscreen_renderer(const mjModel& model, int width_px,
                                                  int height_px) {
  expects(width_px > 0 && height_px > 0, "image size above 0");
  require_osmesa_first();
  return std::make_unique<OffscreenRenderer>(model, width_px, height_px);
}

std::string renderer_name() {
  OsmesaContext context(16, 16);
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
