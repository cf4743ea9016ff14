#include "src/recognition/change_detection.hpp"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "src/information/log_space.hpp"

namespace vantage {
namespace {

constexpr double kNegInf = -std::numeric_limits<double>::infinity();

/// Beliefs given each hypothesis, and how probable those are.
struct Hypotheses {
  ObjectBelief expected;
  ObjectBelief changed;
  double log_p_expected = 0.0;
  double log_p_changed = 0.0;

  [[nodiscard]] double p_changed() const {
    return 1.0 / (1.0 + std::exp(log_p_expected - log_p_changed));
  }
  /// Whatever the hypothesis.
  [[nodiscard]] ObjectBelief mixture() const {
    const double p = p_changed();
    ObjectBelief mixed;
    mixed.log_p = (p * p_state(changed) + (1.0 - p) * p_state(expected)).array().log();
    return mixed;
  }
};

Hypotheses hypotheses(const ObjectStates& states, const ChangeOptions& options, int expected) {
  const int object = states.object_of(expected);
  const double turned = options.prior_pose / std::max(states.bins - 1, 1);
  const double other = options.prior_object / std::max(states.size() - states.bins, 1);
  Hypotheses h;
  h.expected.log_p = Eigen::VectorXd::Constant(states.size(), kNegInf);
  h.expected.log_p[expected] = 0.0;
  h.changed.log_p = Eigen::VectorXd::Constant(states.size(), std::log(other));
  h.changed.log_p.segment(states.state(object, 0), states.bins).setConstant(std::log(turned));
  h.changed.log_p[expected] = kNegInf;
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
    if (!extracted.result.extracted()) return extracted;
    if (extracted.log_likelihood.size() == 0) {
      extracted.log_likelihood =
          log_likelihood(recogniser_.features[feature].prepared, extracted.result.vector);
    }
    if (extracted.log_likelihood.maxCoeff() > kNegInf) {
      measured_.push_back(extracted.log_likelihood);
    }
    return extracted;
  }
  [[nodiscard]] const std::vector<Eigen::VectorXd>& measured() const { return measured_; }

 private:
  const Recogniser& recogniser_;
  const ExtractFeature& extract_;
  std::vector<Eigen::VectorXd> measured_;
};

/// @return whether there was anything to see.
bool look(const Recogniser& recogniser, const ChangeOptions& options, const ObjectCamera& camera,
          Hypotheses& h, Recognition& recognition, Rng& rng) {
  Witness witness(recogniser, camera.extract);
  take_view(recogniser, options.recognition, std::ref(witness), camera.bearing_rad(), recognition,
            rng);
  for (const Eigen::VectorXd& log_likelihood : witness.measured()) {
    weigh(h.expected, h.log_p_expected, log_likelihood);
    weigh(h.changed, h.log_p_changed, log_likelihood);
  }
  recognition.belief = h.mixture();
  return !witness.measured().empty();
}

void follow(const Recogniser& recogniser, const ChangeOptions& options, double motion_rad,
            Hypotheses& h, Recognition& recognition) {
  for (ObjectBelief* belief : {&h.expected, &h.changed}) {
    Recognition turned{.belief = std::move(*belief), .views = {}};
    moved(recogniser, options.recognition, motion_rad, turned);
    *belief = std::move(turned.belief);
  }
  recognition.belief = h.mixture();
}

Change kind_of_change(const ObjectStates& states, const Hypotheses& h, int expected) {
  const double same = p_object(states, h.changed)[states.object_of(expected)];
  return same >= 0.5 ? Change::pose : Change::object;
}

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

ChangeReport detect_change(const Recogniser& recogniser, const ChangeOptions& options,
                           int expected_state, const ObjectCamera& camera, Rng& rng) {
  check_options(options);
  expects(expected_state >= 0 && expected_state < recogniser.states.size(), "a state");
  Hypotheses h = hypotheses(recogniser.states, options, expected_state);
  ChangeReport report{.recognition = {.belief = h.mixture(), .views = {}}};
  int empty = 0;
  double view_time_s = 0.0;
  for (int view = 1;; ++view) {
    if (!look(recogniser, options, camera, h, report.recognition, rng)) ++empty;
    report.recognition.views.back().view_time_s = view_time_s;
    report.p_changed = h.p_changed();
    if (empty >= options.empty_views) {
      report.change = Change::removed;
      return report;
    }
    const bool uncertain =
        report.p_changed <= options.changed_above && report.p_changed >= options.unchanged_below;
    const bool doubtful = uncertain || empty == view;
    const std::vector<ObjectViewAction> actions = camera.actions();
    if (!doubtful || view >= options.recognition.most_views || actions.empty()) break;
    const NextView next =
        next_view(recogniser, options.recognition, report.recognition, actions, rng);
    view_time_s = next.time_s;
    const ObjectViewAction& action = actions[next.decision.action];
    camera.turn(action);
    follow(recogniser, options, action.yaw_rad, h, report.recognition);
  }
  if (report.p_changed > options.threshold) {
    report.change = kind_of_change(recogniser.states, h, expected_state);
  }
  return report;
}

bool tells_apart(const Recogniser& recogniser, int state, int other, double most_error) {
  const ObjectStates& states = recogniser.states;
  const auto turned = [&](int which, int turn) {
    return states.state(states.object_of(which), (states.bin_of(which) + turn) % states.bins);
  };
  double nats = 0.0;
  for (int turn = 0; turn < states.bins; ++turn) {
    nats += static_cast<double>(
        recogniser.tables.bhattacharyya_nats(turned(state, turn), turned(other, turn)));
  }
  return 0.5 * std::exp(-nats) <= most_error;
}

}  // namespace vantage
