#include "vantage/recognition/observation_buffer.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace vantage {
namespace {

/// An image replaces another if it is nearer by that.
constexpr double kNearer_m = 0.1;

double distance_m(const BufferedObservation& observation) {
  return observation.seen.detection.distance_m;
}

}  // namespace

bool ObservationBuffer::improves(int id, int direction, double distance_m) const {
  return std::ranges::none_of(buffer_, [&](const BufferedObservation& buffered) {
    return buffered.id == id && buffered.direction == direction &&
           distance_m > buffered.seen.detection.distance_m - kNearer_m;
  });
}

void ObservationBuffer::keep(BufferedObservation observation) {
  std::erase_if(buffer_, [&](const BufferedObservation& buffered) {
    return buffered.id == observation.id && buffered.direction == observation.direction;
  });
  buffer_.push_back(std::move(observation));
}

void ObservationBuffer::forget(int id) {
  std::erase_if(buffer_, [id](const BufferedObservation& buffered) { return buffered.id == id; });
  detected_s_.erase(id);
}

bool ObservationBuffer::due(const BufferedObservation& observation, double time_s,
                            int direction) const {
  if (distance_m(observation) > options_.near_m) {
    const auto detected = detected_s_.find(observation.id);
    return detected == detected_s_.end() || time_s - detected->second >= options_.left_after_s;
  }
  return observation.direction != direction || time_s - observation.time_s >= options_.patience_s;
}

std::vector<BufferedObservation> ObservationBuffer::take_due(
    double time_s, const std::function<int(int id)>& direction_of) {
  const auto first_due = std::stable_partition(
      buffer_.begin(), buffer_.end(), [&](const BufferedObservation& observation) {
        return !due(observation, time_s, direction_of(observation.id));
      });
  std::vector<BufferedObservation> taken(std::make_move_iterator(first_due),
                                         std::make_move_iterator(buffer_.end()));
  buffer_.erase(first_due, buffer_.end());
  std::ranges::stable_sort(taken, {}, distance_m);
  return taken;
}

std::vector<BufferedObservation> ObservationBuffer::take_all() {
  std::vector<BufferedObservation> taken = std::exchange(buffer_, {});
  std::ranges::stable_sort(taken, {}, distance_m);
  return taken;
}

}  // namespace vantage
