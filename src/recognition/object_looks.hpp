/// What is believed of the objects that were found in flight, and which looks at them count.
/// [Potthast2016, 5.3]
#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

#include "vantage/planners/trajectory/observation_ring.hpp"
#include "vantage/geometry/object_sighting.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/recognition/recognition.hpp"

namespace vantage {

/// Which looks are taken as observations: one from each direction of ObservationRing, of objects
/// that are not known yet, where it is expected to tell something. Of a direction the nearest
/// picture is the observation.
struct LookOptions {
  double range_m = 2.0;           ///< camera to object; higher sees more and worse
  double known_below_nats = 0.1;  ///< entropy of the object below which it is known
  bool look_at_known = false;     ///< go on observing what is known
  /// Expected of the object, from that direction; higher looks less. 0: every direction counts.
  double least_gain_nats = 0.03;
  /// Between the bearings of an object's observations; lower takes two from hardly another side.
  double apart_rad = 0.3;
  /// A picture from nearer than that is taken once none was nearer for `patience_s`, or the
  /// direction was left. Higher takes more pictures that a nearer one would have made needless.
  double near_m = 1.3;
  double patience_s = 0.5;  ///< higher waits for better pictures; 0 takes the first
  /// Those from farther off are taken when the object was not in view for so long, the nearest
  /// first, as long as it is not known.
  double left_after_s = 2.0;
  void fields(auto&& f) {
    f("range_m", range_m, Range{0.0, 20.0, true});
    f("known_below_nats", known_below_nats, at_least(0.0));
    f("look_at_known", look_at_known);
    f("least_gain_nats", least_gain_nats, at_least(0.0));
    f("apart_rad", apart_rad, between(0.0, 3.0));
    f("near_m", near_m, at_least(0.0));
    f("patience_s", patience_s, between(0.0, 100.0));
    f("left_after_s", left_after_s, between(0.0, 100.0));
  }
};

/// An observation.
struct ObjectLook {
  double time_s = 0.0;       ///< simulated
  double bearing_rad = 0.0;  ///< from the object to the camera, world
  int direction = 0;         ///< that it uses up
  double distance_m = 0.0;
  double elevation_rad = 0.0;  ///< of the camera above the object
  int pixels = 0;              ///< that show the object
  ViewReport report;
  double entropy_nats = 0.0;  ///< of the object, after it
  std::string estimate;       ///< the most probable object, after it
  double map_probability = 0.0;
  Pose T_world_camera = Pose::Identity();  ///< as estimated
};

/// One object that was found.
struct LookedAtObject {
  int id = 0;  ///< of FoundObject
  Eigen::Vector3d p_world_m = Eigen::Vector3d::Zero();
  Recognition recognition;
  std::array<bool, kObservationDirections> used{};
  std::vector<ObjectLook> looks = {};
  /// What a look from each direction is expected to tell of the object; of one that was never
  /// looked at a guess, the same of all.
  std::array<double, kObservationDirections> gain_nats{};
};

class ObjectLooks {
 public:
  /// @param recogniser outlives this
  ObjectLooks(const Recogniser& recogniser, const LookOptions& options,
              const TransitionModel& transition);

  /// Where the object of that id is believed to be; the first time is the first one hears of it.
  void found(int id, const Eigen::Vector3d& p_world_m);
  /// It turned out to be another one.
  void forget(int id);

  /// Whether a look at the object from there would be an observation.
  [[nodiscard]] bool wants(int id, const ObjectSighting& sighting,
                           const Pose& T_world_camera) const;
  /// That the object of that id is seen from.
  [[nodiscard]] int direction(int id, const Pose& T_world_camera) const;
  /// Takes it. @param rng of feature choices, of which there are none as long as all are extracted
  const ObjectLook& take(int id, const ObjectSighting& sighting, const ObjectView& view,
                         const Pose& T_world_camera, double time_s, Rng& rng);

  [[nodiscard]] const std::vector<LookedAtObject>& objects() const { return objects_; }
  [[nodiscard]] double entropy_nats(const LookedAtObject& object) const;
  [[nodiscard]] bool known(const LookedAtObject& object) const;
  [[nodiscard]] int total() const { return total_; }  ///< observations, of forgotten ones too
  [[nodiscard]] const Recogniser& recogniser() const { return recogniser_; }
  /// The most probable object.
  [[nodiscard]] const std::string& estimate(const LookedAtObject& object) const;
  [[nodiscard]] double map_probability(const LookedAtObject& object) const;

 private:
  [[nodiscard]] LookedAtObject& of(int id);
  [[nodiscard]] std::array<double, kObservationDirections> gains_nats(
      const LookedAtObject& object) const;
  [[nodiscard]] const LookedAtObject* find(int id) const;

  const Recogniser& recogniser_;
  LookOptions options_;
  RecognitionOptions recognition_;
  std::vector<LookedAtObject> objects_;
  int total_ = 0;
};

}  // namespace vantage
