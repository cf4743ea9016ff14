#include "vantage/tasks/flight/recognition_model_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "vantage/core/data_root.hpp"
#include "vantage/core/error.hpp"

namespace vantage {

std::filesystem::path find_recognition_model(const std::string& model, const char* key,
                                             const char* task) {
  try {
    return find_input(model, {}, key);
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("{}; assets/episodes/{}.yaml says how to make one", error.what(), task));
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
