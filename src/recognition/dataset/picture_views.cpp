#include "vantage/recognition/dataset/picture_views.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <variant>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/core/log.hpp"
#include "vantage/core/yaml.hpp"

namespace vantage {
namespace {

/// As a model keeps it.
struct ModelNotes {
  PictureNotes pictures;
  double variance_floor = 0.0;
  void fields(auto&& f) {
    f("pictures", pictures, "notes of the pictures it was trained on");
    f("variance_floor", variance_floor, "least variance, as a share of the mean pooled variance",
      at_least(0.0));
  }
};

ModelNotes model_notes(const RecognitionModel& model) {
  ModelNotes notes;
  read_into(parse_yaml(model.pictures, "the model's notes on pictures"), notes, {});
  return notes;
}

std::string recording_of(const ViewEntry& view) {
  const auto number = static_cast<std::size_t>(view.name.video);
  const auto& names = view.notes->recordings;
  return number >= 1 && number <= names.size() ? names[number - 1] : std::to_string(number);
}

/// Empty: it has no name.
std::string view_name_of(const ViewEntry& view) {
  const PictureNotes& notes = *view.notes;
  if (notes.views.empty()) return {};
  return notes.views[static_cast<std::size_t>(yaw_bin(view.yaw_rad, notes.bins))];
}

ObjectCut cut_in(const std::optional<PictureNotes>& notes) {
  return notes ? object_cut_of(notes->cut, "cut") : ObjectCut::mask;
}

}  // namespace

std::vector<ViewEntry> chosen_views(const DatasetIndex& dataset, std::span<const int> videos,
                                    std::span<const std::string> recordings) {
  std::vector<ViewEntry> views;
  std::set<std::string> known;
  for (const ViewEntry& view : dataset.views) {
    const bool imported = view.notes != nullptr;
    if (imported) known.insert(recording_of(view));
    const bool chosen =
        imported ? recordings.empty() ||
                       std::ranges::find(recordings, recording_of(view)) != recordings.end()
                 : std::ranges::find(videos, view.name.video) != videos.end();
    if (chosen) views.push_back(view);
  }
  if (!views.empty()) return views;
  if (known.empty())
    throw InputError(fmt::format("the dataset has no views of video {}", fmt::join(videos, ", ")));
  throw InputError(fmt::format("recordings: the dataset has none of {}; known: {}",
                               fmt::join(recordings, ", "), fmt::join(known, ", ")));
}

std::optional<PictureNotes> common_notes(std::span<const ViewEntry> views, int bins) {
  std::optional<PictureNotes> common;
  for (const ViewEntry& view : views) {
    if (view.mask_from() != views.front().mask_from()) {
      throw InputError(fmt::format(
          "{} was cut by {} and {} by {}: what is trained on together must be cut alike; import "
          "both with the same --cut",
          views.front().folder.string(), to_string(views.front().mask_from()), view.folder.string(),
          to_string(view.mask_from())));
    }
    if (!view.notes) continue;
    if (!common || view.notes->bins > common->bins) common = *view.notes;
  }
  if (!common || bins == 0 || bins == common->bins) return common;
  if (!common->degrees) {
    throw ConfigError(fmt::format("bins: {} views that are told by name need as many, not {}",
                                  common->bins, bins));
  }
  common->bins = bins;
  common->views.clear();
  return common;
}

std::string named_views(const PictureNotes& notes) {
  std::vector<std::string> names = notes.views;
  std::erase(names, "");
  return fmt::format("{}", fmt::join(names, ", "));
}

std::optional<PictureNotes> notes_of(const RecognitionModel& model) {
  if (model.pictures.empty()) return std::nullopt;
  return model_notes(model).pictures;
}

void keep_notes(const PictureNotes& notes, double variance_floor, RecognitionModel& model) {
  model.pictures =
      to_yaml(write_node(ModelNotes{.pictures = notes, .variance_floor = variance_floor}));
}

VarianceEstimate floored(const RecognitionModel& model, const VarianceEstimate& variance) {
  if (model.pictures.empty()) return variance;
  const double floor = model_notes(model).variance_floor;
  VarianceEstimate raised = variance;
  if (auto* shrunk = std::get_if<ShrunkVariance>(&raised)) {
    shrunk->floor = std::max(shrunk->floor, floor);
  }
  return raised;
}

ObjectCut cut_of(const RecognitionModel& model) { return cut_in(notes_of(model)); }

std::vector<int> unseen_states(const RecognitionModel& model) {
  std::vector<int> unseen;
  if (model.pictures.empty()) return unseen;
  for (int state = 0; state < model.states.size(); ++state) {
    const bool seen = std::ranges::any_of(model.features, [&](const FeatureModel& feature) {
      return feature.statistics.count[static_cast<std::size_t>(state)] > 0;
    });
    if (!seen) unseen.push_back(state);
  }
  return unseen;
}

void fit_to(const std::optional<PictureNotes>& notes, std::vector<ViewEntry>& views) {
  const ObjectCut cut = cut_in(notes);
  std::size_t without_mask = 0;
  for (ViewEntry& view : views) {
    if (cut == ObjectCut::mask) {
      without_mask += view.mask_from() == ObjectCut::mask ? 0 : 1;
    } else {
      view.cut = cut;
    }
    if (!notes || !view.notes || (notes->degrees && view.notes->degrees)) continue;
    const std::string name = view_name_of(view);
    const auto bin = bin_of_view(*notes, name);
    if (!bin) {
      throw InputError(fmt::format("{}: is a view '{}', which the model does not know; known: {}",
                                   view.file("crop.png").string(), name, named_views(*notes)));
    }
    view.yaw_rad = *bin * 2.0 * std::numbers::pi / notes->bins;
  }
  if (without_mask > 0) {
    log_warning(fmt::format(
        "the model learnt from pictures with masks, {} of {} here are cut by {}: it will be wrong "
        "more often; train it on pictures that are cut alike (vantage dataset import --cut depth)",
        without_mask, views.size(), to_string(views.front().mask_from())));
  }
}

std::size_t drop_copies(std::vector<ViewEntry>& views) {
  std::map<std::pair<std::string, std::uint64_t>, std::string> known;
  std::string example;
  const std::size_t copies = std::erase_if(views, [&](const ViewEntry& view) {
    const std::uint64_t hash = hash_bytes(read_file(view.file("depthcrop.png")),
                                          hash_bytes(read_file(view.file("crop.png"))));
    const std::string file = view.file("crop.png").string();
    const auto [first, added] = known.emplace(std::pair(view.name.object, hash), file);
    if (!added && example.empty()) example = fmt::format("{} is {}", file, first->second);
    return !added;
  });
  if (copies > 0) {
    log_warning(fmt::format("{} views are copies of others and count once: {}", copies, example));
  }
  return copies;
}

}  // namespace vantage
