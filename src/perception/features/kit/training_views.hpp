/// Samples to learn from, drawn evenly from training views.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <span>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/perception/features/kit/k_means.hpp"
#include "vantage/perception/object_view.hpp"

namespace vantage {

/// About `samples` of the columns that `columns_of(view)` gives for up to `max_views` views drawn
/// at random: the same number of each view, all of those that have fewer.
template <class ColumnsOf>
Eigen::MatrixXf sampled_columns(std::span<const ObjectView> views, Eigen::Index max_views,
                                Eigen::Index samples, Rng& rng, ColumnsOf&& columns_of) {
  const auto chosen = some_indices(static_cast<Eigen::Index>(views.size()), max_views, rng);
  if (chosen.empty()) return {};
  const auto count = static_cast<Eigen::Index>(chosen.size());
  const Eigen::Index share = (samples + count - 1) / count;
  std::vector<Eigen::MatrixXf> parts;
  Eigen::Index total = 0;
  for (const Eigen::Index view : chosen) {
    parts.push_back(some_columns(columns_of(views[static_cast<std::size_t>(view)]), share, rng));
    total += parts.back().cols();
  }
  Eigen::Index rows = 0;
  for (const auto& part : parts) rows = std::max(rows, part.rows());
  Eigen::MatrixXf all(rows, total);
  Eigen::Index next = 0;
  for (const auto& part : parts) {
    if (part.cols() > 0) all.middleCols(next, part.cols()) = part;
    next += part.cols();
  }
  return all;
}

}  // namespace vantage
