#include "vantage/perception/dataset_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
constexpr std::string_view kCrop = "_crop.png";
constexpr std::array<std::string_view, 4> kBeside{"depthcrop.png", "maskcrop.png", "loc.txt",
                                                  "pose.txt"};

/// Takes "_<number>" off the end; nothing if it does not end so.
std::optional<int> take_number(std::string_view& text) {
  const auto underscore = text.rfind('_');
  if (underscore == std::string_view::npos || underscore == 0) return std::nullopt;
  const std::string_view digits = text.substr(underscore + 1);
  int number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc{} || end != digits.data() + digits.size() || number < 0) {
    return std::nullopt;
  }
  text = text.substr(0, underscore);
  return number;
}

std::vector<fs::path> sorted_folders(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const bool hidden = entry.path().filename().string().starts_with('.');
    if (entry.is_directory(error) && !hidden) found.push_back(entry.path());
  }
  std::ranges::sort(found);
  return found;
}

struct TurntablePose {
  double yaw_rad = 0.0;
  std::optional<double> elevation_rad;
};

/// "yaw" or "yaw elevation", degrees.
TurntablePose read_pose(const fs::path& file) {
  const std::string text = read_file(file);
  const char* at = text.data();
  const char* end = text.data() + text.size();
  std::vector<double> degrees;
  while (true) {
    at = std::find_if_not(at, end, [](char c) { return std::isspace(c) != 0; });
    double number = 0.0;
    const auto [stop, error] = std::from_chars(at, end, number);
    if (error != std::errc{}) break;
    degrees.push_back(number);
    at = stop;
  }
  const bool finite = std::ranges::all_of(degrees, [](double d) { return std::isfinite(d); });
  if (at != end || !finite || degrees.empty() || degrees.size() > 2) {
    throw InputError(fmt::format(
        "{}: expected the pose in degrees, one number, or two with the camera's elevation",
        file.string()));
  }
  if (degrees.size() == 2 && std::abs(degrees[1]) > 90.0) {
    throw InputError(
        fmt::format("{}: an elevation of {} deg is beyond 90", file.string(), degrees[1]));
  }
  const double turns = degrees[0] / 360.0;
  const double yaw_rad = 2.0 * std::numbers::pi * (turns - std::floor(turns));
  TurntablePose pose{.yaw_rad = yaw_rad < 2.0 * std::numbers::pi ? yaw_rad : 0.0,
                     .elevation_rad = {}};
  if (degrees.size() == 2) pose.elevation_rad = degrees[1] * kRadiansPerDegree;
  return pose;
}

class Indexer {
 public:
  Indexer(const fs::path& root, OnBadView on_bad) : on_bad_(on_bad) {
    if (auto notes = read_picture_notes(root)) {
      notes_ = std::make_shared<const PictureNotes>(std::move(*notes));
    }
  }

  void add_object(const fs::path& folder) {
    std::set<std::string> names;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      names.insert(entry.path().filename().string());
    }
    if (error) reject(folder, error.message());
    const std::string category = folder.parent_path().filename().string();
    for (const std::string& name : names) {
      if (!name.ends_with(kCrop)) continue;
      const std::string stem = name.substr(0, name.size() - kCrop.size());
      auto parsed = parse_view_name(stem);
      if (parsed && to_string(*parsed) == stem) {
        if (parsed->object.starts_with(category + "_")) parsed->category = category;
        add_view(folder, *parsed, names);
      } else {
        reject(folder / name, fmt::format("is not called <category>_<instance>_<video>_<frame>{}, "
                                          "with numbers up to {} and no 0 before them",
                                          kCrop, std::numeric_limits<int>::max()));
      }
    }
  }

  DatasetIndex finish() {
    std::map<std::string, int> views_of;
    for (const ViewEntry& view : index_.views) ++views_of[view.name.category];
    std::erase_if(index_.views, [&](const ViewEntry& view) {
      if (notes_ || views_of[view.name.category] > 1) return false;
      reject(view.file("crop.png"), "the only view of its category");
      return true;
    });
    std::ranges::sort(index_.views, {}, [](const ViewEntry& view) {
      return std::tie(view.name.category, view.name.object, view.name.video, view.name.frame);
    });
    return std::move(index_);
  }

 private:
  void add_view(const fs::path& folder, const ViewName& name, const std::set<std::string>& files) {
    ViewEntry view{name, folder, 0.0, {}, notes_, {}};
    for (const std::string_view suffix : kBeside) {
      const fs::path file = view.file(suffix);
      if (!files.contains(file.filename().string())) return reject(file, "is missing");
    }
    try {
      const TurntablePose pose = read_pose(view.file("pose.txt"));
      view.yaw_rad = pose.yaw_rad;
      view.given_elevation_rad = pose.elevation_rad;
    } catch (const InputError& error) {
      if (on_bad_ == OnBadView::fail) throw;
      index_.skipped.push_back({view.file("pose.txt"), error.what()});
      return;
    }
    if (!view.given_elevation_rad && !video_elevation_rad(name.video)) {
      return reject(view.file("crop.png"),
                    fmt::format("video {} is none of 1, 2, 4, and pose.txt holds no elevation "
                                "after the yaw",
                                name.video));
    }
    index_.views.push_back(std::move(view));
  }

  void reject(const fs::path& file, const std::string& reason) {
    const std::string what = fmt::format("{}: {}", file.string(), reason);
    if (on_bad_ == OnBadView::fail) throw InputError(what);
    index_.skipped.push_back({file, what});
  }

  OnBadView on_bad_;
  std::shared_ptr<const PictureNotes> notes_;
  DatasetIndex index_;
};

}  // namespace

std::optional<ViewName> parse_view_name(std::string_view text) {
  ViewName name;
  const auto frame = take_number(text);
  const auto video = frame ? take_number(text) : std::nullopt;
  if (!video) return std::nullopt;
  name.frame = *frame;
  name.video = *video;
  name.object = text;
  if (!take_number(text)) return std::nullopt;
  name.category = text;
  return name;
}

std::string to_string(const ViewName& name) {
  return fmt::format("{}_{}_{}", name.object, name.video, name.frame);
}

std::optional<double> video_elevation_rad(int video) {
  switch (video) {
    case 1: return 30.0 * kRadiansPerDegree;
    case 2: return 45.0 * kRadiansPerDegree;
    case 4: return 60.0 * kRadiansPerDegree;
    default: return std::nullopt;
  }
}

int yaw_bin(double yaw_rad, int bins) {
  expects(bins > 0, "there are yaw bins");
  const double turns = yaw_rad / (2.0 * std::numbers::pi);
  const auto bin = static_cast<int>(std::floor((turns - std::floor(turns)) * bins + 0.5));
  return bin % bins;
}

double ViewEntry::elevation_rad() const {
  if (given_elevation_rad) return *given_elevation_rad;
  const auto of_video = video_elevation_rad(name.video);
  if (!of_video) {
    throw InputError(fmt::format("{}: its video is none of 1, 2, 4", file("crop.png").string()));
  }
  return *of_video;
}

ObjectCut ViewEntry::mask_from() const {
  return notes ? object_cut_of(notes->cut, kPictureNotes) : ObjectCut::mask;
}

fs::path ViewEntry::file(std::string_view suffix) const {
  return folder / fmt::format("{}_{}", to_string(name), suffix);
}

DatasetIndex index_dataset(const fs::path& root, OnBadView on_bad) {
  std::error_code error;
  if (!fs::is_directory(root, error)) {
    throw InputError(fmt::format("{}: no such folder of a dataset", root.string()));
  }
  Indexer indexer(root, on_bad);
  for (const fs::path& category : sorted_folders(root)) {
    for (const fs::path& object : sorted_folders(category)) indexer.add_object(object);
  }
  DatasetIndex index = indexer.finish();
  if (index.views.empty()) {
    const std::string first =
        index.skipped.empty() ? "" : fmt::format("; {}", index.skipped.front().reason);
    throw InputError(fmt::format(
        "{}: no view <category>/<category>_<instance>/..._crop.png in it{}", root.string(), first));
  }
  return index;
}

}  // namespace vantage
