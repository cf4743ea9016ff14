#include "vantage/recognition/dataset/shown_states.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

namespace vantage {
namespace {

/// The category's index; a new one is appended.
int category_index(ObjectStates& states, const std::string& category) {
  const auto found = std::ranges::find(states.categories, category);
  const auto index = static_cast<int>(found - states.categories.begin());
  if (found == states.categories.end()) states.categories.push_back(category);
  return index;
}

}  // namespace

ObjectStates states_of(std::span<const ViewEntry> views, int bins) {
  ObjectStates states;
  states.bins = bins;
  std::map<std::string, int> known;
  for (const ViewEntry& view : views) {
    if (!known.emplace(view.name.object, 0).second) continue;
    states.objects.push_back(view.name.object);
    states.category_of.push_back(category_index(states, view.name.category));
  }
  return states;
}

void add_objects(ObjectStates& states, const ObjectStates& added) {
  expects(states.bins == added.bins, "objects of one database have the same bins");
  for (std::size_t k = 0; k < added.objects.size(); ++k) {
    if (std::ranges::find(states.objects, added.objects[k]) != states.objects.end()) {
      throw InputError(fmt::format("the model knows object '{}' already", added.objects[k]));
    }
    const auto category = static_cast<std::size_t>(added.category_of[k]);
    states.category_of.push_back(category_index(states, added.categories[category]));
    states.objects.push_back(added.objects[k]);
  }
}

std::vector<int> states_shown_if_known(std::span<const ViewFeatures> views,
                                       const ObjectStates& states) {
  std::map<std::string, int> index;
  for (int k = 0; k < states.object_count(); ++k) {
    index.emplace(states.objects[static_cast<std::size_t>(k)], k);
  }
  std::vector<int> shown;
  for (const ViewFeatures& view : views) {
    const auto found = index.find(view.name.object);
    const bool known = found != index.end();
    shown.push_back(known ? states.state(found->second, yaw_bin(view.yaw_rad, states.bins)) : -1);
  }
  return shown;
}

std::vector<int> states_shown(std::span<const ViewFeatures> views, const ObjectStates& states) {
  std::vector<int> shown = states_shown_if_known(views, states);
  const auto unknown = std::ranges::find(shown, -1);
  if (unknown != shown.end()) {
    const auto view = static_cast<std::size_t>(unknown - shown.begin());
    throw InputError(fmt::format("the model does not know object '{}'", views[view].name.object));
  }
  return shown;
}

void add_views(GaussianStatistics& statistics, std::span<const ViewFeatures> views,
               std::span<const int> shown, std::size_t feature) {
  for (std::size_t i = 0; i < views.size(); ++i) {
    const FeatureResult& result = views[i].features[feature];
    if (result.extracted()) add_view(statistics, shown[i], result.vector);
  }
}

}  // namespace vantage
