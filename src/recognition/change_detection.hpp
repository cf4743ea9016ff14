/// Is the object still what and how the map says?  [Potthast2016, 4.5.8]
///
/// Two hypotheses are followed through all motions: it is as expected, or it is anything else. What
/// the views say of each decides between them: P(u) = 1 - P(expected | views).
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "vantage/recognition/recognition.hpp"

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

/// `options` with all features, what is left out could be what a turn shows in, and views that tell
/// of the pose as well.
inline RecognitionOptions for_changes(RecognitionOptions options = {}) {
  options.all_features = true;
  options.views.about_object = false;
  return options;
}

struct ChangeOptions {
  RecognitionOptions recognition = for_changes();
  double threshold = 0.6;
  double unchanged_below = 0.05;
  double changed_above = 0.95;
  double prior_pose = 0.45;
  double prior_object = 0.05;
  int empty_views = 2;
  void fields(auto&& f) {
    f("recognition", recognition,
      "how features and views are chosen, and how many views are taken at most");
    decision_fields(f);
  }
  /// All but how to look.
  void decision_fields(auto&& f) {
    f("threshold", threshold,
      "probability of a change above which the verdict is that something has changed (tau); higher "
      "reports fewer changes",
      between(0.0, 1.0));
    f("unchanged_below", unchanged_below,
      "probability of a change below which it is sure that nothing has changed; lower takes more "
      "views and finds changes that few views show",
      between(0.0, 1.0));
    f("changed_above", changed_above,
      "probability of a change above which it is sure of one; higher takes more views",
      between(0.0, 1.0));
    f("prior_pose", prior_pose,
      "prior probability that the object was turned; higher finds turns sooner and reports more "
      "that are none",
      between(0.0, 1.0));
    f("prior_object", prior_object,
      "prior probability that it is another object; higher finds exchanges sooner and reports more "
      "that are none",
      between(0.0, 1.0));
    f("empty_views", empty_views,
      "number of views in a row of its place without any feature after which the object is held to "
      "be removed; higher is surer and takes longer",
      between(1, 100));
  }
  /// The priors leave some for a change and some for none; unchanged_below <= threshold <=
  /// changed_above.
  void check() const;
};

struct ChangeReport {
  Change change = Change::none;
  double p_changed = 0.0;   ///< P(u); 1 where it is removed
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
  /// The last so many of those, without any feature; views that do not show the place, or that no
  /// feature was asked of, do not count.
  int empty_views = 0;
};

/// @param expected_state as the camera sees it from where it is at first
/// @throws ConfigError if `options` are out of range.
ChangeSearch begin_change_search(const Recogniser& recogniser, const ChangeOptions& options,
                                 int expected_state);

/// As update_with_view() of a recognition.
void update_with_view(const Recogniser& recogniser, const ChangeOptions& options,
                      const ExtractFeature& extract, double view_rad, ChangeSearch& search,
                      Rng& rng);
/// As predict_motion() of a recognition.
void predict_motion(const Recogniser& recogniser, const ChangeOptions& options, double motion_rad,
                    ChangeSearch& search);
/// Why no further view is taken, if so.
enum class ChangeEnd {
  nothing_seen,  ///< in as many views as it takes to hold the object for removed
  max_views,
  changed,    ///< it is sure of that
  unchanged,  ///< likewise
};
/// None: another view would be worth it.
std::optional<ChangeEnd> change_end(const ChangeOptions& options, const ChangeSearch& search);
/// Whether another view would be worth it: fewer than the most were taken, and it is still open
/// what has changed.
bool in_doubt(const ChangeOptions& options, const ChangeSearch& search);
/// What has changed, if it has to be said now: removed where no view showed anything, else nothing
/// unless P(u) is above tau.
Change verdict(const Recogniser& recogniser, const ChangeOptions& options,
               const ChangeSearch& search);

/// Looks until it is sure either way or there are no views left; then it has changed if P(u) is
/// above tau.
/// @param expected_state as the camera sees it from where it is at first
/// @throws ConfigError if `options` are out of range.
ChangeReport detect_change(const Recogniser& recogniser, const ChangeOptions& options,
                           int expected_state, const ObjectCamera& camera, Rng& rng);

/// Whether two states are distinguishable by the model at all: by all features from every bearing,
/// no more than `max_error` of decisions between the two, each as likely as the other, would be
/// wrong. By Bhattacharyya's bound, 1/2 exp(-sum D): it leaves out what is told apart by a hair,
/// and with it all turns of things that look the same from all sides.
bool distinguishable(const Recogniser& recogniser, int state, int other, double max_error = 0.05);

}  // namespace vantage
