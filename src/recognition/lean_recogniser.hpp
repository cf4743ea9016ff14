/// A recogniser that is ready at once, for who recognises one object and ends.
#pragma once

#include <filesystem>

#include "vantage/recognition/recogniser.hpp"

namespace vantage {

/// As load_recogniser(), without tables of divergences: those of thousands of states take many
/// seconds. Whoever chooses works them out for the likely states, some milliseconds a choice.
Recogniser load_lean_recogniser(const std::filesystem::path& path,
                                const RecogniserOptions& options);

}  // namespace vantage
