/// The file of the model that a flying task recognises with.
#pragma once

#include <filesystem>
#include <string>

#include "vantage/recognition/recogniser.hpp"

namespace vantage {

/// @param key of the episode that names it, for messages
/// @param task whose episode file tells how to make one
/// @throws InputError if there is none, naming that file.
std::filesystem::path find_recognition_model(const std::string& model, const char* key,
                                             const char* task);

/// @param task section of the episode that holds `model` and `database`
/// @param role of the object, "stands on the table"
/// @throws ConfigError if the recogniser, read from `path`, does not know the object.
void require_known(const Recogniser& recogniser, const std::filesystem::path& path,
                   const std::string& object, const char* role, const char* task);

}  // namespace vantage
