/// The parts of the loop for a quadrotor that recognises one object, or tells whether it has
/// changed.  [Potthast2016, 4.5.7, 4.5.8]
#pragma once

#include <string>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/planners/candidate.hpp"
#include "vantage/tasks/object_flight/object_flight.hpp"
#include "vantage/tasks/object_flight/object_flight_evaluator.hpp"
#include "vantage/tasks/object_flight/object_flight_recorder.hpp"
#include "vantage/tasks/object_flight/object_inquiry.hpp"
#include "vantage/tasks/object_flight/orbit_robot_interface.hpp"

namespace vantage {

/// What the parts work with; all of it outlives them.
struct ObjectFlightContext {
  const EpisodeOptions& options;
  const ObjectFlight& task;
  const Recogniser& recogniser;
  OrbitRobotInterface& robot;
  const ObjectFlightEvaluator& evaluator;  ///< asked when recording
  ObjectFlightRecorder& recorder;
};

/// What the map says is there, for the panel; nothing where nothing is expected.
struct Expectation {
  std::string object;
  double threshold = 0.0;  ///< of P(u), above which it is changed
};

class ObjectFlightParts {
 public:
  /// @param first_rad bearing of the first view, from which all others count
  ObjectFlightParts(const ObjectFlightContext& context, ObjectInquiry inquiry, double first_rad,
                    Expectation expectation = {});

  FlightObservation observe();
  void update(const FlightObservation& observation);
  void record();
  [[nodiscard]] std::string finished() const { return inquiry_.over(); }
  std::vector<BearingOption> propose();
  void score(std::vector<BearingOption>& options);
  std::size_t choose(const std::vector<BearingOption>& options);
  void act(const BearingOption& option);

  [[nodiscard]] const std::vector<ObservationRecord>& records() const { return records_; }
  [[nodiscard]] const Recogniser& recogniser() const { return recogniser_; }
  [[nodiscard]] const Recognition& recognition() const { return inquiry_.recognition(); }
  /// All places to look from.
  [[nodiscard]] std::vector<Candidate> places() const;

 private:
  [[nodiscard]] double bearing_rad(int id) const;
  [[nodiscard]] bool visited(int id) const;
  void conclude();
  void tell_decision(const std::vector<BearingOption>& options, std::size_t chosen);
  [[nodiscard]] RecognitionPanelInput panel() const;

  ObjectFlight task_;
  const Recogniser& recogniser_;
  OrbitRobotInterface& robot_;
  const ObjectFlightEvaluator& evaluator_;
  ObjectFlightRecorder& recorder_;
  ObjectInquiry inquiry_;
  double first_rad_;
  Expectation expectation_;
  Rng choice_rng_;
  Rng segmentation_rng_;
  NextView next_;
  ObservationRecord current_;  ///< filled in from the decision to the end of its view
  SegmentedObject seen_;
  CameraImages camera_image_;
  std::vector<ObservationRecord> records_;
};

}  // namespace vantage
