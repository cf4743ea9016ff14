#include "vantage/cli/recognition/recognise_result.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "vantage/perception/dataset_index.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

Json views_json(const Recognition& known) {
  Json views = Json::array();
  for (const ViewReport& view : known.views) {
    Json skipped = Json::array();
    for (const SkippedFeature& s : view.skipped) {
      skipped.push_back({{"feature", s.feature}, {"reason", s.reason}});
    }
    views.push_back({{"view_rad", view.view_rad},
                     {"features", view.features},
                     {"skipped", skipped},
                     {"entropy_bits", view.entropy_bits},
                     {"feature_time_s", view.feature_time_s},
                     {"selection_time_s", view.selection_time_s},
                     {"view_time_s", view.view_time_s}});
  }
  return views;
}

Json objects_json(const ObjectStates& states, const ObjectBelief& belief, int top) {
  const Eigen::VectorXd p = p_object(states, belief);
  std::vector<int> order(static_cast<std::size_t>(p.size()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater{}, [&](int k) { return p[k]; });
  order.resize(std::min(order.size(), static_cast<std::size_t>(top)));
  Json objects = Json::array();
  for (const int k : order) {
    const auto index = static_cast<std::size_t>(k);
    const auto category = static_cast<std::size_t>(states.category_of[index]);
    objects.push_back({{"object", states.objects[index]},
                       {"category", states.categories[category]},
                       {"probability", p[k]},
                       {"yaw_deg", mean_yaw_rad(states, belief, k) / kDegree_rad}});
  }
  return objects;
}

/// What it is held for.
Json estimate_json(const ObjectStates& states, const ObjectBelief& belief) {
  const ObjectEstimate estimate = estimate_of(states, belief);
  return {{"object", estimate.object},
          {"category", estimate.category},
          {"probability", estimate.probability}};
}

Json categories_json(const ObjectStates& states, const ObjectBelief& belief, int top) {
  const Eigen::VectorXd p = p_category(states, belief);
  std::vector<std::size_t> order(static_cast<std::size_t>(p.size()));
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater{},
                           [&](std::size_t c) { return p[static_cast<Eigen::Index>(c)]; });
  order.resize(std::min(order.size(), static_cast<std::size_t>(top)));
  Json categories = Json::array();
  for (const std::size_t c : order) {
    categories.push_back(
        {{"category", states.categories[c]}, {"probability", p[static_cast<Eigen::Index>(c)]}});
  }
  return categories;
}

/// What the view is called that such a turn leads to.
Json next_view_name(const std::optional<PictureNotes>& notes, const Recogniser& recogniser,
                    const Recognition& known, double turn_rad) {
  if (!notes || notes->views.size() != static_cast<std::size_t>(recogniser.states.bins)) {
    return nullptr;
  }
  const ObjectStates& states = recogniser.states;
  const int now = states.bin_of(expected_state(states, known.belief));
  const int next = yaw_bin(now * states.bin_rad() - turn_rad, states.bins);
  const std::string& name = notes->views[static_cast<std::size_t>(next)];
  return name.empty() ? Json(nullptr) : Json(name);
}

/// Where to look next, of the turns by whole bins after which the object rather shows a side that
/// the model knows; null if there is none.
Json next_json(const Recogniser& recogniser, const RecognitionOptions& options,
               const std::optional<PictureNotes>& notes, const Recognition& known, Rng& rng) {
  std::vector<ObjectViewAction> actions;
  const double bin_rad = recogniser.states.bin_rad();
  const double now_rad = known.views.back().view_rad;
  for (int turn = 1; turn < recogniser.states.bins; ++turn) {
    const double turn_rad = turn * bin_rad;
    if (p_unseen_side(recogniser, options, known, turn_rad) > 0.5) continue;
    const bool visited = std::ranges::any_of(known.views, [&](const ViewReport& view) {
      const double off_rad = view.view_rad - now_rad - turn_rad;
      return std::abs(std::remainder(off_rad, 2.0 * std::numbers::pi)) < 0.5 * bin_rad;
    });
    actions.push_back({.yaw_rad = turn_rad, .visited = visited});
  }
  if (actions.empty()) return nullptr;
  const NextView next = next_view(recogniser, options, known, actions, rng);
  const std::size_t best = next.decision.action;
  return {{"turn_deg", actions[best].yaw_rad / kDegree_rad},
          {"view", next_view_name(notes, recogniser, known, actions[best].yaw_rad)},
          {"gain_bits", next.decision.scores[best].gain.bits},
          {"view_time_s", next.time_s}};
}

std::string next_text(const Json& next) {
  if (next.is_null()) return "the model knows no other side to look at";
  const Json& view = next["view"];
  if (view.is_string()) return fmt::format("look next at view {}", view.get<std::string>());
  return fmt::format("look next after a turn by {:.0f} deg", next["turn_deg"].get<double>());
}

}  // namespace

Json recognition_json(const Recogniser& recogniser, const RecognitionOptions& options,
                      const std::optional<PictureNotes>& notes, const Recognition& known, int top,
                      Rng& rng) {
  return {
      {"estimate", estimate_json(recogniser.states, known.belief)},
      {"unknown_probability", p_unknown(recogniser.states, known.belief)},
      {"objects", objects_json(recogniser.states, known.belief, top)},
      {"categories", categories_json(recogniser.states, known.belief, top)},
      {"entropy_bits", known.views.back().entropy_bits},
      {"sure", seen_enough(options.enough, recogniser.states, p_state(known.belief)).has_value()},
      {"views", views_json(known)},
      {"next", next_json(recogniser, options, notes, known, rng)}};
}

void print_recognition(const Json& result) {
  const Json& estimate = result["estimate"];
  fmt::print("{} ({}), {:.2f} %; unknown {:.2f} %\n", estimate["object"].get<std::string>(),
             estimate["category"].get<std::string>(), 100.0 * estimate["probability"].get<double>(),
             100.0 * result["unknown_probability"].get<double>());
  for (const Json& object : result["objects"]) {
    fmt::print("{:6.2f} %  {} ({}), yaw {:.0f} deg\n", 100.0 * object["probability"].get<double>(),
               object["object"].get<std::string>(), object["category"].get<std::string>(),
               object["yaw_deg"].get<double>());
  }
  if (result["categories"].size() > 1) {
    fmt::print("{:6.2f} %  category {}\n",
               100.0 * result["categories"][0]["probability"].get<double>(),
               result["categories"][0]["category"].get<std::string>());
  }
  for (const Json& view : result["views"]) {
    fmt::print("view at {:.0f} deg: {}; entropy {:.3f} bits\n",
               view["view_rad"].get<double>() / kDegree_rad,
               fmt::join(view["features"].get<std::vector<std::string>>(), ", "),
               view["entropy_bits"].get<double>());
  }
  fmt::print("{}; {}\n", result["sure"].get<bool>() ? "sure" : "not sure",
             next_text(result["next"]));
}

}  // namespace vantage
