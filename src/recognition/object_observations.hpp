/// Beliefs about the objects found in flight, and which detections count as observations.
/// [Potthast2016, 5.3]
#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

#include "vantage/geometry/object_detection.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/planners/trajectory/observation_ring.hpp"
#include "vantage/recognition/recognition.hpp"

namespace vantage {

/// Which detections are taken as observations: one from each direction of ObservationRing, of
/// objects that are not known yet, where the expected information is large enough. Of a direction
/// the nearest image is the observation.
struct ObservationOptions {
  double range_m = 2.0;
  double known_below_nats = 0.1;
  bool observe_known = false;
  double min_gain_nats = 0.03;
  double apart_rad = 0.3;
  double near_m = 1.3;  ///< higher takes more images that a nearer one would have made needless
  double patience_s = 0.5;
  double left_after_s = 2.0;
  void fields(auto&& f) {
    f("range_m", range_m,
      "greatest distance from camera to object of an observation; higher takes more and worse ones",
      Range{0.0, 20.0, true});
    f("known_below_nats", known_below_nats,
      "entropy of what the object is, below which it is known; higher is satisfied sooner",
      at_least(0.0));
    f("observe_known", observe_known, "true: objects that are known are observed further");
    f("min_gain_nats", min_gain_nats,
      "least expected information about the object that is worth an observation; higher observes "
      "less; 0: every direction counts",
      at_least(0.0));
    f("apart_rad", apart_rad,
      "least angle between the bearings of an object's observations; lower takes several from "
      "nearly the same side",
      between(0.0, 3.0));
    f("near_m", near_m,
      "distance within which an image is taken once no nearer one comes for `patience_s` or its "
      "direction is left; higher takes more images",
      at_least(0.0));
    f("patience_s", patience_s,
      "how long a nearer image of the same direction is waited for; higher waits for better ones; "
      "0: takes the first",
      between(0.0, 100.0));
    f("left_after_s", left_after_s,
      "time out of view after which images from beyond `near_m` are taken of an object that is not "
      "known, the nearest first",
      between(0.0, 100.0));
  }
};

/// An observation.
struct ObjectObservation {
  double time_s = 0.0;       ///< simulated
  double bearing_rad = 0.0;  ///< from the object to the camera, world
  int direction = 0;         ///< that it uses up
  double distance_m = 0.0;
  double elevation_rad = 0.0;  ///< of the camera above the object
  int pixels = 0;              ///< that show the object
  ViewReport report;
  double entropy_nats = 0.0;  ///< of the object, after it
  std::string estimate;       ///< ObjectEstimate::object, after it
  double map_probability = 0.0;
  double unknown_probability = 0.0;
  Pose T_world_camera = Pose::Identity();  ///< as estimated
};

/// One object that was found.
struct RecognisedObject {
  int id = 0;  ///< of TrackedObject
  Eigen::Vector3d p_world_m = Eigen::Vector3d::Zero();
  Recognition recognition;
  std::array<bool, kObservationDirections> used{};
  std::vector<ObjectObservation> observations = {};
  /// Expected information of an observation from each direction; the same guess for all of an
  /// object that was never observed.
  std::array<double, kObservationDirections> gain_nats{};
};

class ObjectObservations {
 public:
  /// @param recogniser outlives this
  ObjectObservations(const Recogniser& recogniser, const ObservationOptions& options,
                     const TransitionModel& transition);

  /// Where the object of that id is believed to be; the first time is the first one hears of it.
  void found(int id, const Eigen::Vector3d& p_world_m);
  /// It turned out to be another one.
  void forget(int id);

  /// Whether a detection of the object from there would be an observation.
  [[nodiscard]] bool wants(int id, const ObjectDetection& detection,
                           const Pose& T_world_camera) const;
  /// That the object of that id is seen from.
  [[nodiscard]] int direction(int id, const Pose& T_world_camera) const;
  /// Takes it. @param rng of feature choices, of which there are none as long as all are extracted
  const ObjectObservation& take(int id, const ObjectDetection& detection, const ObjectView& view,
                                const Pose& T_world_camera, double time_s, Rng& rng);

  [[nodiscard]] const std::vector<RecognisedObject>& objects() const { return objects_; }
  [[nodiscard]] double entropy_nats(const RecognisedObject& object) const;
  [[nodiscard]] bool known(const RecognisedObject& object) const;
  [[nodiscard]] int total() const { return total_; }  ///< observations, of forgotten ones too
  [[nodiscard]] const Recogniser& recogniser() const { return recogniser_; }
  [[nodiscard]] ObjectEstimate estimate(const RecognisedObject& object) const;
  [[nodiscard]] double unknown_probability(const RecognisedObject& object) const;
  /// Of an object that was never observed.
  [[nodiscard]] double prior_entropy_nats() const;

 private:
  [[nodiscard]] RecognisedObject& of(int id);
  [[nodiscard]] std::array<double, kObservationDirections> gains_nats(
      const RecognisedObject& object) const;
  [[nodiscard]] const RecognisedObject* find(int id) const;

  const Recogniser& recogniser_;
  ObservationOptions options_;
  RecognitionOptions recognition_;
  std::vector<RecognisedObject> objects_;
  int total_ = 0;
};

}  // namespace vantage
