/// Renders the views of one object after the other.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "vantage/dataset/object_source.hpp"
#include "vantage/sim/render/renderer.hpp"

namespace vantage {

/// Of a dataset, in one OpenGL context. Use it from the thread that made it, and have no other
/// renderer in another thread of the process: OSMesa dies of that now and then.
class ObjectRenderer {
 public:
  /// @throws RendererError
  ObjectRenderer(const DatasetOptions& options, std::filesystem::path root);

  /// Renders into a folder beside <root>/<category>/<object> and renames it when all is there.
  /// @param stop asked before each view
  /// @return number of views; nothing if it was stopped
  /// @throws InputError as make_turntable_object and Turntable, OutputError, RendererError
  std::optional<int> render(const ObjectName& name, const std::function<bool()>& stop);

 private:
  DatasetOptions options_;
  std::filesystem::path root_;
  std::shared_ptr<OffscreenContext> context_;
};

/// Where an object's views are: complete, or not there.
std::filesystem::path object_folder(const std::filesystem::path& root, const ObjectName& name);
/// Removes what was begun of an object and not finished.
void remove_unfinished(const std::filesystem::path& root, const ObjectName& name);

}  // namespace vantage
