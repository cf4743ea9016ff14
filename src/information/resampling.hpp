/// What a sample says of a mean: intervals by resampling and tests by permutation.
/// [EfronTibshirani1993, chapters 13, 15]
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "vantage/core/rng.hpp"

namespace vantage {

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

struct BootstrapOptions {
  int resamples = 10000;
  double confidence = 0.95;
};

/// Of at least one value.
double mean(std::span<const double> values);

/// Percentile interval of the mean. Of one value: that value.
Interval bootstrap_mean(std::span<const double> values, Rng& rng,
                        const BootstrapOptions& options = {});

/// Percentile interval of mean(numerators) / mean(denominators), resampled in pairs; a resample
/// whose denominators have mean 0 counts as +infinity.
Interval bootstrap_ratio(std::span<const double> numerators, std::span<const double> denominators,
                         Rng& rng, const BootstrapOptions& options = {});

/// Indices of the values that belong together, as all of one scene do. None is empty.
using Clusters = std::vector<std::vector<std::size_t>>;
/// Of values that bear these marks; in the order in which a mark first comes.
Clusters clusters_of(std::span<const std::size_t> marks);

/// The same of values that are alike within clusters: whole clusters are resampled. Of one cluster
/// there is no interval: its mean.  [CameronGelbachMiller2008]
Interval bootstrap_mean(std::span<const double> values, const Clusters& clusters, Rng& rng,
                        const BootstrapOptions& options = {});
Interval bootstrap_ratio(std::span<const double> numerators, std::span<const double> denominators,
                         const Clusters& clusters, Rng& rng, const BootstrapOptions& options = {});
/// The sum of each cluster's values: for a sign-flip test in which a cluster has one sign.
std::vector<double> cluster_sums(std::span<const double> values, const Clusters& clusters);

/// Two-sided p-value of mean(differences) = 0 when each sign could as well be the other: all 2^n
/// sign patterns for up to 16 differences, else `draws` random ones, the observed one included.
double sign_flip_p_value(std::span<const double> differences, Rng& rng, int draws = 10000);

}  // namespace vantage
