#include "vantage/tasks/recognition/object_inquiry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vantage/tasks/recognition/object_on_table.hpp"

namespace vantage {
namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

/// What the map says, as the camera would see it from there.
int expected_state(const Recogniser& recogniser, const Episode& episode, double bearing_rad) {
  const ObjectStates& states = recogniser.states;
  const ObjectOnTable expected = draw_expected_object(episode);
  const auto found = std::ranges::find(states.objects, expected.object);
  expects(found != states.objects.end(), "load_episode_recogniser() has looked for it");
  const auto bin = std::lround((expected.yaw_rad - bearing_rad) / kTurn_rad * states.bins);
  return states.state(static_cast<int>(found - states.objects.begin()),
                      static_cast<int>((bin % states.bins + states.bins) % states.bins));
}

ChangeOptions change_options(const Episode& episode) {
  ChangeOptions options = episode.change_detection.options;
  options.recognition = episode.recognition.decision;
  return options;
}

}  // namespace

ObjectInquiry::ObjectInquiry(const Recogniser& recogniser, const Episode& episode,
                             double bearing_rad)
    : recogniser_(recogniser), options_(change_options(episode)) {
  if (episode.detects_change()) {
    known_ = begin_change_search(recogniser_, options_,
                                 expected_state(recogniser_, episode, bearing_rad));
  } else {
    known_ = begin_recognition(recogniser_);
  }
}

void ObjectInquiry::observe(const ExtractFeature& extract, double view_rad, double view_time_s,
                            Rng& rng) {
  if (auto* search = std::get_if<ChangeSearch>(&known_)) {
    update_with_view(recogniser_, options_, extract, view_rad, *search, rng);
    search->recognition.views.back().view_time_s = view_time_s;
    return;
  }
  auto& recognition = std::get<Recognition>(known_);
  update_with_view(recogniser_, options_.recognition, extract, view_rad, recognition, rng);
  recognition.views.back().view_time_s = view_time_s;
}

void ObjectInquiry::turned(double motion_rad) {
  if (auto* search = std::get_if<ChangeSearch>(&known_)) {
    predict_motion(recogniser_, options_, motion_rad, *search);
  } else {
    predict_motion(recogniser_, options_.recognition, motion_rad, std::get<Recognition>(known_));
  }
}

bool ObjectInquiry::over() const {
  if (const auto* search = std::get_if<ChangeSearch>(&known_)) return !in_doubt(options_, *search);
  return recognition_end(recogniser_, options_.recognition, recognition()).has_value();
}

const Recognition& ObjectInquiry::recognition() const {
  const auto* search = std::get_if<ChangeSearch>(&known_);
  return search != nullptr ? search->recognition : std::get<Recognition>(known_);
}

double ObjectInquiry::p_changed() const {
  if (verdict() == Change::removed) return 1.0;
  return std::get<ChangeSearch>(known_).hypotheses.p_changed();
}

Change ObjectInquiry::verdict() const {
  return vantage::verdict(recogniser_, options_, std::get<ChangeSearch>(known_));
}

}  // namespace vantage
