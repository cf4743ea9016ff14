/// What unknown objects look like, learnt by holding known ones for unknown.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "vantage/belief/objects/object_states.hpp"
#include "vantage/belief/objects/unknown_objects.hpp"
#include "vantage/recognition/dataset/held_out.hpp"

namespace vantage {

/// Each view held out is shown three times: as it is, with its object and its near-duplicates left
/// out of what is known, and with its whole category left out. The factors of a feature are those
/// with which what it shows is most likely: a known object, another one of its category, one of no
/// category; the first as probable as the others together. The mean log posterior is concave in
/// both, so that there is one answer. Nothing is trained anew: leaving an object out is leaving its
/// states out, and the background is that of the others.
/// @param psi of each feature
/// @return factors of each feature; none if fewer than three objects are known or nothing was held
/// out. Where there are no views of one kind of unknown objects, both have one factor.
std::vector<std::optional<UnknownFactors>> calibrate_unknown(const Calibration& calibration,
                                                             std::span<const ViewFeatures> views,
                                                             const ObjectStates& states,
                                                             std::span<const double> psi,
                                                             const LongWork& how);

/// How likely a view is by each kind of hypothesis, in tempered nats, factors left out.
struct ShownView {
  enum class Kind { known, instance, category };
  Kind kind = Kind::known;  ///< what it shows
  double known = 0.0;       ///< mean over the known states
  double instance = 0.0;    ///< mean over the categories; -inf: there is no such hypothesis
  double category = 0.0;
};

/// ln of the factors, tempered, with which what the views show is most likely.
/// @param shown some known ones and some unknown ones
UnknownFactors most_likely_factors(std::span<const ShownView> shown);

}  // namespace vantage
