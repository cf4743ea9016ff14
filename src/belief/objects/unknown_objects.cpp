#include "vantage/belief/objects/unknown_objects.hpp"

#include <algorithm>
#include <numeric>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

/// Number of objects that the scatter of all categories is worth to each of them.
constexpr double kScatterWorth = 2.0;

std::vector<std::vector<int>> members_of_categories(const ObjectStates& states,
                                                    std::span<const int> objects) {
  std::vector<std::vector<int>> members(states.categories.size());
  for (const int k : objects) {
    const int category = states.category_of[static_cast<std::size_t>(k)];
    members[static_cast<std::size_t>(category)].push_back(k);
  }
  return members;
}

/// Of the objects' means about their mean.
Eigen::VectorXd squared_deviation(const Eigen::MatrixXd& means) {
  return (means.colwise() - means.rowwise().mean()).array().square().rowwise().sum();
}

/// W: mean squared deviation from the mean of the category; empty if no category has two objects.
Eigen::VectorXd scatter_within(const ObjectMoments& moments,
                               std::span<const std::vector<int>> members) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(moments.mean.rows());
  double freedom = 0.0;
  for (const std::vector<int>& category : members) {
    if (category.size() < 2) continue;
    sum += squared_deviation(moments.mean(Eigen::all, category));
    freedom += static_cast<double>(category.size()) - 1.0;
  }
  if (freedom == 0.0) return {};
  return sum / freedom;
}

void put_column(BackgroundDensities& background, Eigen::Index column, const ObjectMoments& moments,
                std::span<const int> objects, const Eigen::VectorXd& scatter) {
  const auto count = static_cast<double>(objects.size());
  const Eigen::MatrixXd means = moments.mean(Eigen::all, objects);
  const double worth = scatter.size() > 0 ? kScatterWorth : 0.0;
  Eigen::VectorXd between = squared_deviation(means);
  if (worth > 0.0) between += worth * scatter;
  between *= (1.0 + 1.0 / count) / (worth + count - 1.0);
  background.gaussians.mean.col(column) = means.rowwise().mean().cast<float>();
  background.gaussians.variance.col(column) =
      (moments.variance(Eigen::all, objects).rowwise().mean() + between).cast<float>();
}

bool has_two_of_a_category(std::span<const std::vector<int>> members) {
  return std::ranges::any_of(members, [](const auto& category) { return category.size() > 1; });
}

std::vector<int> hypotheses_of(std::span<const std::vector<int>> members) {
  std::vector<int> categories;
  if (has_two_of_a_category(members)) {
    for (std::size_t c = 0; c < members.size(); ++c) {
      if (!members[c].empty()) categories.push_back(static_cast<int>(c));
    }
  }
  categories.push_back(kNoCategory);
  return categories;
}

std::vector<int> all_objects(const ObjectStates& states) {
  std::vector<int> all(states.objects.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

ObjectMoments object_moments(const ObservationModel& model, const ObjectStates& states) {
  expects(model.states() >= states.known_size(), "a model of every known state");
  ObjectMoments moments{.mean = Eigen::MatrixXd(model.dimensions(), states.object_count()),
                        .variance = Eigen::MatrixXd(model.dimensions(), states.object_count())};
  for (int k = 0; k < states.object_count(); ++k) {
    const auto mean = model.mean.middleCols(states.state(k, 0), states.bins).cast<double>();
    const auto variance = model.variance.middleCols(states.state(k, 0), states.bins).cast<double>();
    moments.mean.col(k) = mean.rowwise().mean();
    moments.variance.col(k) =
        variance.rowwise().mean() +
        (mean.colwise() - moments.mean.col(k)).array().square().rowwise().mean().matrix();
  }
  return moments;
}

BackgroundDensities background_densities(const ObjectMoments& moments, const ObjectStates& states,
                                         std::span<const int> kept) {
  expects(kept.size() >= 2, "a background of two objects or more");
  const std::vector<std::vector<int>> members = members_of_categories(states, kept);
  const Eigen::VectorXd scatter = scatter_within(moments, members);
  BackgroundDensities background{.category = hypotheses_of(members), .gaussians = {}};
  const auto columns = static_cast<Eigen::Index>(background.category.size());
  background.gaussians.mean.resize(moments.mean.rows(), columns);
  background.gaussians.variance.resize(moments.mean.rows(), columns);
  for (Eigen::Index u = 0; u + 1 < columns; ++u) {
    const auto category =
        static_cast<std::size_t>(background.category[static_cast<std::size_t>(u)]);
    put_column(background, u, moments, members[category], scatter);
  }
  put_column(background, columns - 1, moments, kept, {});
  return background;
}

std::vector<int> unknown_hypotheses(const ObjectStates& states) {
  if (states.object_count() < 2) return {};
  return hypotheses_of(members_of_categories(states, all_objects(states)));
}

ObservationModel with_unknown(ObservationModel model, const ObjectStates& states,
                              const UnknownFactors& factors) {
  const BackgroundDensities background =
      background_densities(object_moments(model, states), states, all_objects(states));
  const auto known = static_cast<Eigen::Index>(states.known_size());
  const auto unknown = background.gaussians.mean.cols();
  model.mean.conservativeResize(Eigen::NoChange, known + unknown);
  model.variance.conservativeResize(Eigen::NoChange, known + unknown);
  model.mean.rightCols(unknown) = background.gaussians.mean;
  model.variance.rightCols(unknown) = background.gaussians.variance;
  model.log_factor = Eigen::VectorXd::Zero(known + unknown);
  model.log_factor.tail(unknown).setConstant(factors.instance);
  model.log_factor[known + unknown - 1] = factors.category;
  return model;
}

}  // namespace vantage
