/// Which views of a dataset are used, and how imported ones are made to fit a model.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "vantage/belief/objects/recognition_model.hpp"
#include "vantage/perception/dataset_index.hpp"

namespace vantage {

/// Of rendered datasets and the like those of the `videos`; of imported pictures those of the
/// `recordings`, all if that is empty.
/// @throws InputError if none is left, naming the recordings there are.
std::vector<ViewEntry> chosen_views(const DatasetIndex& dataset, std::span<const int> videos,
                                    std::span<const std::string> recordings);

/// Notes of imported views that are trained on together: those of the first one with most bins;
/// nothing if none is imported.
/// @param bins asked for; 0: as imported
/// @throws InputError if they were cut in different ways; ConfigError if views that are told by
/// name are asked for in other bins.
std::optional<PictureNotes> common_notes(std::span<const ViewEntry> views, int bins);

/// Names of viewing directions, of bins that have one: "front, left".
std::string named_views(const PictureNotes& notes);

/// That the model keeps of what it was trained on; nothing if that was not imported.
/// @throws InputError, ConfigError if they are damaged.
std::optional<PictureNotes> notes_of(const RecognitionModel& model);
/// @param variance_floor see floored(); 0: none was chosen
void keep_notes(const PictureNotes& notes, double variance_floor, RecognitionModel& model);

/// The estimate with the floor that was chosen when the model was trained, where that is higher: of
/// few pictures, variances of single dimensions are hardly known.
VarianceEstimate floored(const RecognitionModel& model, const VarianceEstimate& variance);

/// How the model's pictures were cut: `mask` if it has no notes.
ObjectCut cut_of(const RecognitionModel& model);

/// States that a model of imported pictures has no view of. Those were taken from certain sides: an
/// object is never seen from the others, and a guess of what it would look like fits everything a
/// little. None of other models.
std::vector<int> unseen_states(const RecognitionModel& model);

/// Views that are told by name get the place that `notes` have for it; all are to be cut as there.
/// What cannot be done is told in a warning: masks are not to be had from depth.
/// @throws InputError naming a view that the notes do not have.
void fit_to(const std::optional<PictureNotes>& notes, std::vector<ViewEntry>& views);

/// Takes out views whose files are the same as those of one before of the same object, with a
/// warning. @return how many
std::size_t drop_copies(std::vector<ViewEntry>& views);

}  // namespace vantage
