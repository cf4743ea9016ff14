#include "vantage/dataset/pictures/import_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <set>
#include <utility>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/log.hpp"
#include "vantage/core/parallel_for.hpp"
#include "vantage/dataset/pictures/import_cut.hpp"
#include "vantage/dataset/pictures/import_directions.hpp"
#include "vantage/dataset/pictures/imported_picture.hpp"
#include "vantage/dataset/pictures/replace_folder.hpp"
#include "vantage/dataset/view_files.hpp"
#include "vantage/perception/object_cut.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

using Item = ImportedPicture;

constexpr double kUsualElevation_deg = 45.0;
constexpr int kUsualWidth_px = 640;

/// The folder's name, and of several of that name the one that they lie in before it.
std::string recording_of(const fs::path& from, const std::vector<fs::path>& all) {
  const auto whole = [](const fs::path& path) { return fs::absolute(path / ".").parent_path(); };
  const fs::path own = whole(from);
  const auto same = std::ranges::count_if(
      all, [&](const fs::path& other) { return whole(other).filename() == own.filename(); });
  const std::string name = own.filename().string();
  return same > 1 ? own.parent_path().filename().string() + " " + name : name;
}

std::vector<Item> items_of(const ImportOptions& options, const ImportRun& run,
                           ImportOutcome& outcome) {
  std::vector<Item> items;
  for (const fs::path& from : run.from) {
    FoundPictures found = find_pictures(from, options.layout);
    outcome.layouts.push_back(found.layout);
    std::ranges::move(found.left_out, std::back_inserter(outcome.left_out));
    for (FoundPicture& picture : found.pictures) {
      if (run.from.size() > 1) {
        const std::string folder = recording_of(from, run.from);
        picture.recording = picture.recording.empty() ? folder : folder + " " + picture.recording;
      }
      items.emplace_back().picture = std::move(picture);
    }
  }
  return items;
}

/// Recordings by name, frames in order of path.
void number_views(const fs::path& root, std::vector<Item>& items, PictureNotes& notes) {
  std::set<std::string> names;
  for (const Item& item : items) names.insert(item.picture.recording);
  notes.recordings.assign(names.begin(), names.end());
  if (notes.recordings == std::vector<std::string>{""}) notes.recordings = {"pictures"};
  std::map<std::pair<std::string, int>, int> frames;
  for (Item& item : items) {
    const auto recording =
        static_cast<int>(std::distance(names.begin(), names.find(item.picture.recording))) + 1;
    const std::string& object = item.picture.object;
    item.entry.name = {.category = item.picture.category,
                       .object = object,
                       .video = recording,
                       .frame = ++frames[{object, recording}]};
    item.entry.folder = root / item.picture.category / object;
  }
}

ObjectCut chosen_cut(const ImportOptions& options, const std::vector<Item>& items,
                     ImportOutcome& outcome) {
  const auto masks =
      std::ranges::count_if(items, [](const Item& i) { return i.picture.mask.has_value(); });
  if (options.cut != "auto") {
    const ObjectCut cut = object_cut_of(options.cut, "--cut");
    const auto lacking = std::ranges::find_if(items, [](const Item& i) { return !i.picture.mask; });
    if (cut == ObjectCut::mask && lacking != items.end()) {
      throw InputError(fmt::format("{}: has no mask beside it; --cut depth does without",
                                   lacking->picture.colour.string()));
    }
    return cut;
  }
  if (masks == std::ssize(items)) return ObjectCut::mask;
  outcome.notices.push_back(
      masks == 0
          ? std::string("no masks: the object is cut out by depth; --cut whole takes all pixels")
          : fmt::format(
                "{} of {} pictures have a mask: all are cut out by depth, so that they are alike",
                masks, items.size()));
  return ObjectCut::depth;
}

void take_in_all(std::vector<Item>& items, const ImportOptions& options, const ImportRun& run,
                 const PictureNotes& notes) {
  for (const Item& item : items) make_writable_directory(item.entry.folder);
  Progress progress("importing", static_cast<double>(items.size()));
  std::mutex mutex;
  std::exception_ptr failure;
  std::size_t done = 0;
  parallel_for(items.size(), run.jobs, [&](std::size_t i) {
    {
      const std::lock_guard lock(mutex);
      if (failure) return;
    }
    try {
      run.poll();
      take_in(items[i], options, notes);
      const std::lock_guard lock(mutex);
      progress.update(static_cast<double>(++done));
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  });
  if (failure) std::rethrow_exception(failure);
}

/// Over the tables that the recording's pictures show, if most show one.
std::optional<double> median_elevation(const std::vector<Item>& items, int recording) {
  std::vector<double> measured;
  std::size_t all = 0;
  for (const Item& item : items) {
    if (item.entry.name.video != recording || item.elevation_deg) continue;
    ++all;
    if (item.measured_deg) measured.push_back(*item.measured_deg);
  }
  if (2 * measured.size() < all || measured.empty()) return std::nullopt;
  const auto middle = measured.begin() + static_cast<std::ptrdiff_t>(measured.size() / 2);
  std::ranges::nth_element(measured, middle);
  return *middle;
}

void write_poses(const ImportOptions& options, std::vector<Item>& items, ImportOutcome& outcome) {
  std::map<int, std::optional<double>> of_recording;
  int assumed = 0;
  for (Item& item : items) {
    const int recording = item.entry.name.video;
    if (!of_recording.contains(recording))
      of_recording[recording] = median_elevation(items, recording);
    std::optional<double> elevation_deg = item.elevation_deg;
    if (!elevation_deg) elevation_deg = options.elevation_deg;
    if (!elevation_deg) elevation_deg = of_recording[recording];
    if (!elevation_deg) ++assumed;
    item.entry.given_elevation_rad = elevation_deg.value_or(kUsualElevation_deg) * kDegree;
    write_pose(item.entry);
  }
  if (assumed > 0) {
    outcome.notices.push_back(fmt::format(
        "how steeply the camera looks down is not known of {} pictures: {} deg; --elevation-deg "
        "says otherwise",
        assumed, kUsualElevation_deg));
  }
  for (const auto& [recording, elevation_deg] : of_recording) {
    if (!elevation_deg || options.elevation_deg) continue;
    outcome.notices.push_back(fmt::format(
        "{}: the camera looks down by {:.0f} deg on the table, as its pictures show",
        outcome.notes.recordings[static_cast<std::size_t>(recording - 1)], *elevation_deg));
  }
}

void sort_out_bad(std::vector<Item>& items, bool skip_bad, ImportOutcome& outcome) {
  std::vector<Item> good;
  std::vector<std::string> bad;
  for (Item& item : items) {
    if (item.bad.empty()) {
      good.push_back(std::move(item));
    } else {
      bad.push_back(item.bad);
    }
  }
  if (!bad.empty() && (!skip_bad || good.empty())) {
    throw InputError(fmt::format("{}; {} of {} pictures cannot be used{}", bad.front(), bad.size(),
                                 items.size(), good.empty() ? "" : ", --skip-bad leaves them out"));
  }
  std::ranges::move(bad, std::back_inserter(outcome.left_out));
  items = std::move(good);
}

void set_intrinsics(const ImportOptions& options, ImportOutcome& outcome) {
  if (options.centre_px) outcome.notes.centre_px = *options.centre_px;
  if (options.focal_px) {
    outcome.notes.focal_px = *options.focal_px;
  } else {
    outcome.notices.push_back(fmt::format(
        "focal length not given: {} px, that of a Kinect at 640 x 480; --focal-px or --intrinsics "
        "says otherwise",
        outcome.notes.focal_px));
  }
}

void note_sizes(const ImportOptions& options, const std::vector<Item>& items,
                ImportOutcome& outcome) {
  std::set<std::string> objects;
  for (const Item& item : items) {
    objects.insert(item.entry.name.object);
    ++outcome.units[item.unit_m];
  }
  outcome.objects = static_cast<int>(objects.size());
  outcome.pictures = static_cast<int>(items.size());
  const int widest_px = std::ranges::max_element(items, {}, &Item::width_px)->width_px;
  if (!options.focal_px && widest_px > kUsualWidth_px) {
    outcome.notices.push_back(fmt::format(
        "a picture is {} px wide, so it is not from a camera of that focal length", widest_px));
  }
  if (const auto cropped = std::ranges::count_if(items, &Item::cropped); cropped > 0) {
    outcome.notices.push_back(fmt::format(
        "of {} pictures the principal point is not about their middle: they are taken for crops of "
        "the middle of the camera's image",
        cropped));
  }
  if (outcome.units.size() > 1) {
    outcome.notices.emplace_back("depth is in millimetres in some files and in metres in others");
  }
}

}  // namespace

ImportOutcome import_pictures(const ImportOptions& options, const ImportRun& run) {
  std::error_code ignored;
  const fs::path root = fs::absolute(run.root / ".").lexically_normal().parent_path();
  const bool ours = fs::exists(root / kPictureNotes, ignored);
  if (fs::exists(root, ignored) && !fs::is_empty(root, ignored)) {
    if (!ours) throw ConfigError(fmt::format("--out {}: holds something else", run.root.string()));
    require_absent(root / kPictureNotes, run.overwrite);
  }
  ImportOutcome outcome;
  std::vector<Item> items = items_of(options, run, outcome);
  read_poses(items);
  set_intrinsics(options, outcome);
  outcome.notes.cut = to_string(chosen_cut(options, items, outcome));
  direct_views(options, items, outcome);
  const fs::path part = part_name(root);
  fs::remove_all(part, ignored);
  try {
    number_views(part, items, outcome.notes);
    take_in_all(items, options, run, outcome.notes);
    sort_out_bad(items, run.skip_bad, outcome);
    write_poses(options, items, outcome);
    note_sizes(options, items, outcome);
    write_file(part / kPictureNotes, to_text(outcome.notes));
    replace_folder(part, root);
  } catch (...) {
    fs::remove_all(part, ignored);
    throw;
  }
  return outcome;
}

}  // namespace vantage
