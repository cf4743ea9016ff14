#include "vantage/recognition/change_detection.hpp"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "vantage/information/log_space.hpp"
#include "vantage/planners/objects/state_divergence.hpp"

namespace vantage {
namespace {

constexpr double kNegInf = -std::numeric_limits<double>::infinity();

ChangeHypotheses hypotheses(const Recogniser& recogniser, const ChangeOptions& options,
                            int expected) {
  const ObjectStates& states = recogniser.states;
  const int object = states.object_of(expected);
  const double turned = options.prior_pose / std::max(states.bins - 1, 1);
  const double known = options.prior_object * (1.0 - recogniser.unknown_prior);
  const double other = known / std::max(states.known_size() - states.bins, 1);
  ChangeHypotheses h;
  h.expected.log_p = Eigen::VectorXd::Constant(states.size(), kNegInf);
  h.expected.log_p[expected] = 0.0;
  h.changed.log_p = Eigen::VectorXd::Constant(states.size(), std::log(other));
  if (states.unknown_size() > 0) {
    h.changed.log_p.tail(states.unknown_size()) =
        prior_belief(states, recogniser.unknown_prior).log_p.tail(states.unknown_size()).array() +
        std::log(options.prior_object);
  }
  h.changed.log_p.segment(states.state(object, 0), states.bins).setConstant(std::log(turned));
  h.changed.log_p[expected] = kNegInf;
  spread_over_seen(states, recogniser.unseen, h.changed);
  if (h.changed.log_p.maxCoeff() == kNegInf) {
    throw ConfigError("prior_pose and prior_object: nothing that the model knows could be there");
  }
  h.log_p_expected = std::log(1.0 - options.prior_pose - options.prior_object);
  h.log_p_changed =
      normalise_log({h.changed.log_p.data(), static_cast<std::size_t>(h.changed.log_p.size())});
  return h;
}

/// Evidence that fits no state of a hypothesis rules the hypothesis out.
void weigh(ObjectBelief& belief, double& log_p, const Eigen::VectorXd& log_likelihood) {
  const EvidenceResult evidence = update(belief, log_likelihood);
  log_p += evidence.log_evidence;
}

/// A camera that remembers what it measured.
class Witness {
 public:
  Witness(const Recogniser& recogniser, const ExtractFeature& extract)
      : recogniser_(recogniser), extract_(extract) {}

  ExtractedFeature operator()(std::size_t feature) {
    ExtractedFeature extracted = extract_(feature);
    looked_ = looked_ || extracted.place_seen;
    if (!extracted.result.extracted()) return extracted;
    if (extracted.log_likelihood.size() == 0) {
      const FeatureResult& result = extracted.result;
      extracted.log_likelihood = weighted(
          log_likelihood(recogniser_.features[feature].prepared, result.vector, result.readings),
          result.weight);
    }
    if (extracted.log_likelihood.maxCoeff() > kNegInf) {
      measured_.push_back(extracted.log_likelihood);
    }
    return extracted;
  }
  [[nodiscard]] const std::vector<Eigen::VectorXd>& measured() const { return measured_; }
  /// For a feature, at where the object is to be.
  [[nodiscard]] bool looked() const { return looked_; }

 private:
  const Recogniser& recogniser_;
  const ExtractFeature& extract_;
  std::vector<Eigen::VectorXd> measured_;
  bool looked_ = false;
};

}  // namespace

std::string_view to_string(Change change) {
  switch (change) {
    case Change::none: return "none";
    case Change::object: return "object";
    case Change::pose: return "pose";
    case Change::removed: return "removed";
  }
  return "";
}

std::optional<Change> change_named(std::string_view name) {
  for (const Change change : kChanges) {
    if (to_string(change) == name) return change;
  }
  return std::nullopt;
}

void ChangeOptions::check() const {
  if (prior_pose + prior_object >= 1.0) {
    throw ConfigError("prior_pose and prior_object: must sum to less than 1");
  }
  if (prior_pose + prior_object == 0.0) {
    throw ConfigError("prior_pose and prior_object: must not both be 0");
  }
  if (unchanged_below > threshold || threshold > changed_above) {
    throw ConfigError("threshold: must lie between unchanged_below and changed_above");
  }
}

double ChangeHypotheses::p_changed() const {
  return 1.0 / (1.0 + std::exp(log_p_expected - log_p_changed));
}

ObjectBelief ChangeHypotheses::mixture() const {
  const double p = p_changed();
  ObjectBelief mixed;
  mixed.log_p = (p * p_state(changed) + (1.0 - p) * p_state(expected)).array().log();
  return mixed;
}

ChangeSearch begin_change_search(const Recogniser& recogniser, const ChangeOptions& options,
                                 int expected_state) {
  check_options(options);
  expects(expected_state >= 0 && expected_state < recogniser.states.known_size(), "a state");
  ChangeSearch search{.expected_object = recogniser.states.object_of(expected_state),
                      .hypotheses = hypotheses(recogniser, options, expected_state),
                      .recognition = {}};
  search.recognition.belief = search.hypotheses.mixture();
  return search;
}

void update_with_view(const Recogniser& recogniser, const ChangeOptions& options,
                      const ExtractFeature& extract, double view_rad, ChangeSearch& search,
                      Rng& rng) {
  Witness witness(recogniser, extract);
  const double weight = next_view_weight(recogniser, search.recognition);
  update_with_view(recogniser, options.recognition, std::ref(witness), view_rad, search.recognition,
                   rng);
  ChangeHypotheses& h = search.hypotheses;
  for (const Eigen::VectorXd& log_likelihood : witness.measured()) {
    const Eigen::VectorXd counted = weighted(log_likelihood, weight);
    weigh(h.expected, h.log_p_expected, counted);
    weigh(h.changed, h.log_p_changed, counted);
  }
  search.recognition.belief = h.mixture();
  if (!witness.measured().empty()) {
    search.empty_views = 0;
  } else if (witness.looked()) {
    ++search.empty_views;
  }
}

void predict_motion(const Recogniser& recogniser, const ChangeOptions& options, double motion_rad,
                    ChangeSearch& search) {
  for (ObjectBelief* belief : {&search.hypotheses.expected, &search.hypotheses.changed}) {
    Recognition turned{.belief = std::move(*belief), .views = {}};
    predict_motion(recogniser, options.recognition, motion_rad, turned);
    *belief = std::move(turned.belief);
  }
  search.recognition.belief = search.hypotheses.mixture();
}

std::optional<ChangeEnd> change_end(const ChangeOptions& options, const ChangeSearch& search) {
  const auto views = static_cast<int>(search.recognition.views.size());
  if (search.empty_views >= options.empty_views) return ChangeEnd::nothing_seen;
  const double p = search.hypotheses.p_changed();
  if (search.empty_views < views && !(p <= options.changed_above)) return ChangeEnd::changed;
  if (search.empty_views < views && p < options.unchanged_below) return ChangeEnd::unchanged;
  if (views >= options.recognition.max_views) return ChangeEnd::max_views;
  return std::nullopt;
}

bool in_doubt(const ChangeOptions& options, const ChangeSearch& search) {
  return !change_end(options, search);
}

Change verdict(const Recogniser& recogniser, const ChangeOptions& options,
               const ChangeSearch& search) {
  const bool nothing_seen =
      search.empty_views > 0 && search.empty_views == std::ssize(search.recognition.views);
  if (nothing_seen || search.empty_views >= options.empty_views) return Change::removed;
  if (search.hypotheses.p_changed() <= options.threshold) return Change::none;
  const double same =
      p_object(recogniser.states, search.hypotheses.changed)[search.expected_object];
  return same >= 0.5 ? Change::pose : Change::object;
}

ChangeReport detect_change(const Recogniser& recogniser, const ChangeOptions& options,
                           int expected_state, const ObjectCamera& camera, Rng& rng) {
  ChangeSearch search = begin_change_search(recogniser, options, expected_state);
  double view_time_s = 0.0;
  for (;;) {
    update_with_view(recogniser, options, camera.extract, camera.bearing_rad(), search, rng);
    search.recognition.views.back().view_time_s = view_time_s;
    const std::vector<ObjectViewAction> actions = camera.actions();
    if (!in_doubt(options, search) || actions.empty()) break;
    const NextView next =
        next_view(recogniser, options.recognition, search.recognition, actions, rng);
    view_time_s = next.time_s;
    const ObjectViewAction& action = actions[next.decision.action];
    camera.turn(action);
    predict_motion(recogniser, options, action.yaw_rad, search);
  }
  const Change change = verdict(recogniser, options, search);
  return {.change = change,
          .p_changed = change == Change::removed ? 1.0 : search.hypotheses.p_changed(),
          .recognition = std::move(search.recognition)};
}

bool distinguishable(const Recogniser& recogniser, int state, int other, double max_error) {
  const ObjectStates& states = recogniser.states;
  std::vector<int> seen;  // the one from every bearing, then the other
  for (const int which : {state, other}) {
    for (int turn = 0; turn < states.bins; ++turn) {
      const int bin = (states.bin_of(which) + turn) % states.bins;
      seen.push_back(states.state(states.object_of(which), bin));
    }
  }
  std::vector<const ObservationModel*> models;
  for (const RecogniserFeature& feature : recogniser.features) {
    models.push_back(&feature.observation);
  }
  const Eigen::MatrixXf nats = state_divergences(Divergence::bhattacharyya, models, seen);
  const double apart_nats =
      static_cast<double>(nats.topRightCorner(states.bins, states.bins).trace());
  return 0.5 * std::exp(-apart_nats) <= max_error;
}

}  // namespace vantage
