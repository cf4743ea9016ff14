/// Object tracker: associates detections with objects whose number is not known.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/geometry/object_detection.hpp"

namespace vantage {

struct ObjectTrackerOptions {
  double gate_m = 0.35;
  double partial_weight = 0.1;
  int min_detections = 3;
  void fields(auto&& f) {
    f("gate_m", gate_m,
      "horizontal distance from an object within which a detection is associated to it; higher "
      "joins neighbours",
      Range{0.0, 2.0, true});
    f("partial_weight", partial_weight,
      "weight of a detection that does not show the whole object, relative to one that does, in "
      "the object's mean place and size",
      Range{0.0, 1.0, true});
    f("min_detections", min_detections,
      "number of detections that confirm an object; higher drops more noise and confirms later",
      at_least(1));
  }
};

struct TrackedObject {
  int id = 0;                                                  ///< from 0, never used again
  Eigen::Vector3d p_world_object_m = Eigen::Vector3d::Zero();  ///< weighted mean of the detections
  double support_z_m = 0.0;                                    ///< weighted mean
  double radius_m = 0.0;                                       ///< weighted mean
  double height_m = 0.0;                                       ///< weighted mean
  int detections = 0;
  int whole_detections = 0;
  double weight = 0.0;     ///< of all detections
  bool confirmed = false;  ///< detected often enough; stays so
};

/// Associates detections with objects by position. Detections near the camera count for
/// more, since depth is the better there.
class ObjectTracker {
 public:
  /// @throws ConfigError if options are out of range.
  explicit ObjectTracker(const ObjectTrackerOptions& options = {});

  /// Takes the detections of ONE image. @return the id of the object that each one is of
  std::vector<int> update(std::span<const ObjectDetection> detections);

  /// All of them, by ascending id, unconfirmed ones included.
  [[nodiscard]] const std::vector<TrackedObject>& objects() const { return objects_; }
  [[nodiscard]] std::vector<TrackedObject> confirmed() const;
  /// Nothing if there is none of that id, or it turned out to be another one's.
  [[nodiscard]] const TrackedObject* find(int id) const;

 private:
  int take(TrackedObject seen);
  void merge_neighbours(std::vector<int>& ids);
  [[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> neighbours() const;
  void confirm(TrackedObject& object) const;

  ObjectTrackerOptions options_;
  std::vector<TrackedObject> objects_;
  int next_id_ = 0;
};

}  // namespace vantage
