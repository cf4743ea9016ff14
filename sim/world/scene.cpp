#include "vantage/sim/world/scene.hpp"

#include <fmt/format.h>
#include <mujoco/mujoco.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <mutex>
#include <string_view>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/sim/world/model_check.hpp"
#include "vantage/sim/world/mujoco_errors.hpp"

namespace vantage {
namespace {

/// An empty file that goes away again.
class TemporaryFile {
 public:
  TemporaryFile() {
    std::string name = (temporary_place() / "vantage-XXXXXX").string();
    const int descriptor = mkstemp(name.data());
    if (descriptor < 0) {
      throw OutputError(
          fmt::format("{}: cannot make a temporary file: {}", name, std::strerror(errno)));
    }
    close(descriptor);
    path_ = name;
  }
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Files in memory; 2 MB, so always on the heap.
struct VfsDeleter {
  void operator()(mjVFS* vfs) const {
    mj_deleteVFS(vfs);
    delete vfs;
  }
};
using VfsPtr = std::unique_ptr<mjVFS, VfsDeleter>;

void add_file(mjVFS& vfs, const char* name, std::string_view content) {
  const int failed = mj_makeEmptyFileVFS(&vfs, name, static_cast<int>(content.size()));
  expects(failed == 0, "a file of its own name fits into the virtual file system");
  const int index = mj_findFileVFS(&vfs, name);
  std::memcpy(vfs.filedata[index], content.data(), content.size());
}

VfsPtr make_vfs(std::span<const MemoryFile> files) {
  VfsPtr vfs(new mjVFS);
  mj_defaultVFS(vfs.get());
  for (const MemoryFile& file : files) add_file(*vfs, file.name.c_str(), file.content);
  return vfs;
}

/// MuJoCo remembers the model it read last in a global.
std::mutex one_at_a_time;

std::string one_line(std::string text) {
  text.erase(text.find_last_not_of(" \n\r\t") + 1);
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) {
    text.replace(at, 1, ", ");
  }
  return text;
}

/// Compiles `path` (looked up in `vfs` first, if given); `file` stands for it in messages.
ModelPtr compile(const std::filesystem::path& path, const mjVFS* vfs, const std::string& file,
                 std::vector<std::string>& warnings) {
  std::array<char, 1000> message{};
  ModelPtr model;
  const std::size_t before = warnings.size();
  try {
    const WarningCollector collector(warnings);
    model.reset(mj_loadXML(path.c_str(), vfs, message.data(), static_cast<int>(message.size())));
  } catch (const MujocoError& error) {
    throw InputError(fmt::format("{}: {}", file, one_line(error.what())));
  }
  std::string text = one_line(message.data());
  if (!model) throw InputError(fmt::format("{}: {}", file, text));
  if (!text.empty()) warnings.push_back(std::move(text));
  check_model(*model, file);
  for (std::size_t i = before; i < warnings.size(); ++i) {
    if (warnings[i].find("NaN") != std::string::npos ||
        warnings[i].find("Nan,") != std::string::npos) {
      throw InputError(fmt::format("{}: {}", file, warnings[i]));
    }
    warnings[i] = fmt::format("{}: {}", file, warnings[i]);
  }
  return model;
}

constexpr auto kMain = "vantage_main.xml";

/// A main file of these parts.
std::string including(std::initializer_list<std::string_view> files, std::string_view size) {
  std::string text = "<mujoco>\n";
  for (const std::string_view file : files) text += fmt::format("<include file=\"{}\"/>\n", file);
  return text + fmt::format("<size {}/>\n</mujoco>\n", size);
}

/// MuJoCo's own choice is too small for thousands of bodies, each against each; memory that is not
/// touched costs nothing.
constexpr std::string_view kLargeStack = " nstack=\"16000000\"";

/// Calls `compile_sized` with no wish for the stack's size and, if that is too small, with a large
/// one.
ModelPtr with_stack(auto&& compile_sized) {
  try {
    return compile_sized(std::string_view());
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find("Stack overflow") == std::string_view::npos) throw;
  }
  return compile_sized(kLargeStack);
}

ModelPtr compile_file(const std::filesystem::path& path, std::span<const MemoryFile> files,
                      std::vector<std::string>& warnings) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    throw InputError(fmt::format("{}: no such file", path.string()));
  }
  return with_stack([&](std::string_view stack) {
    if (files.empty() && stack.empty()) return compile(path, nullptr, path.string(), warnings);
    const VfsPtr vfs = make_vfs(files);
    if (stack.empty()) return compile(path, vfs.get(), path.string(), warnings);
    add_file(*vfs, kMain, including({path.filename().string()}, stack));
    return compile(path.parent_path() / kMain, vfs.get(), path.string(), warnings);
  });
}

/// Erases the first `begin` up to and with the next `end`, if there are such.
void erase_between(std::string& text, std::string_view begin, std::string_view end) {
  const std::size_t first = text.find(begin);
  if (first == std::string::npos) return;
  const std::size_t last = text.find(end, first + begin.size());
  if (last != std::string::npos) text.erase(first, last + end.size() - first);
}

/// The scene that was compiled last, as MuJoCo writes it: includes expanded, angles in radians, one
/// compiler section. Keyframes are left out: they would be too short beside a robot.
std::string canonical_text(const mjModel& scene) {
  const TemporaryFile file;
  std::array<char, 1000> message{};
  if (mj_saveLastXML(file.path().c_str(), &scene, message.data(),
                     static_cast<int>(message.size())) == 0) {
    throw OutputError(fmt::format("{}: {}", file.path().string(), one_line(message.data())));
  }
  std::string text = read_file(file.path());
  if (text.find("</mujoco>") == std::string::npos) {  // MuJoCo does not notice a full disk
    throw OutputError(fmt::format("{}: cannot write: cut short, is the disk full?",
                                  file.path().parent_path().string()));
  }
  erase_between(text, "<keyframe>", "</keyframe>");
  erase_between(text, " nkey=\"", "\"");
  return text;
}

/// A file name in the virtual file system wins over every folder, so the main file can claim to lie
/// beside the user's scene, where its meshes and textures are looked for.
ModelPtr compile_both(const ModelSource& source, const std::string& scene_text,
                      const mjModel& scene, const mjModel& robot,
                      std::vector<std::string>& warnings) {
  constexpr auto kScene = "vantage_scene.xml";
  constexpr auto kRobot = "vantage_robot.xml";
  const std::string sizes = fmt::format("njmax=\"{}\" nconmax=\"{}\"", scene.njmax + robot.njmax,
                                        scene.nconmax + robot.nconmax);
  ModelPtr both = with_stack([&](std::string_view stack) {
    const VfsPtr vfs = make_vfs(source.files);
    add_file(*vfs, kScene, scene_text);
    add_file(*vfs, kRobot, read_file(source.robot));
    add_file(*vfs, kMain, including({kScene, kRobot}, sizes + std::string(stack)));
    return compile(source.scene.parent_path() / kMain, vfs.get(),
                   source.scene.string() + " with " + source.robot.string(), warnings);
  });
  check_same_scene(scene, *both, source.scene.string());
  return both;
}

}  // namespace

void ModelDeleter::operator()(mjModel* model) const { mj_deleteModel(model); }

LoadedModel load_model(const ModelSource& source) {
  const std::lock_guard lock(one_at_a_time);
  install_mujoco_handlers();

  LoadedModel loaded;
  loaded.model = compile_file(source.scene, source.files, loaded.warnings);
  if (source.robot.empty()) return loaded;

  const std::string file = source.scene.string();
  check_no_robot_names(*loaded.model, file);
  const std::string scene_text = canonical_text(*loaded.model);
  std::vector<std::string> repeated;  // what compiling each for itself has already said
  const ModelPtr robot = compile_file(source.robot, {}, loaded.warnings);
  check_no_files(read_file(source.robot), source.robot.string());
  loaded.model = compile_both(source, scene_text, *loaded.model, *robot, repeated);
  return loaded;
}

LoadedModel load_model(std::string_view mjcf, std::span<const MemoryFile> files,
                       const std::string& name) {
  const std::lock_guard lock(one_at_a_time);
  install_mujoco_handlers();
  const VfsPtr vfs = make_vfs(files);
  add_file(*vfs, kMain, mjcf);
  LoadedModel loaded;
  loaded.model = compile(kMain, vfs.get(), name, loaded.warnings);
  return loaded;
}

}  // namespace vantage
