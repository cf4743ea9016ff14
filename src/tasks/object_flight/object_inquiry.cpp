#include "vantage/tasks/object_flight/object_inquiry.hpp"

#include <fmt/format.h>

namespace vantage {
namespace {

ChangeOptions only_recognition(const RecognitionOptions& options) {
  ChangeOptions both;
  both.recognition = options;
  return both;
}

std::string recognition_text(RecognitionEnd end, const Recogniser& recogniser,
                             const RecognitionOptions& options, const Recognition& known) {
  if (end == RecognitionEnd::max_views) {
    return fmt::format("limit of {} views, not sure", options.max_views);
  }
  const ObjectStates& states = recogniser.states;
  if (seen_enough(options.enough, states, p_state(known.belief)) == EnoughReason::entropy) {
    return fmt::format("sure: entropy {:.3g} bits, below enough.entropy_bits {:g}",
                       known.views.back().entropy_bits, options.enough.entropy_bits);
  }
  const ObjectEstimate estimate = estimate_of(states, known.belief);
  return fmt::format("sure: {} with probability {:.3g}, above enough.object_probability {:g}",
                     estimate.object, estimate.probability, options.enough.object_probability);
}

std::string change_text(ChangeEnd end, const ChangeOptions& options, const ChangeSearch& search) {
  const double p = search.hypotheses.p_changed();
  switch (end) {
    case ChangeEnd::nothing_seen:
      return fmt::format("{} views in a row without the object (empty_views)", search.empty_views);
    case ChangeEnd::max_views:
      return fmt::format("limit of {} views, still in doubt", options.recognition.max_views);
    case ChangeEnd::changed:
      return fmt::format("sure of a change: probability {:.3g}, above changed_above {:g}", p,
                         options.changed_above);
    case ChangeEnd::unchanged:
      return fmt::format("sure of no change: probability {:.3g}, below unchanged_below {:g}", p,
                         options.unchanged_below);
  }
  return {};
}

}  // namespace

ExtractFeature extract_from(const Recogniser& recogniser, const SegmentedObject& seen) {
  if (seen.view) return extract_from(recogniser, *seen.view);
  return [reason = seen.reason, place_seen = seen.place_seen](std::size_t) {
    ExtractedFeature nothing;
    nothing.result = FeatureResult::skip(reason);
    nothing.place_seen = place_seen;
    return nothing;
  };
}

ObjectInquiry::ObjectInquiry(const Recogniser& recogniser, const RecognitionOptions& options)
    : recogniser_(recogniser),
      options_(only_recognition(options)),
      known_(begin_recognition(recogniser_)) {}

ObjectInquiry::ObjectInquiry(const Recogniser& recogniser, const ChangeOptions& options,
                             const std::string& object, double seen_yaw_rad)
    : recogniser_(recogniser),
      options_(options),
      known_(begin_change_search(recogniser_, options_,
                                 state_seen(recogniser_.states, object, seen_yaw_rad))) {}

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

std::string ObjectInquiry::over() const {
  if (const auto* search = std::get_if<ChangeSearch>(&known_)) {
    const auto end = change_end(options_, *search);
    return end ? change_text(*end, options_, *search) : "";
  }
  const auto end = recognition_end(recogniser_, options_.recognition, recognition());
  return end ? recognition_text(*end, recogniser_, options_.recognition, recognition()) : "";
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
