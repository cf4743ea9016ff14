/// The parts of the loop for a quadrotor that recognises objects on a table, or tells whether one
/// has changed.  [Potthast2016, 4.5.7, 4.5.8]
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/planners/candidate.hpp"
#include "vantage/tasks/flight/image_gate.hpp"
#include "vantage/tasks/object_flight/object_flight.hpp"
#include "vantage/tasks/object_flight/object_flight_evaluator.hpp"
#include "vantage/tasks/object_flight/object_flight_recorder.hpp"
#include "vantage/tasks/object_flight/orbit_robot_interface.hpp"
#include "vantage/tasks/object_flight/target_tour.hpp"

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
  /// @param inquiry about each target, before any view
  /// @param first_rad bearing of the first view, from which all others count
  ObjectFlightParts(const ObjectFlightContext& context, const FlightGoal& goal,
                    const ObjectInquiry& inquiry, double first_rad, Expectation expectation = {});

  FlightObservation observe();
  void update(const FlightObservation& observation);
  void record();
  /// If there is a next view, finds out what it may be.
  std::string finished();
  std::vector<BearingOption> propose() { return std::move(options_); }
  void score(std::vector<BearingOption>& options);
  std::size_t choose(const std::vector<BearingOption>& options);
  void act(const BearingOption& option);

  [[nodiscard]] const std::vector<ObservationRecord>& records() const { return records_; }
  [[nodiscard]] const Recogniser& recogniser() const { return recogniser_; }
  /// Of the target that is looked at.
  [[nodiscard]] const Recognition& recognition() const {
    return tour_.current().inquiry.recognition();
  }
  [[nodiscard]] const TargetTour& tour() const { return tour_; }
  /// All places to look from.
  [[nodiscard]] std::vector<Candidate> places() const;

 private:
  void look_at(const FlightObservation& observation);
  [[nodiscard]] double bearing_rad(int id) const;
  /// How far beyond a bearing the last flight has ended; 0 if it has arrived.
  [[nodiscard]] double missed_by_rad(double bearing_rad) const;
  [[nodiscard]] Orbit orbit(std::size_t target) const;
  [[nodiscard]] std::vector<BearingOption> options_to(
      const std::vector<std::size_t>& targets) const;
  [[nodiscard]] std::vector<BearingOption> options_of(std::size_t target) const;
  /// Whether the last view was taken from there.
  [[nodiscard]] bool is_at(std::size_t target, int id) const {
    return !records_.empty() && records_.back().target == target &&
           records_.back().bearing_id == id;
  }
  [[nodiscard]] std::optional<BearingOption> clear_option(std::size_t target, int id) const;
  [[nodiscard]] std::string why_unreachable(std::size_t target) const;
  [[nodiscard]] bool is_clear(const FlightPlan& plan) const;
  void conclude();
  void tell_decision(const std::vector<BearingOption>& options, std::size_t chosen);
  [[nodiscard]] RecognitionPanelInput panel() const;

  ObjectFlight task_;
  FlightGoal goal_;
  const Recogniser& recogniser_;
  OrbitRobotInterface& robot_;
  const ObjectFlightEvaluator& evaluator_;
  ObjectFlightRecorder& recorder_;
  TargetTour tour_;
  std::optional<TableMap> map_;
  double first_rad_;
  Orbit at_orbit_;  ///< where the camera was flown to last
  double at_rad_;   ///< on it
  Expectation expectation_;
  Rng choice_rng_;
  Rng segmentation_rng_;
  std::vector<BearingOption> options_;
  NextView next_;
  ObservationRecord current_;  ///< filled in from the decision to the end of its view
  SegmentedObject seen_;
  ImageGate gate_{4};
  CameraImages camera_image_;
  std::vector<ObservationRecord> records_;
};

}  // namespace vantage
