/// Observation buffer: detections of objects that may become observations, of each direction the
/// nearest, until it is clear that no nearer one follows.
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "vantage/perception/search/object_search.hpp"
#include "vantage/recognition/object_observations.hpp"

namespace vantage {

struct BufferedObservation {
  int id = 0;
  int direction = 0;
  SeenObject seen;
  Pose T_world_camera = Pose::Identity();  ///< as estimated
  double time_s = 0.0;
};

class ObservationBuffer {
 public:
  explicit ObservationBuffer(const ObservationOptions& options) : options_(options) {}

  /// The object is in view, though perhaps not for an observation.
  void detected(int id, double time_s) { detected_s_[id] = time_s; }
  /// Whether an image from this distance is nearer than the one in the buffer for that direction.
  [[nodiscard]] bool improves(int id, int direction, double distance_m) const;
  /// Replaces the one in the buffer for its direction.
  void keep(BufferedObservation observation);
  void forget(int id);
  /// Takes those that are due out of the buffer, nearest first.
  /// @param direction_of an object, that the camera is in now
  std::vector<BufferedObservation> take_due(double time_s,
                                            const std::function<int(int id)>& direction_of);
  /// All, nearest first.
  std::vector<BufferedObservation> take_all();

 private:
  [[nodiscard]] bool due(const BufferedObservation& observation, double time_s,
                         int direction) const;

  ObservationOptions options_;
  std::vector<BufferedObservation> buffer_;
  std::map<int, double> detected_s_;  ///< last, by id
};

}  // namespace vantage
