#include "python/recognition/active_recogniser.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "python/kit/arrays.hpp"
#include "python/kit/calls.hpp"
#include "python/kit/options.hpp"
#include "vantage/perception/object_cut.hpp"
#include "vantage/recognition/lean_recogniser.hpp"

namespace vantage::python {
namespace {

/// The whole picture, without a mask.
ObjectView picture_of(const Colours& rgb, const Depths& depth, const CameraArguments& camera) {
  constexpr py::ssize_t kLargest_px = 8192;
  const bool fits = rgb.ndim() == 3 && rgb.shape(2) == 3 && depth.ndim() == 2 &&
                    depth.shape(0) == rgb.shape(0) && depth.shape(1) == rgb.shape(1);
  if (!fits || rgb.shape(0) > kLargest_px || rgb.shape(1) > kLargest_px || rgb.size() == 0) {
    refuse("rgb, depth", fmt::format("shapes {} and {} are not (h, w, 3) and (h, w), up to {} px",
                                     shape_text(rgb), shape_text(depth), kLargest_px));
  }
  if (!(camera.focal_px >= 10.0 && camera.focal_px <= 1e5)) refuse("focal_px", "not in [10, 1e5]");
  if (!(std::abs(camera.elevation_rad) <= 1.58)) refuse("elevation_rad", "not in [-1.58, 1.58]");
  ObjectView view;
  view.height_px = static_cast<int>(rgb.shape(0));
  view.width_px = static_cast<int>(rgb.shape(1));
  view.rgb.assign(rgb.data(), rgb.data() + rgb.size());
  view.depth_m.assign(depth.data(), depth.data() + depth.size());
  for (float& d : view.depth_m) {
    if (!(d > 0.0F && d < 1e4F)) d = 0.0F;  // no measurement
  }
  view.focal_px = camera.focal_px;
  view.up = up_in_camera(camera.elevation_rad);
  if (camera.centre_px) {
    if (!(camera.centre_px->cwiseAbs().maxCoeff() < 1e5)) refuse("centre_px", "not finite");
    view.centre_px = *camera.centre_px;
  } else {
    view.left_px = static_cast<int>(view.centre_px.x()) - view.width_px / 2;
    view.top_px = static_cast<int>(view.centre_px.y()) - view.height_px / 2;
  }
  return view;
}

ObjectView object_of_picture(const ObjectView& picture, const std::optional<Mask>& mask) {
  ObjectView view;
  if (mask) {
    const bool fits = mask->ndim() == 2 && mask->shape(0) == picture.height_px &&
                      mask->shape(1) == picture.width_px;
    if (!fits) refuse("mask", "shape " + shape_text(*mask) + " is not that of the picture");
    const std::vector<std::uint8_t> flags(mask->data(), mask->data() + mask->size());
    if (std::ranges::count(flags, 1) == 0) refuse("mask", "empty");
    view = crop_to_mask(picture, flags);
  } else {
    CutObject cut = cut_by_depth(picture);
    if (!cut.view) refuse("depth", "no object can be told from what is round it: " + cut.reason);
    view = std::move(*cut.view);
  }
  constexpr int kLeast_px = 8;
  if (std::min(view.width_px, view.height_px) < kLeast_px) {
    refuse("mask", fmt::format("the object is {} x {} px; at least 8 x 8 are needed", view.width_px,
                               view.height_px));
  }
  return view;
}

void require_turn(double turn_rad, const char* argument) {
  if (!(std::abs(turn_rad) < 1e3)) refuse(argument, fmt::format("{} is no turn", turn_rad));
}

/// The views are there: nothing is won by leaving out what they show.
RecognitionOptions every_feature() {
  RecognitionOptions options;
  options.all_features = true;
  return options;
}

}  // namespace

ActiveRecogniser::ActiveRecogniser(const std::filesystem::path& model, std::uint64_t seed,
                                   const py::object& recogniser, const py::object& recognition)
    : options_(options_of<RecognitionOptions>(recognition, "recognition", every_feature())),
      rng_(Rng::stream(seed, "recognise")) {
  require_no_weights(options_.views, "recognition.views");
  const auto wanted = options_of<RecogniserOptions>(recogniser, "recogniser");
  recogniser_ = without_lock([&] { return load_lean_recogniser(model, wanted); });
  known_ = begin_recognition(recogniser_);
}

py::dict ActiveRecogniser::update(const Colours& rgb, const Depths& depth,
                                  const std::optional<Mask>& mask, double turned_rad,
                                  const CameraArguments& camera) {
  require_turn(turned_rad, "turned_rad");
  const ObjectView picture = picture_of(rgb, depth, camera);
  const ObjectView view = object_of_picture(picture, mask);
  // Without the lock others may read or change what is known, so that a copy is worked with.
  Recognition next = known_;
  Rng rng = rng_;
  without_lock([&] {
    predict_motion(recogniser_, options_, turned_rad, next);
    const double bearing_rad = turned_rad + (next.views.empty() ? 0.0 : next.views.back().view_rad);
    update_with_view(recogniser_, options_, extract_from(recogniser_, view), bearing_rad, next,
                     rng);
  });
  known_ = std::move(next);
  rng_ = rng;
  return last_view();
}

py::array_t<double> ActiveRecogniser::posterior() const {
  const Eigen::VectorXd p = p_state(known_.belief);
  const ObjectStates& states = recogniser_.states;
  return array_of(std::vector<double>(p.data(), p.data() + states.known_size()),
                  {states.object_count(), states.bins});
}

py::dict ActiveRecogniser::estimate() const {
  const ObjectEstimate found = estimate_of(recogniser_.states, known_.belief);
  return py::dict(py::arg("object") = found.object, py::arg("category") = found.category,
                  py::arg("probability") = found.probability);
}

std::vector<std::string> ActiveRecogniser::features() const {
  std::vector<std::string> names;
  for (const auto& feature : recogniser_.features) names.push_back(feature.observation.feature);
  return names;
}

/// The feature that is expected to tell most, with what each is expected to tell.
py::dict ActiveRecogniser::next_feature(const std::vector<std::string>& extracted) {
  std::vector<FeatureOption> options;
  for (const RecogniserFeature& feature : recogniser_.features) {
    const bool done = std::ranges::count(extracted, feature.observation.feature) > 0;
    options.push_back({.model = &feature.observation, .tables = nullptr, .extracted = done});
  }
  const Eigen::VectorXd belief = p_state(known_.belief);
  const double weight = next_view_weight(recogniser_, known_);
  Rng rng = rng_;
  const FeatureDecision decision = without_lock([&] {
    return choose_feature(options_.features,
                          {.database = recogniser_.states,
                           .belief = belief,
                           .features = options,
                           .last_score = {},
                           .weight = weight},
                          rng);
  });
  rng_ = rng;
  py::dict gains;
  for (const FeatureScore& score : decision.scores) {
    gains[py::str(recogniser_.features[score.feature].observation.feature)] = score.gain.bits;
  }
  py::object name = py::none();
  if (decision.feature) name = py::str(recogniser_.features[*decision.feature].observation.feature);
  return py::dict(py::arg("feature") = name, py::arg("gain_bits") = gains);
}

py::dict ActiveRecogniser::next_view(const std::optional<std::vector<double>>& turns) {
  std::vector<double> turns_rad = turns.value_or(std::vector<double>{});
  const double bin_rad = recogniser_.states.bin_rad();
  for (int i = 1; !turns && i < recogniser_.states.bins; ++i) {
    if (p_unseen_side(recogniser_, options_, known_, i * bin_rad) <= 0.5) {
      turns_rad.push_back(i * bin_rad);
    }
  }
  if (!turns && turns_rad.empty()) refuse("turns_rad", "the model knows no other side to look at");
  if (turns_rad.empty() || turns_rad.size() > 3600) refuse("turns_rad", "not 1 to 3600 of them");
  std::vector<ObjectViewAction> actions;
  for (const double turn : turns_rad) {
    require_turn(turn, "turns_rad");
    actions.push_back({.yaw_rad = turn, .visited = was_visited(turn)});
  }
  const Recognition known = known_;
  Rng rng = rng_;
  const NextView next =
      without_lock([&] { return vantage::next_view(recogniser_, options_, known, actions, rng); });
  rng_ = rng;
  std::vector<double> gains;
  for (const ObjectViewScore& score : next.decision.scores) gains.push_back(score.gain.bits);
  return py::dict(py::arg("turn_rad") = turns_rad[next.decision.action],
                  py::arg("turns_rad") = array_of(turns_rad),
                  py::arg("gain_bits") = array_of(std::move(gains)));
}

bool ActiveRecogniser::was_visited(double turn_rad) const {
  if (known_.views.empty()) return false;
  const double to_rad = known_.views.back().view_rad + turn_rad;
  return std::ranges::any_of(known_.views, [&](const ViewReport& view) {
    return std::abs(std::remainder(view.view_rad - to_rad, 2.0 * std::numbers::pi)) <
           0.5 * recogniser_.states.bin_rad();
  });
}

py::dict ActiveRecogniser::last_view() const {
  const ViewReport& view = known_.views.back();
  py::dict skipped;
  for (const SkippedFeature& s : view.skipped) skipped[py::str(s.feature)] = s.reason;
  return py::dict(py::arg("features") = view.features, py::arg("skipped") = skipped,
                  py::arg("entropy_bits") = view.entropy_bits,
                  py::arg("feature_time_s") = view.feature_time_s);
}

}  // namespace vantage::python
