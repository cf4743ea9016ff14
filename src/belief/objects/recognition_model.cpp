#include "vantage/belief/objects/recognition_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "vantage/belief/observation/packed_statistics.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/hash.hpp"

namespace vantage {
namespace {

constexpr std::string_view kMagic = "vantage recognition model\n";
constexpr std::uint32_t kVersion = 2;
constexpr std::uint32_t kVersionWithoutUnknown = 1;
constexpr int kMinBins = 2;  ///< fewer leave no turn that shows another side
constexpr int kMaxBins = 3600;
constexpr std::size_t kMaxStates = 10'000'000;

std::string repeated(std::string_view what, const std::string& name) {
  return fmt::format("{} '{}' appears twice", what, name);
}

void put_states(std::string& bytes, const ObjectStates& states) {
  put(bytes, static_cast<std::int32_t>(states.bins));
  put(bytes, static_cast<std::uint32_t>(states.categories.size()));
  for (const std::string& category : states.categories) put_text(bytes, category);
  put(bytes, static_cast<std::uint32_t>(states.objects.size()));
  for (std::size_t k = 0; k < states.objects.size(); ++k) {
    put_text(bytes, states.objects[k]);
    put(bytes, static_cast<std::int32_t>(states.category_of[k]));
  }
}

std::vector<std::string> take_categories(ByteReader& reader) {
  std::vector<std::string> categories;
  std::set<std::string> known;
  const std::size_t count = reader.count(sizeof(std::uint32_t), "the categories");
  for (std::size_t c = 0; c < count; ++c) {
    categories.push_back(reader.text("the categories"));
    reader.require(known.insert(categories.back()).second, repeated("category", categories.back()));
  }
  return categories;
}

ObjectStates take_states(ByteReader& reader) {
  ObjectStates states;
  states.bins = reader.number<std::int32_t>("the number of bins");
  reader.require(states.bins >= kMinBins && states.bins <= kMaxBins,
                 fmt::format("{} yaw bins, must be in [{}, {}]", states.bins, kMinBins, kMaxBins));
  states.categories = take_categories(reader);
  const std::size_t objects = reader.count(2 * sizeof(std::uint32_t), "the objects");
  reader.require(objects * static_cast<std::size_t>(states.bins) <= kMaxStates,
                 fmt::format("{} objects of {} bins are too many", objects, states.bins));
  std::set<std::string> known;
  for (std::size_t k = 0; k < objects; ++k) {
    states.objects.push_back(reader.text("the objects"));
    const std::string& name = states.objects.back();
    reader.require(known.insert(name).second, repeated("object", name));
    const int category = reader.number<std::int32_t>("the objects");
    reader.require(category >= 0 && static_cast<std::size_t>(category) < states.categories.size(),
                   fmt::format("object '{}' is of category {}, of {}", name, category,
                               states.categories.size()));
    states.category_of.push_back(category);
  }
  return states;
}

void put_feature(std::string& bytes, const FeatureModel& feature) {
  put_text(bytes, feature.name);
  put(bytes, feature.psi);
  put(bytes, feature.cost_s);
  put(bytes, static_cast<std::uint8_t>(feature.unknown ? 1 : 0));
  if (feature.unknown) {
    put(bytes, feature.unknown->instance);
    put(bytes, feature.unknown->category);
  }
  put(bytes, static_cast<std::uint32_t>(feature.blobs.size()));
  for (const auto& [name, blob] : feature.blobs) {
    put_text(bytes, name);
    put_text(bytes, blob);
  }
  put_packed(bytes, feature.statistics);
}

double take_non_negative(ByteReader& reader, std::string_view what) {
  const auto value = reader.number<double>(what);
  reader.require(std::isfinite(value) && value >= 0.0,
                 fmt::format("{} is {}, must be a finite number >= 0", what, value));
  return value;
}

std::optional<UnknownFactors> take_unknown(ByteReader& reader, const std::string& feature) {
  const std::string what = "what is unknown of feature " + feature;
  const auto learnt = reader.number<std::uint8_t>(what);
  reader.require(learnt <= 1, fmt::format("{} is marked {}, must be 0 or 1", what, learnt));
  if (learnt == 0) return std::nullopt;
  UnknownFactors factors;
  for (double* factor : {&factors.instance, &factors.category}) {
    *factor = reader.number<double>(what);
    reader.require(std::isfinite(*factor), what + " is not finite");
  }
  return factors;
}

double take_view_correlation(ByteReader& reader) {
  const auto value = reader.number<double>("the correlation of views");
  reader.require(value >= 0.0 && value <= 1.0,
                 fmt::format("the correlation of views is {}, must be in [0, 1]", value));
  return value;
}

FeatureModel take_feature(ByteReader& reader, int states, std::uint32_t version) {
  FeatureModel feature;
  feature.name = reader.text("a feature's name");
  feature.psi = take_non_negative(reader, "psi of feature " + feature.name);
  feature.cost_s = take_non_negative(reader, "cost_s of feature " + feature.name);
  if (version > kVersionWithoutUnknown) feature.unknown = take_unknown(reader, feature.name);
  const std::size_t blobs = reader.count(2 * sizeof(std::uint32_t), "a feature's blobs");
  for (std::size_t i = 0; i < blobs; ++i) {
    const std::string name = reader.text("a blob's name");
    reader.require(feature.blobs.emplace(name, reader.text("blob " + name)).second,
                   repeated("blob", name));
  }
  feature.statistics = take_packed(reader, states);
  return feature;
}

void put_transitions(std::string& bytes, const TransitionCounts& counts) {
  put(bytes, static_cast<std::uint32_t>(counts.slip.size()));
  for (const double count : counts.slip.reshaped()) put(bytes, count);
  for (const double count : {counts.same_object, counts.other_instance, counts.other_category}) {
    put(bytes, count);
  }
}

TransitionCounts take_transitions(ByteReader& reader, int bins) {
  constexpr std::string_view kWhat = "the counts of transitions";
  TransitionCounts counts;
  const std::size_t slips = reader.count(sizeof(double), kWhat);
  const auto size = static_cast<std::size_t>(bins);
  reader.require(slips == 0 || slips == size * size,
                 fmt::format("{} counts of slips, {} bins need {}", slips, bins, size * size));
  if (slips > 0) counts.slip.resize(bins, bins);
  for (double& count : counts.slip.reshaped()) count = take_non_negative(reader, kWhat);
  counts.same_object = take_non_negative(reader, kWhat);
  counts.other_instance = take_non_negative(reader, kWhat);
  counts.other_category = take_non_negative(reader, kWhat);
  return counts;
}

struct Payload {
  std::uint32_t version = kVersion;
  std::string_view bytes;
};

/// What follows the header, once it is known to be what was written.
Payload checked_payload(ByteReader& reader) {
  reader.require(reader.left() > 0, "is empty");
  const bool ours = reader.left() >= kMagic.size() && reader.block(kMagic.size(), "") == kMagic;
  reader.require(ours, "is not a recognition model");
  const auto version = reader.number<std::uint32_t>("the header");
  reader.require(version == kVersion || version == kVersionWithoutUnknown,
                 fmt::format("is of version {}, this program reads {} and {}", version,
                             kVersionWithoutUnknown, kVersion));
  const auto size = reader.number<std::uint64_t>("the header");
  const auto hash = reader.number<std::uint64_t>("the header");
  reader.require(size == reader.left(),
                 fmt::format("holds {} bytes after its header, should be {}", reader.left(), size));
  const std::string_view payload = reader.block(reader.left(), "");
  reader.require(hash_bytes(payload) == hash, "is damaged: its hash is not the one written");
  return {version, payload};
}

}  // namespace

ObservationModel make_observation_model(const FeatureModel& feature, int bins,
                                        const VarianceEstimate& estimate) {
  ObservationModel model = make_observation_model(feature.statistics, bins, estimate);
  model.feature = feature.name;
  model.psi = feature.psi;
  model.cost_s = feature.cost_s;
  return model;
}

void write_recognition_model(const RecognitionModel& model, const std::filesystem::path& path) {
  std::string payload;
  put_states(payload, model.states);
  put_transitions(payload, model.transitions);
  put(payload, model.view_correlation);
  put(payload, static_cast<std::uint32_t>(model.features.size()));
  for (const FeatureModel& feature : model.features) {
    expects(feature.statistics.states() == model.states.size(), "statistics of every state");
    put_feature(payload, feature);
  }
  if (!model.pictures.empty()) put_text(payload, model.pictures);
  std::string bytes(kMagic);
  put(bytes, kVersion);
  put(bytes, static_cast<std::uint64_t>(payload.size()));
  put(bytes, hash_bytes(payload));
  write_file(path, bytes + payload);
}

RecognitionModel read_recognition_model(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  ByteReader whole(bytes, path.string());
  const Payload payload = checked_payload(whole);
  ByteReader reader(payload.bytes, path.string());
  RecognitionModel model;
  model.states = take_states(reader);
  model.transitions = take_transitions(reader, model.states.bins);
  if (payload.version > kVersionWithoutUnknown) {
    model.view_correlation = take_view_correlation(reader);
  }
  std::set<std::string> known;
  const std::size_t features = reader.count(sizeof(std::uint32_t), "the features");
  for (std::size_t f = 0; f < features; ++f) {
    model.features.push_back(take_feature(reader, model.states.size(), payload.version));
    const std::string& name = model.features.back().name;
    reader.require(known.insert(name).second, repeated("feature", name));
  }
  if (reader.left() > 0) model.pictures = reader.text("the notes on pictures");
  reader.finish();
  return model;
}

}  // namespace vantage
