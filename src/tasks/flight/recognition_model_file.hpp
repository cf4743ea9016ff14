/// The file of the model that a flying task recognises with.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vantage/recognition/recogniser.hpp"
#include "vantage/runtime/episode_run.hpp"
#include "vantage/tasks/flight/object_database_options.hpp"

namespace vantage {

/// The name to keep in a configuration, found from `base`. A model that is not there yet keeps the
/// name it has: it is missed where it is needed, and to replay an episode it is not.
std::string found_model_name(const std::string& model, const std::filesystem::path& base);

/// What an episode reads beside its scene: the model, and the files of the scanned objects that
/// there may be.
std::vector<InputFile> flight_inputs(const std::string& model,
                                     const ObjectDatabaseOptions& database);

/// @throws InputError if there is none, with the command that makes one.
std::filesystem::path find_recognition_model(const std::string& model);

/// Reads it as flights do. @throws InputError if it is damaged
void check_recognition_model(const std::filesystem::path& file);

/// @param role of the object, "stands on the table"
/// @throws ConfigError if the recogniser, read from `path`, does not know the object.
void require_known(const Recogniser& recogniser, const std::filesystem::path& path,
                   const std::string& object, const char* role);

/// The same for an object that may be called unknown, if the recogniser has that hypothesis: then
/// it is only told that this is the right answer.
void require_answer(const Recogniser& recogniser, const std::filesystem::path& path,
                    const std::string& object, const char* role);

}  // namespace vantage
