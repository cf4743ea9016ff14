#include "vantage/tasks/flight/recognition_model_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "vantage/core/data_root.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/log.hpp"
#include "vantage/dataset/object_source.hpp"
#include "vantage/recognition/lean_recogniser.hpp"

namespace vantage {

std::string found_model_name(const std::string& model, const std::filesystem::path& base) {
  if (model.empty()) return model;
  try {
    return lasting_name(find_input(model, base, "model"));
  } catch (const InputError&) {
    return model;
  }
}

std::vector<InputFile> flight_inputs(const std::string& model,
                                     const ObjectDatabaseOptions& database) {
  std::vector<InputFile> inputs{{"model", data_root() / model}};
  if (database.models.empty()) return inputs;
  DatasetOptions scanned;
  scanned.objects = database.objects;
  scanned.models = (data_root() / database.models).string();
  for (const std::filesystem::path& file : scanned_files(scanned)) {
    const auto name = file.lexically_relative(scanned.models);
    inputs.push_back({"database.models/" + name.generic_string(), file});
  }
  return inputs;
}

std::filesystem::path find_recognition_model(const std::string& model) {
  try {
    return find_input(model, {}, "model");
  } catch (const InputError& error) {
    throw InputError(fmt::format(
        "{}; `vantage train --recipe FILE.yaml --out {}` makes one, recipes are in assets/models",
        error.what(), model));
  }
}

void check_recognition_model(const std::filesystem::path& file) { load_lean_recogniser(file, {}); }

void require_known(const Recogniser& recogniser, const std::filesystem::path& path,
                   const std::string& object, const char* role) {
  const auto& known = recogniser.states.objects;
  if (object.empty() || std::ranges::find(known, object) != known.end()) return;
  throw ConfigError(fmt::format(
      "model: {}: knows {} objects, but not '{}', which {}; database is not what it was "
      "trained on",
      path.string(), known.size(), object, role));
}

void require_answer(const Recogniser& recogniser, const std::filesystem::path& path,
                    const std::string& object, const char* role) {
  if (recogniser.states.unknown_size() == 0) {
    require_known(recogniser, path, object, role);
    return;
  }
  const auto& known = recogniser.states.objects;
  if (object.empty() || std::ranges::find(known, object) != known.end()) return;
  log_warning(fmt::format("{}: does not know '{}', which {}: the right answer is '{}'",
                          path.string(), object, role, kUnknown));
}

}  // namespace vantage
