/// The belief over objects and their yaw: a forward filter in log space, and what it says.
/// [Potthast2016, (4.3)-(4.6)]
#pragma once

#include <Eigen/Core>

#include <span>
#include <string>

#include "vantage/belief/objects/object_states.hpp"
#include "vantage/belief/objects/transition.hpp"

namespace vantage {

/// ln p(state | all so far), normalised; -inf for probability zero.
struct ObjectBelief {
  Eigen::VectorXd log_p;
};

/// What an update did, or why it could not.
struct EvidenceResult {
  double log_evidence = 0.0;  ///< ln p(feature | all before)
  std::string reason;         ///< why the belief was left as it was; empty if it was updated
  [[nodiscard]] bool used() const { return reason.empty(); }
};

/// Every state alike. @param states at least one
ObjectBelief uniform_belief(const ObjectStates& states);

/// Every object as probable as the other, in every yaw bin, and together 1 - `p_unknown`; of what
/// is unknown half is of no category, half of any of those that have a hypothesis, each alike.
/// Uniform if there is no hypothesis of unknown objects, whatever `p_unknown` is.
/// @param p_unknown in [0, 1)
ObjectBelief prior_belief(const ObjectStates& states, double p_unknown);

/// Within each object, the probability of the states `unseen` goes to its others, in proportion. An
/// object that nothing would be left of keeps its own.
void spread_over_seen(const ObjectStates& states, std::span<const int> unseen,
                      ObjectBelief& belief);

/// The camera moved, nobody knows how far: each known object's yaw may be any of those that are not
/// `unseen`. What is unknown has none.
void forget_yaw(const ObjectStates& states, std::span<const int> unseen, ObjectBelief& belief);

/// After a motion: ln p(j) <- LSE_i [ln p(i) + ln A_ij(motion)]. No motion changes nothing. What is
/// unknown has no yaw and remains unknown.
void predict(ObjectBelief& belief, const ObjectStates& states, const TransitionModel& transition,
             double motion_rad);

/// Bayes: ln p(j) <- ln p(j) + ln p(feature | j), normalised. A likelihood that is NaN or +inf, or
/// zero wherever the belief is not, leaves the belief as it was, and the result says so.
/// @param log_likelihood of every state; -inf for zero
EvidenceResult update(ObjectBelief& belief,
                      const Eigen::Ref<const Eigen::VectorXd>& log_likelihood);

/// p(state).
Eigen::VectorXd p_state(const ObjectBelief& belief);
/// p(object) of every object of the database, summed over its bins; 1 - p_unknown() together.
Eigen::VectorXd p_object(const ObjectStates& states, const ObjectBelief& belief);
/// p(category), summed over its objects and the unknown ones that are of it.
Eigen::VectorXd p_category(const ObjectStates& states, const ObjectBelief& belief);
/// That it is none of the objects; 0 without such a hypothesis.
double p_unknown(const ObjectStates& states, const ObjectBelief& belief);
/// More probable than not.
bool is_unknown(const ObjectStates& states, const ObjectBelief& belief);
/// Of an unknown object, the most probable category or kNoCategory.
int unknown_category(const ObjectStates& states, const ObjectBelief& belief);
/// What it is held to be.
struct ObjectEstimate {
  std::string object;        ///< the most probable one of the database, or kUnknown if is_unknown()
  std::string category;      ///< of that; of an unknown object the most probable one, or kUnknown
  double probability = 0.0;  ///< of that object, whatever its yaw, or of all that is unknown
};
ObjectEstimate estimate_of(const ObjectStates& states, const ObjectBelief& belief);

double state_entropy_bits(const ObjectBelief& belief);
/// What is unknown counts as one more object.
double object_entropy_bits(const ObjectStates& states, const ObjectBelief& belief);

/// The maximum a posteriori; of equal ones the first.
int most_probable_state(const ObjectBelief& belief);
/// Of the marginal, so not always the object of the most probable state; of equal ones the first.
/// One of the database, however probable it is that it is unknown.
int most_probable_object(const ObjectStates& states, const ObjectBelief& belief);

/// Direction of the mean of the unit vectors to an object's bins, weighted by p(bin | object), in
/// [0, 2 pi). Between bins where the belief is; 0 if the object is impossible or all bins alike.
double mean_yaw_rad(const ObjectStates& states, const ObjectBelief& belief, int object);

/// The most probable object, in the bin nearest to its mean yaw.
int expected_state(const ObjectStates& states, const ObjectBelief& belief);

/// How many bins apart two states are, whatever their objects, the short way round: 0 .. bins / 2.
int bin_error(const ObjectStates& states, int state, int other);

}  // namespace vantage
