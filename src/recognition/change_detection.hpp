/// Is the object still what and how the map says?  [Potthast2016, 4.5.8]
///
/// Two hypotheses are followed through all motions: it is as expected, or it is anything else. What
/// the views say of each decides between them: P(u) = 1 - P(expected | views).
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "src/recognition/recognition.hpp"

namespace vantage {

enum class Change {
  none,
  object,   ///< another object
  pose,     ///< the same one, turned into another yaw bin
  removed,  ///< nothing is there
};
inline constexpr auto kChanges =
    std::to_array({Change::none, Change::object, Change::pose, Change::removed});
std::string_view to_string(Change change);
std::optional<Change> change_named(std::string_view name);

struct ChangeOptions {
  RecognitionOptions recognition;  ///< how features and views are chosen, and how many at most
  double threshold = 0.6;          ///< tau: changed if P(u) is above; higher looks more often
  double unchanged_below = 0.4;    ///< if P(u) is below, nothing has; lower looks more often, and
                                   ///< finds small changes that a single view does not show
  double prior_pose = 0.25;  ///< that it was turned; higher finds turns sooner, falsely more often
  double prior_object = 0.25;  ///< that it is another object; likewise
  int empty_views = 2;         ///< without any feature, until it is held to be removed
  void fields(auto&& f) {
    f("recognition", recognition);
    decision_fields(f);
  }
  /// All but how to look.
  void decision_fields(auto&& f) {
    f("threshold", threshold, between(0.0, 1.0));
    f("unchanged_below", unchanged_below, between(0.0, 1.0));
    f("prior_pose", prior_pose, between(0.0, 1.0));
    f("prior_object", prior_object, between(0.0, 1.0));
    f("empty_views", empty_views, between(1, 100));
  }
  void check() const;  ///< the priors leave some for a change and some for none; unchanged_below <=
                       ///< threshold
};

struct ChangeReport {
  Change change = Change::none;
  double p_changed = 0.0;   ///< P(u)
  Recognition recognition;  ///< of what is there now: belief under both hypotheses, and the views
};

/// Two hypotheses: it is as expected, or it is anything else. Beliefs given each, and how probable
/// each is.
struct ChangeHypotheses {
  ObjectBelief expected;
  ObjectBelief changed;
  double log_p_expected = 0.0;
  double log_p_changed = 0.0;

  [[nodiscard]] double p_changed() const;      ///< P(u)
  [[nodiscard]] ObjectBelief mixture() const;  ///< whatever the hypothesis
};

/// What is known so far.
struct ChangeSearch {
  int expected_object = 0;
  ChangeHypotheses hypotheses;
  Recognition recognition;  ///< of what is there now: belief under both, and the views
  int empty_views = 0;      ///< of those, without any feature
};

/// @param expected_state as the camera sees it from where it is at first
/// @throws ConfigError if `options` are out of range.
ChangeSearch begin_change_search(const Recogniser& recogniser, const ChangeOptions& options,
                                 int expected_state);

/// As take_view() of a recognition.
void take_view(const Recogniser& recogniser, const ChangeOptions& options,
               const ExtractFeature& extract, double view_rad, ChangeSearch& search, Rng& rng);
/// As moved() of a recognition.
void moved(const Recogniser& recogniser, const ChangeOptions& options, double motion_rad,
           ChangeSearch& search);
/// Whether another view would be worth it: fewer than the most were taken, and it is still open
/// what has changed.
bool in_doubt(const ChangeOptions& options, const ChangeSearch& search);
/// What has changed, if it has to be said now; if P(u) is between the thresholds, nothing.
Change verdict(const Recogniser& recogniser, const ChangeOptions& options,
               const ChangeSearch& search);

/// Looks until P(u) is above the one threshold or below the other, or there are no views left; if
/// it is still between then, nothing has changed.
/// @param expected_state as the camera sees it from where it is at first
/// @throws ConfigError if `options` are out of range.
ChangeReport detect_change(const Recogniser& recogniser, const ChangeOptions& options,
                           int expected_state, const ObjectCamera& camera, Rng& rng);

}  // namespace vantage
