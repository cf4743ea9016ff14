#include "vantage/perception/features/feature.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "vantage/core/hash.hpp"
#include "vantage/information/quantile.hpp"
#include "vantage/perception/features/kit/darkness.hpp"

namespace vantage {
namespace {

constexpr std::string_view kMagic = "vantage feature 1\n";
constexpr std::size_t kTimedViews = 9;

template <class State>
std::string_view name_of(const State& state) {
  if constexpr (requires { state.feature_name(); }) {
    return state.feature_name();
  } else {
    return State::name;
  }
}

/// Whether it goes by depth alone, and so in any light.
template <class State>
bool goes_by_depth(const State&) {
  return std::is_same_v<State, BoundingBox> || std::is_same_v<State, StandingBox> ||
         std::is_same_v<State, Vfh>;
}

bool goes_by_depth(const TrainedKernelDescriptor& state) {
  constexpr auto kByDepth = std::to_array(
      {PatchKind::depth_gradient, PatchKind::depth_lbp, PatchKind::normal_spin, PatchKind::size});
  return std::ranges::any_of(
      kByDepth, [&](PatchKind kind) { return row_of(kind).name == state.feature_name(); });
}

double median_cost_s(const TrainedFeature& feature, std::span<const ObjectView> views) {
  std::vector<double> costs_s;
  for (const ObjectView& view : views) {
    if (costs_s.size() == kTimedViews) break;
    const auto start = std::chrono::steady_clock::now();
    const bool extracted = feature.extract(view).extracted();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    if (extracted) costs_s.push_back(taken.count());
  }
  if (costs_s.empty()) return 0.0;
  return quantile(std::move(costs_s), 0.5);
}

TrainedFeature::State take_state(std::string_view name, ByteReader& reader) {
  std::optional<TrainedFeature::State> state;
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (void)((std::variant_alternative_t<I, Feature>::name == name
                ? (state.emplace(std::variant_alternative_t<I, Feature>::take_state(reader)), true)
                : false) ||
           ...);
  }
  (std::make_index_sequence<std::variant_size_v<Feature>>{});
  if (!state) {
    reader.fail(unknown_strategy(strategy_family<Feature>, name, strategy_names<Feature>()));
  }
  return std::move(*state);
}

}  // namespace

std::string_view TrainedFeature::name() const {
  return std::visit([](const auto& state) { return name_of(state); }, *state_);
}

int TrainedFeature::dimension() const {
  return std::visit([](const auto& state) { return state.dimension(); }, *state_);
}

FeatureResult TrainedFeature::extract(const ObjectView& view) const {
  FeatureResult result = std::visit(
      [&](const auto& state) {
        if (goes_by_depth(state)) return state.extract(view);
        std::string dark = lacks_light(view);
        return dark.empty() ? state.extract(view) : FeatureResult::skip(std::move(dark));
      },
      *state_);
  if (result.extracted() && !result.vector.allFinite()) {
    return FeatureResult::skip("the vector has entries that are not finite");
  }
  // Readings tell by themselves what a part of the object leaves open.
  if (result.readings.empty()) result.weight = view.seen_share;
  return result;
}

TrainedFeature TrainedFeature::with_cost_s(double cost_s) const {
  TrainedFeature other = *this;
  other.cost_s_ = cost_s;
  return other;
}

std::uint64_t TrainedFeature::state_hash() const {
  std::string bytes(name());
  std::visit([&](const auto& state) { state.put_state(bytes); }, *state_);
  return hash_bytes(bytes);
}

std::string TrainedFeature::to_bytes() const {
  std::string bytes(kMagic);
  put_text(bytes, name());
  put(bytes, cost_s_);
  std::visit([&](const auto& state) { state.put_state(bytes); }, *state_);
  return bytes;
}

TrainedFeature TrainedFeature::from_bytes(std::string_view bytes, const std::string& source) {
  if (!bytes.starts_with(kMagic)) throw InputError(source + ": not a trained feature");
  bytes.remove_prefix(kMagic.size());
  ByteReader reader(bytes, source);
  const std::string name = reader.text("the name");
  const auto cost_s = reader.number<double>("the cost");
  if (!(cost_s >= 0.0) || !std::isfinite(cost_s)) reader.fail("holds a cost that is no time");
  TrainedFeature feature(take_state(name, reader), cost_s);
  reader.finish();
  return feature;
}

TrainedFeature train_feature(const Feature& feature, std::span<const ObjectView> views, Rng& rng) {
  TrainedFeature::State state = std::visit(
      [&](const auto& options) -> TrainedFeature::State {
        check_options(options, std::string(options.name));
        return options.train(views, rng);
      },
      feature);
  const double cost_s = median_cost_s(TrainedFeature(state, 0.0), views);
  return {std::move(state), cost_s};
}

}  // namespace vantage
