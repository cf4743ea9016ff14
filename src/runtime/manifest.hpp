/// manifest.json: what ran, on what, with which inputs.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "vantage/runtime/episode_run.hpp"

namespace vantage {

/// The version control state of the build, "0.1.0 (abc1234)".
std::string version_text();

/// Its model, "unknown" if the system does not tell.
std::string cpu_name();

/// Hash of each file that the scene and the robot are made of, by its name beside them, or
/// "robot:name" of the robot's where the scene has another file of that name; and of each input
/// that is there, by its key.
std::map<std::string, std::string> asset_hashes(const EpisodeSetup& setup,
                                                const std::vector<InputFile>& inputs);

/// Of an episode that is about to begin. @throws InputError if a file cannot be read
InputHashes input_hashes(const EpisodeSetup& setup, const std::vector<InputFile>& inputs);

std::string manifest_json(const RunRequest& request, const RunSummary& summary);

}  // namespace vantage
