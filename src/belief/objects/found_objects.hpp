/// The objects that were found so far, without knowing how many there are.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/geometry/object_sighting.hpp"

namespace vantage {

struct FoundObjectsOptions {
  /// Sightings nearer than that to an object, level, are of it; higher joins neighbours.
  double gate_m = 0.35;
  double partial_weight = 0.1;  ///< of a sighting cut by the frame, in the mean; whole is 1
  int min_sightings = 3;        ///< fewer may have been noise
  void fields(auto&& f) {
    f("gate_m", gate_m, Range{0.0, 2.0, true});
    f("partial_weight", partial_weight, Range{0.0, 1.0, true});
    f("min_sightings", min_sightings, at_least(1));
  }
};

struct FoundObject {
  int id = 0;                                                  ///< from 0, never used again
  Eigen::Vector3d p_world_object_m = Eigen::Vector3d::Zero();  ///< weighted mean of the sightings
  double support_z_m = 0.0;                                    ///< weighted mean
  double radius_m = 0.0;                                       ///< weighted mean
  double height_m = 0.0;                                       ///< weighted mean
  int sightings = 0;
  int whole_sightings = 0;
  double weight = 0.0;     ///< of all sightings
  bool confirmed = false;  ///< sighted often enough; stays so
};

/// Tells which sightings are of one object by where they are. Sightings near the camera count for
/// more, since depth is the better there.
class FoundObjects {
 public:
  /// @throws ConfigError if options are out of range.
  explicit FoundObjects(const FoundObjectsOptions& options = {});

  /// Takes the sightings of ONE image. @return the id of the object that each one is of
  std::vector<int> update(std::span<const ObjectSighting> sightings);

  /// All of them, by ascending id, unconfirmed ones included.
  [[nodiscard]] const std::vector<FoundObject>& objects() const { return objects_; }
  [[nodiscard]] std::vector<FoundObject> confirmed() const;
  /// Nothing if there is none of that id, or it turned out to be another one's.
  [[nodiscard]] const FoundObject* find(int id) const;

 private:
  int take(FoundObject seen);
  void merge_neighbours(std::vector<int>& ids);
  [[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> neighbours() const;
  void confirm(FoundObject& object) const;

  FoundObjectsOptions options_;
  std::vector<FoundObject> objects_;
  int next_id_ = 0;
};

}  // namespace vantage
