/// The parts of the loop for a quadrotor that recognises one object, or tells whether it has
/// changed.  [Potthast2016, 4.5.7, 4.5.8]
#pragma once

#include <filesystem>
#include <vector>

#include "vantage/tasks/recognition/object_inquiry.hpp"
#include "vantage/tasks/recognition/object_on_table.hpp"
#include "vantage/tasks/recognition/observation_record.hpp"
#include "vantage/tasks/recognition/orbit_robot_interface.hpp"
#include "vantage/tasks/recognition/recognition_recorder.hpp"

namespace vantage {

/// The recogniser of an episode, made ready.
/// @throws InputError if the model file is missing, saying how to make one, or damaged; ConfigError
/// if it does not know the object on the table, or the one that is expected there.
Recogniser load_episode_recogniser(const ResolvedEpisode& resolved);

class ObjectRecognition {
 public:
  /// @param recogniser knows the object on the table; outlives this
  ObjectRecognition(const ResolvedEpisode& resolved, const Recogniser& recogniser,
                    OrbitRobotInterface& robot, RecognitionRecorder& recorder);

  FlightObservation observe();
  void update(const FlightObservation& observation);
  void record();
  [[nodiscard]] bool finished() const;
  std::vector<BearingOption> propose();
  void score(std::vector<BearingOption>& options);
  std::size_t choose(const std::vector<BearingOption>& options);
  void act(const BearingOption& option);

  [[nodiscard]] const std::vector<ObservationRecord>& observation_records() const {
    return observation_records_;
  }
  [[nodiscard]] const Recogniser& recogniser() const { return recogniser_; }
  [[nodiscard]] const Recognition& recognition() const { return inquiry_.recognition(); }
  [[nodiscard]] const ObjectInquiry& inquiry() const { return inquiry_; }
  [[nodiscard]] const ObjectOnTable& truth() const { return truth_; }
  /// All places to look from.
  [[nodiscard]] std::vector<Candidate> places() const;

 private:
  [[nodiscard]] double bearing_rad(int id) const;
  [[nodiscard]] bool visited(int id) const;
  void conclude();
  [[nodiscard]] RecognitionPanelInput panel() const;

  Episode episode_;
  OrbitRobotInterface& robot_;
  RecognitionRecorder& recorder_;
  ObjectOnTable truth_;
  double first_rad_;  ///< bearing of the first view, from which all others count
  const Recogniser& recogniser_;
  ObjectInquiry inquiry_;
  Rng choice_rng_;
  Rng segmentation_rng_;
  NextView next_;
  ObservationRecord current_;  ///< filled in from the decision to the end of its view
  SegmentedObject seen_;
  CameraImages camera_image_;
  std::vector<ObservationRecord> observation_records_;
};

}  // namespace vantage
