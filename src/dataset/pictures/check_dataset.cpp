#include "vantage/dataset/pictures/check_dataset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/core/log.hpp"
#include "vantage/perception/dataset_reader.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

constexpr double kManyHoles = 0.5;
constexpr double kLeastSize_m = 0.005;
constexpr double kGreatestSize_m = 1.5;
constexpr double kNearest_m = 0.15;
constexpr double kFarthest_m = 6.0;
constexpr int kFewPixels = 150;

double quantile_of(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

Spread spread_of(const std::vector<double>& values) {
  return {quantile_of(values, 0.0), quantile_of(values, 0.5), quantile_of(values, 1.0)};
}

/// What one view tells.
struct Measured {
  double holes = 0.0;
  double mask = 0.0;
  double distance_m = 0.0;
  double size_m = 0.0;
  int pixels = 0;
};

Measured measure(const ObjectView& view) {
  Measured measured;
  std::vector<double> depth, x, y;
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = 0; column < view.width_px; ++column) {
      const std::size_t i = view.index(row, column);
      if (view.mask[i] == 0) continue;
      ++measured.pixels;
      if (!(view.depth_m[i] > 0.0F)) continue;
      const Eigen::Vector3d p = view.point(row, column);
      x.push_back(p.x());
      y.push_back(p.y());
      depth.push_back(p.z());
    }
  }
  const auto pixels = static_cast<double>(measured.pixels);
  measured.holes = pixels > 0.0 ? 1.0 - static_cast<double>(depth.size()) / pixels : 1.0;
  measured.mask = pixels / static_cast<double>(view.mask.size());
  measured.distance_m = quantile_of(depth, 0.5);
  const auto extent = [](const std::vector<double>& values) {
    return quantile_of(values, 0.975) - quantile_of(values, 0.025);
  };
  measured.size_m = std::max(extent(x), extent(y));
  return measured;
}

std::uint64_t picture_hash(const ViewEntry& view) {
  return hash_bytes(read_file(view.file("depthcrop.png")),
                    hash_bytes(read_file(view.file("crop.png"))));
}

/// Says what is odd about a view.
void judge(const ViewEntry& view, const Measured& measured, CheckedDataset& checked) {
  const std::string file = view.file("depthcrop.png").string();
  if (measured.pixels < kFewPixels) {
    checked.advice.push_back(fmt::format("{}: the object has {} pixels; fewer than {} tell little",
                                         file, measured.pixels, kFewPixels));
  }
  if (measured.holes > kManyHoles) {
    checked.advice.push_back(
        fmt::format("{}: {:.0f} % of the object has no depth", file, 100.0 * measured.holes));
  }
  if (measured.distance_m > 0.0 &&
      (measured.distance_m < kNearest_m || measured.distance_m > kFarthest_m)) {
    checked.problems.push_back(fmt::format(
        "{}: the object is {:.3g} m away; is the depth in another unit? import with --depth-unit",
        file, measured.distance_m));
  } else if (measured.size_m > kGreatestSize_m ||
             (measured.distance_m > 0.0 && measured.size_m < kLeastSize_m)) {
    checked.problems.push_back(fmt::format(
        "{}: the object is {:.3g} m large; depth unit, --focal-px or the cut is not right", file,
        measured.size_m));
  }
}

void note_duplicate(const ViewEntry& view, std::map<std::uint64_t, ViewEntry>& known,
                    CheckedDataset& checked) {
  const std::uint64_t hash = picture_hash(view);
  checked.pictures.emplace(hash, view.file("crop.png"));
  const auto [other, first] = known.emplace(hash, view);
  if (first) return;
  const std::string what =
      fmt::format("{}: is the same picture as {}", view.file("crop.png").string(),
                  other->second.file("crop.png").string());
  if (other->second.name.object != view.name.object) {
    checked.problems.push_back(what + ", of another object");
  } else {
    checked.advice.push_back(what + "; copies count once in training");
  }
}

struct OfObject {
  std::vector<double> holes, size_m;
  std::set<std::pair<fs::path, int>> recordings;
  std::map<int, int> views_of_bin;
};

CheckedObject summary_of(const std::string& object, const OfObject& seen) {
  CheckedObject checked{.object = object,
                        .views = static_cast<int>(seen.holes.size()),
                        .recordings = static_cast<int>(seen.recordings.size()),
                        .bins = static_cast<int>(seen.views_of_bin.size()),
                        .thin_bins = 0,
                        .holes = quantile_of(seen.holes, 0.5),
                        .size_m = quantile_of(seen.size_m, 0.5)};
  for (const auto& [bin, views] : seen.views_of_bin) checked.thin_bins += views == 1 ? 1 : 0;
  return checked;
}

void advise_on_objects(CheckedDataset& checked) {
  int most = 0;
  std::vector<std::string> single, thin;
  for (const CheckedObject& object : checked.objects) most = std::max(most, object.bins);
  for (const CheckedObject& object : checked.objects) {
    if (object.views == 1) {
      checked.problems.push_back(
          fmt::format("{}: a single picture; take it from another side too", object.object));
    } else if (object.bins < most) {
      checked.advice.push_back(
          fmt::format("{}: pictures from {} of {} directions", object.object, object.bins, most));
    }
    if (object.recordings == 1) single.push_back(object.object);
    if (object.thin_bins > 0) thin.push_back(object.object);
  }
  if (!thin.empty()) {
    checked.advice.push_back(
        fmt::format("{} of {} objects have directions with one picture: their spread is taken from "
                    "the others; two recordings or more are better",
                    thin.size(), checked.objects.size()));
  }
  if (!single.empty() && single.size() == checked.objects.size()) {
    checked.advice.emplace_back(
        "one recording of every object: how far features are trusted is learnt within it, and in "
        "another room they may deserve less; record a second one in another room or light");
  }
}

}  // namespace

CheckedDataset check_dataset(const fs::path& root, int bins, const std::function<void()>& poll) {
  const DatasetIndex index = index_dataset(root, OnBadView::skip);
  CheckedDataset checked;
  checked.root = root;
  for (const SkippedView& skipped : index.skipped) checked.problems.push_back(skipped.reason);
  if (const auto& notes = index.views.front().notes) {
    checked.cut = object_cut_of(notes->cut, kPictureNotes);
    checked.bins = notes->bins;
    checked.focal_px = notes->focal_px;
  }
  if (bins > 0) checked.bins = bins;
  std::map<std::string, OfObject> objects;
  std::map<std::uint64_t, ViewEntry> known;
  std::vector<double> holes, mask, distance_m;
  Progress progress("checking", static_cast<double>(index.views.size()));
  for (const ViewEntry& entry : index.views) {
    poll();
    try {
      const Measured measured = measure(load_view(entry).view);
      judge(entry, measured, checked);
      note_duplicate(entry, known, checked);
      OfObject& object = objects[entry.name.object];
      object.holes.push_back(measured.holes);
      object.size_m.push_back(measured.size_m);
      object.recordings.emplace(entry.folder, entry.name.video);
      ++object.views_of_bin[yaw_bin(entry.yaw_rad, checked.bins)];
      holes.push_back(measured.holes);
      mask.push_back(measured.mask);
      distance_m.push_back(measured.distance_m);
    } catch (const InputError& error) {
      checked.problems.emplace_back(error.what());
    }
    progress.update(static_cast<double>(++checked.views));
  }
  for (const auto& [object, seen] : objects) checked.objects.push_back(summary_of(object, seen));
  checked.holes = spread_of(holes);
  checked.mask = spread_of(mask);
  checked.distance_m = spread_of(distance_m);
  advise_on_objects(checked);
  return checked;
}

}  // namespace vantage
