#include "vantage/dataset/pictures/dataset_differences.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vantage {
namespace {

using Difference = std::optional<DatasetDifference>;

Difference of_cuts(const CheckedDataset& training, const CheckedDataset& test) {
  if (training.cut == test.cut) return std::nullopt;
  const bool mendable = training.cut != ObjectCut::mask;
  const std::string mend =
      mendable ? fmt::format("evaluate and recognise cut by {} again", to_string(training.cut))
               : "import the first with --cut depth too and train on that";
  return DatasetDifference{
      fmt::format("the object is cut by {} in {} and by {} in {}: features of one do not fit "
                  "the other; {}",
                  to_string(training.cut), training.root.string(), to_string(test.cut),
                  test.root.string(), mend),
      !mendable};
}

Difference of_masks(const CheckedDataset& training, const CheckedDataset& test) {
  const double fuller = std::max(training.mask.median, test.mask.median);
  const double emptier = std::min(training.mask.median, test.mask.median);
  const bool both_masked = training.cut == test.cut && training.cut == ObjectCut::mask;
  if (!both_masked || fuller <= 1.5 * emptier) return std::nullopt;
  return DatasetDifference{
      fmt::format("masks fill {:.0f} % of a picture in {} and {:.0f} % in {}: they "
                  "may have been made in different ways",
                  100.0 * training.mask.median, training.root.string(), 100.0 * test.mask.median,
                  test.root.string())};
}

Difference of_holes(const CheckedDataset& training, const CheckedDataset& test) {
  if (std::abs(training.holes.median - test.holes.median) <= 0.15) return std::nullopt;
  return DatasetDifference{fmt::format("{:.0f} % of the object has no depth in {}, {:.0f} % in {}",
                                       100.0 * training.holes.median, training.root.string(),
                                       100.0 * test.holes.median, test.root.string())};
}

Difference of_cameras(const CheckedDataset& training, const CheckedDataset& test) {
  if (std::abs(training.focal_px - test.focal_px) <= 0.02 * training.focal_px) return std::nullopt;
  return DatasetDifference{
      fmt::format("the focal length is {} px in {} and {} px in {}; right only if the cameras "
                  "differ",
                  training.focal_px, training.root.string(), test.focal_px, test.root.string())};
}

const CheckedObject* object_named(const CheckedDataset& dataset, const std::string& name) {
  const auto found = std::ranges::find(dataset.objects, name, &CheckedObject::object);
  return found == dataset.objects.end() ? nullptr : &*found;
}

/// The objects of both are the same ones, so they are as large.
Difference of_sizes(const CheckedDataset& training, const CheckedDataset& test) {
  constexpr double kMostRatio = 1.5;
  std::vector<double> ratios;
  for (const CheckedObject& object : test.objects) {
    const CheckedObject* same = object_named(training, object.object);
    if (same != nullptr && same->size_m > 0.0 && object.size_m > 0.0) {
      ratios.push_back(object.size_m / same->size_m);
    }
  }
  if (ratios.empty()) return std::nullopt;
  std::ranges::sort(ratios);
  const double ratio = ratios[(ratios.size() - 1) / 2];
  if (std::max(ratio, 1.0 / ratio) <= kMostRatio) return std::nullopt;
  return DatasetDifference{
      fmt::format("objects are {:.2g} times as large in {} as in {}: depth unit, focal length or "
                  "the cut of one is not right",
                  ratio, test.root.string(), training.root.string()),
      true};
}

/// Of pictures there is to be none that both hold.
Difference of_pictures(const CheckedDataset& training, const CheckedDataset& test) {
  std::size_t shared = 0;
  std::string first;
  for (const auto& [hash, file] : test.pictures) {
    const auto same = training.pictures.find(hash);
    if (same == training.pictures.end()) continue;
    if (++shared == 1) first = fmt::format("{} is {}", file.string(), same->second.string());
  }
  if (shared == 0) return std::nullopt;
  return DatasetDifference{
      fmt::format("{} of {} pictures to test on are trained on ({}); take them out of one", shared,
                  test.pictures.size(), first),
      true};
}

Difference of_objects(const CheckedDataset& training, const CheckedDataset& test) {
  std::vector<std::string> unseen;
  for (const CheckedObject& object : test.objects) {
    if (object_named(training, object.object) == nullptr) unseen.push_back(object.object);
  }
  if (unseen.empty()) return std::nullopt;
  return DatasetDifference{fmt::format(
      "not trained on: {}; of these only the category can be right", fmt::join(unseen, ", "))};
}

}  // namespace

std::vector<DatasetDifference> differences(const CheckedDataset& training,
                                           const CheckedDataset& test) {
  std::vector<DatasetDifference> found;
  for (const auto difference :
       {of_cuts, of_masks, of_holes, of_cameras, of_sizes, of_pictures, of_objects}) {
    if (auto told = difference(training, test)) found.push_back(std::move(*told));
  }
  return found;
}

}  // namespace vantage
