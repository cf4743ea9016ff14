/// What `vantage recognise` tells.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <numbers>
#include <optional>

#include "vantage/perception/picture_notes.hpp"
#include "vantage/recognition/recognition.hpp"

namespace vantage {

inline constexpr double kDegree_rad = std::numbers::pi / 180.0;

/// Objects, categories, entropy, views, and where to look next.
/// @param notes of the model's pictures: names of views
/// @param top so many objects and categories
nlohmann::ordered_json recognition_json(const Recogniser& recogniser,
                                        const RecognitionOptions& options,
                                        const std::optional<PictureNotes>& notes,
                                        const Recognition& known, int top, Rng& rng);

/// The same for people.
void print_recognition(const nlohmann::ordered_json& result);

}  // namespace vantage
