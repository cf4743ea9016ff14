#include "src/episode/recognition_model_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "src/core/data_root.hpp"
#include "src/core/error.hpp"

namespace vantage {

std::filesystem::path find_recognition_model(const std::string& model, const char* key) {
  try {
    return find_input(model, {}, key);
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("{}; make one: vantage dataset render out/objects, then vantage "
                    "train out/objects --out {} --set 'videos=[1, 2, 4]'",
                    error.what(), model.empty() ? "out/recognition.model" : model));
  }
}

void require_known(const Recogniser& recogniser, const std::filesystem::path& path,
                   const std::string& object, const char* role, const char* task) {
  const auto& known = recogniser.states.objects;
  if (object.empty() || std::ranges::find(known, object) != known.end()) return;
  throw ConfigError(
      fmt::format("{0}.model: {1}: knows {2} objects, but not '{3}', which {4}; {0}.database is "
                  "not what it was trained on",
                  task, path.string(), known.size(), object, role));
}

}  // namespace vantage
