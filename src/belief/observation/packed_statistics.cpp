#include "vantage/belief/observation/packed_statistics.hpp"

#include <cmath>
#include <limits>
#include <span>

namespace vantage {
namespace {

using Codes = Eigen::Matrix<std::uint16_t, Eigen::Dynamic, 1>;

constexpr float kSteps = 65535.0F;
constexpr std::size_t kBytesPerDimension = 3 * sizeof(float);

/// value = low + step * code, per dimension; a step of 0 where all states are the same.
struct Grid {
  Eigen::ArrayXf low;
  Eigen::ArrayXf step;

  [[nodiscard]] Codes encode(const Eigen::ArrayXf& values) const {
    const Eigen::ArrayXf scaled = (step > 0.0F).select((values - low) / step, 0.0F);
    return scaled.round().max(0.0F).min(kSteps).cast<std::uint16_t>().matrix();
  }
  [[nodiscard]] Eigen::VectorXf decode(const Codes& codes) const {
    return (low + step * codes.cast<float>().array()).matrix();
  }
};

bool has_views(const GaussianStatistics& statistics, Eigen::Index state) {
  return statistics.count[static_cast<std::size_t>(state)] > 0;
}

Eigen::ArrayXf spread_of(const GaussianStatistics& statistics, Eigen::Index state) {
  return statistics.squared_deviation.col(state).array().sqrt();
}

Grid grid_of_means(const GaussianStatistics& statistics) {
  Grid grid{.low = Eigen::ArrayXf::Zero(statistics.dimensions()),
            .step = Eigen::ArrayXf::Zero(statistics.dimensions())};
  Eigen::ArrayXf high = grid.low;
  bool first = true;
  for (Eigen::Index j = 0; j < statistics.states(); ++j) {
    if (!has_views(statistics, j)) continue;
    const auto mean = statistics.mean.col(j).array();
    grid.low = first ? Eigen::ArrayXf(mean) : Eigen::ArrayXf(grid.low.min(mean));
    high = first ? Eigen::ArrayXf(mean) : Eigen::ArrayXf(high.max(mean));
    first = false;
  }
  grid.step = high / kSteps - grid.low / kSteps;
  return grid;
}

Grid grid_of_spreads(const GaussianStatistics& statistics) {
  Grid grid{.low = Eigen::ArrayXf::Zero(statistics.dimensions()),
            .step = Eigen::ArrayXf::Zero(statistics.dimensions())};
  for (Eigen::Index j = 0; j < statistics.states(); ++j) {
    grid.step = grid.step.max(spread_of(statistics, j));
  }
  grid.step /= kSteps;
  return grid;
}

template <class Column>
void put_column(std::string& bytes, const Column& column) {
  bytes.append(reinterpret_cast<const char*>(column.data()),
               static_cast<std::size_t>(column.size()) * sizeof(column[0]));
}

template <class Column>
Column take_column(ByteReader& reader, std::size_t size, std::string_view what) {
  Column column(static_cast<Eigen::Index>(size));
  reader.numbers(std::span(column.data(), size), what);
  return column;
}

std::vector<int> take_counts(ByteReader& reader, int states) {
  std::vector<int> counts;
  for (int j = 0; j < states; ++j) {
    counts.push_back(reader.number<std::int32_t>("the numbers of views"));
    reader.require(counts.back() >= 0, "a state has a negative number of views");
  }
  return counts;
}

Grid take_grid(ByteReader& reader, std::size_t dimensions, bool from_zero) {
  constexpr std::string_view kWhat = "the ranges of dimensions";
  Grid grid{.low = Eigen::ArrayXf::Zero(static_cast<Eigen::Index>(dimensions)), .step = {}};
  if (!from_zero) grid.low = take_column<Eigen::ArrayXf>(reader, dimensions, kWhat);
  grid.step = take_column<Eigen::ArrayXf>(reader, dimensions, kWhat);
  // The largest value is squared where it is a spread.
  const Eigen::ArrayXf high = grid.low + kSteps * grid.step;
  const bool sound = grid.low.allFinite() && (grid.step >= 0.0F).all() && high.allFinite() &&
                     (!from_zero || high.square().allFinite());
  reader.require(sound, "the range of a dimension is no finite range");
  return grid;
}

}  // namespace

void put_packed(std::string& bytes, const GaussianStatistics& statistics) {
  expects(statistics.mean.allFinite() && statistics.squared_deviation.allFinite(),
          "statistics of finite numbers");
  for (const int count : statistics.count) put(bytes, static_cast<std::int32_t>(count));
  put(bytes, static_cast<std::uint32_t>(statistics.dimensions()));
  const Grid means = grid_of_means(statistics);
  const Grid spreads = grid_of_spreads(statistics);
  put_column(bytes, means.low);
  put_column(bytes, means.step);
  put_column(bytes, spreads.step);
  for (Eigen::Index j = 0; j < statistics.states(); ++j) {
    put_column(bytes, means.encode(statistics.mean.col(j).array()));
    put_column(bytes, spreads.encode(spread_of(statistics, j)));
  }
}

GaussianStatistics take_packed(ByteReader& reader, int states) {
  constexpr std::string_view kWhat = "the statistics of a feature";
  std::vector<int> counts = take_counts(reader, states);
  const std::size_t bytes_per_dimension =
      kBytesPerDimension + 2 * sizeof(std::uint16_t) * static_cast<std::size_t>(states);
  const std::size_t dimensions = reader.count(bytes_per_dimension, kWhat);
  reader.require(dimensions >= 1, "a feature has no dimensions");
  const Grid means = take_grid(reader, dimensions, /*from_zero=*/false);
  const Grid spreads = take_grid(reader, dimensions, /*from_zero=*/true);
  GaussianStatistics statistics = empty_statistics(static_cast<int>(dimensions), states);
  statistics.count = std::move(counts);
  for (Eigen::Index j = 0; j < states; ++j) {
    const auto mean_codes = take_column<Codes>(reader, dimensions, kWhat);
    const auto spread_codes = take_column<Codes>(reader, dimensions, kWhat);
    if (!has_views(statistics, j)) continue;
    statistics.mean.col(j) = means.decode(mean_codes);
    statistics.squared_deviation.col(j) = spreads.decode(spread_codes).cwiseAbs2();
  }
  return statistics;
}

}  // namespace vantage
