/// All that recognition has learnt, and the file it is kept in.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "vantage/belief/objects/baum_welch.hpp"
#include "vantage/belief/objects/object_states.hpp"
#include "vantage/belief/objects/unknown_objects.hpp"
#include "vantage/belief/observation/gaussian_statistics.hpp"

namespace vantage {

/// What was learnt for one feature.
struct FeatureModel {
  std::string name;
  GaussianStatistics statistics;  ///< of every state
  double psi = 1.0;               ///< as in ObservationModel
  double cost_s = 0.0;            ///< measured time to extract the feature from one view
  /// Of objects that are none of the states; none: it was not learnt what the feature is of those.
  std::optional<UnknownFactors> unknown = {};
  /// The feature's own trained state (vocabulary, principal components), in its own format.
  std::map<std::string, std::string> blobs;
};

struct RecognitionModel {
  ObjectStates states;
  std::vector<FeatureModel> features;  ///< of different names
  TransitionCounts transitions;        ///< empty: none was learnt
  /// What is to be known of the pictures it was trained on (PictureNotes), if they were imported.
  std::string pictures = {};
  double view_correlation = 0.0;  ///< [0, 1], see view_weight()
};

/// With the feature's name, psi and cost.
/// @throws as the other overload
ObservationModel make_observation_model(const FeatureModel& feature, int bins,
                                        const VarianceEstimate& estimate);

/// Writes the file whole or not at all. Means and deviations are kept in 16 bits, in equal steps
/// over the range that the dimension has among all states, so that training can go on from them.
/// @throws OutputError if the file cannot be written.
void write_recognition_model(const RecognitionModel& model, const std::filesystem::path& path);

/// @throws InputError naming the file and what is wrong with it: missing, not such a file, of
/// another version, cut short, damaged, or with sizes, indices or numbers that make no sense.
/// Nothing is allocated that the file does not hold. Files of version 1 are read as what they are:
/// nothing learnt of unknown objects, and views that do not repeat each other.
RecognitionModel read_recognition_model(const std::filesystem::path& path);

}  // namespace vantage
