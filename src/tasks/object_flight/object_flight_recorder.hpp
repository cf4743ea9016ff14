/// Writes the run folder of a flight round an object while it runs.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "vantage/planners/objects/orbit.hpp"
#include "vantage/runtime/log/event_log.hpp"
#include "vantage/runtime/recorder.hpp"
#include "vantage/tasks/object_flight/object_flight_panel.hpp"
#include "vantage/tasks/object_flight/observation_record.hpp"
#include "vantage/tasks/table_map/table_map_log.hpp"

namespace vantage {

class ObjectFlightRecorder : public EpisodeRecorder {
 public:
  /// Lean: neither states nor images are kept.
  /// @param of_change whether records tell of a change
  /// @throws OutputError, RendererError
  ObjectFlightRecorder(const EpisodeRun& run, const RecordedRobot& robot, int max_views,
                       bool of_change);

  void set_panel(std::function<RecognitionPanelInput()> panel);
  /// Adds a row to steps.csv, and the image with the object's outline to views/.
  /// @param number of the view, the first is 1
  void observation(const ObservationRecord& record, std::size_t number, const CameraImages& image,
                   const std::optional<ObjectView>& cut);
  /// What was chosen among, on the orbit where it lies.
  void decision(const std::vector<BearingOption>& options, const ObjectViewDecision& decision,
                const Orbit& orbit);
  /// The same for the window, with the way there.
  void show(Decision decision, PlannedFlight way);
  /// The map after the last observation.
  void map(const OccupancyGrid& grid);
  void commit() override;

 private:
  void tell(EpisodeEvent event);

  const World& world_;
  int max_views_;
  TableMapLog map_log_;
  int views_ = 0;
  std::optional<EventLog> event_log_;
};

}  // namespace vantage
