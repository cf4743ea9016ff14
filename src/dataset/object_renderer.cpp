#include "vantage/dataset/object_renderer.hpp"

#include <fmt/format.h>

#include <numbers>
#include <utility>

#include "vantage/core/atomic_file.hpp"
#include "vantage/dataset/sensing.hpp"
#include "vantage/dataset/turntable.hpp"
#include "vantage/dataset/view_files.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

fs::path unfinished_folder(const fs::path& root, const ObjectName& name) {
  return root / name.category / fmt::format(".{}.part", name.object);
}

void rename_folder(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error) {
    throw OutputError(fmt::format("{}: cannot write: {}", to.string(), error.message()));
  }
}

Rng random_of_video(const DatasetOptions& options, const ObjectName& name, int video) {
  const std::string stream = fmt::format("{}/{}", name.object, video);
  return Rng::stream(options.seed, options.session == 1
                                       ? stream
                                       : fmt::format("{}/session {}", stream, options.session));
}

/// One video of one object, into `folder`.
struct VideoRendering {
  const DatasetOptions& options;
  const ObjectName& name;
  int video;
  const fs::path& folder;
  const std::function<bool()>& stop;

  /// @return the number of views; nothing if it was stopped
  std::optional<int> operator()(const TurntableObject& object,
                                const std::shared_ptr<OffscreenContext>& context) const {
    Rng rng = random_of_video(options, name, video);
    const Session session = draw_session(options, *video_elevation_rad(video), rng);
    Turntable turntable(object, session, options, name.object, context);
    RenderedImages drawn;
    int views = 0;
    for (int i = 0; i < options.frames(); ++i) {
      if (stop()) return std::nullopt;
      const double yaw_rad =
          session.first_yaw_rad + i * options.step_deg * std::numbers::pi / 180.0;
      turntable.draw(yaw_rad, drawn);
      const ObjectView view = sense(drawn, turntable.object_geom(), session, options, rng);
      if (view.width_px == 0 && options.cut_by_depth) continue;  // too flat for so far away
      if (view.width_px == 0) throw InputError(fmt::format("{}: cannot be seen", name.object));
      write_view(view, {{name.category, name.object, video, i + 1}, folder, yaw_rad});
      ++views;
    }
    return views;
  }
};

}  // namespace

fs::path object_folder(const fs::path& root, const ObjectName& name) {
  return root / name.category / name.object;
}

void remove_unfinished(const fs::path& root, const ObjectName& name) {
  const fs::path part = unfinished_folder(root, name);
  std::error_code error;
  fs::remove_all(part, error);
  if (error) {
    throw OutputError(fmt::format("{}: cannot remove: {}", part.string(), error.message()));
  }
}

ObjectRenderer::ObjectRenderer(const DatasetOptions& options, fs::path root)
    : options_(options), root_(std::move(root)), context_(make_offscreen_context()) {}

std::optional<int> ObjectRenderer::render(const ObjectName& name,
                                          const std::function<bool()>& stop) {
  const fs::path part = unfinished_folder(root_, name);
  remove_unfinished(root_, name);
  const TurntableObject object = make_turntable_object(options_, name);
  make_writable_directory(part);
  int views = 0;
  try {
    for (const int video : options_.videos) {
      const auto rendered = VideoRendering{options_, name, video, part, stop}(object, context_);
      if (!rendered) {
        remove_unfinished(root_, name);
        return std::nullopt;
      }
      views += *rendered;
    }
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(part, ignored);
    throw;
  }
  rename_folder(part, object_folder(root_, name));
  return views;
}

}  // namespace vantage
