/// A recogniser for those who extract every feature of every view they get.
#pragma once

#include "src/recognition/recogniser.hpp"

namespace vantage {

/// As load_recogniser(), without the tables of divergences that the choice of features and views
/// asks for: seconds sooner with a large database. A choice works them out when asked.
Recogniser load_plain_recogniser(const std::filesystem::path& path,
                                 const RecogniserOptions& options);

}  // namespace vantage
