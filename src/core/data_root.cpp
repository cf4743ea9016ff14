#include "vantage/core/data_root.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <utility>

#include "vantage/core/error.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

fs::path& told_root() {
  static fs::path root;
  return root;
}

}  // namespace

void set_data_root(fs::path root) { told_root() = std::move(root); }

fs::path data_root() {
  if (const char* set = std::getenv("VANTAGE_DATA"); set != nullptr && *set != '\0') return set;
  if (!told_root().empty()) return told_root();
  std::error_code error;
  const fs::path binary = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = binary.parent_path().parent_path() / "share" / "vantage";
  if (!error && fs::is_directory(installed / "models")) return installed;
  return VANTAGE_SOURCE_TREE;
}

fs::path find_input(const std::string& name, const fs::path& base, const std::string& key) {
  if (name.empty()) throw InputError(fmt::format("{}: no file named", key));
  std::error_code error;  // a name too long, or a folder closed to us: no such file either
  if (fs::path(name).is_absolute()) {
    if (fs::exists(name, error)) return name;
    throw InputError(fmt::format("{}: {}: no such file", key, name));
  }
  for (const fs::path& place : {base, fs::path("."), data_root()}) {
    const fs::path candidate = (place / name).lexically_normal();
    if (fs::exists(candidate, error)) return candidate;
  }
  throw InputError(fmt::format("{}: {}: no such file (looked in {}, the working directory and {})",
                               key, name, base.empty() ? "." : base.string(),
                               data_root().string()));
}

std::string lasting_name(const fs::path& found) {
  const fs::path absolute = fs::absolute(found).lexically_normal();
  const fs::path inside = absolute.lexically_relative(data_root());
  return inside.empty() || *inside.begin() == ".." ? absolute.string() : inside.string();
}

std::string scene_title(const std::string& scene) {
  const fs::path path(scene);
  if (path.extension() != ".xml") return scene;
  const std::string folder = path.parent_path().filename().string();
  return path.stem() == "scene" && !folder.empty() && folder != "." ? folder : path.stem().string();
}

}  // namespace vantage
