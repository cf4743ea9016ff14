#include "vantage/models/catalogue/shapes/patterns.hpp"

#include <algorithm>
#include <cmath>

namespace vantage {
namespace {

double fraction(double x) { return x - std::floor(x); }

/// Value noise in [0, 1] on a lattice that repeats after `period` cells in s.
class Noise {
 public:
  Noise(int period_s, int rows, Rng& rng) : period_(period_s), rows_(rows) {
    lattice_.resize(static_cast<std::size_t>(period_) * static_cast<std::size_t>(rows_ + 1));
    for (double& node : lattice_) node = rng.uniform();
  }
  double operator()(double s, double t) const {
    const double x = s * period_;
    const double y = std::clamp(t, 0.0, 1.0) * rows_;
    const int column = static_cast<int>(std::floor(x));
    const int row = std::min(static_cast<int>(y), rows_ - 1);
    const double fx = ease(x - column);
    const double fy = ease(y - row);
    const double low = node(column, row) * (1 - fx) + node(column + 1, row) * fx;
    const double high = node(column, row + 1) * (1 - fx) + node(column + 1, row + 1) * fx;
    return low * (1 - fy) + high * fy;
  }

 private:
  static double ease(double x) { return x * x * (3.0 - 2.0 * x); }
  [[nodiscard]] double node(int column, int row) const {
    const int wrapped = ((column % period_) + period_) % period_;
    return lattice_[static_cast<std::size_t>(row) * static_cast<std::size_t>(period_) +
                    static_cast<std::size_t>(wrapped)];
  }
  int period_;
  int rows_;
  std::vector<double> lattice_;
};

}  // namespace

Pattern bands(const RgbColour& a, const RgbColour& b, int count) {
  return [=](double, double t) { return fraction(t * count) < 0.5 ? a : b; };
}

Pattern stripes(const RgbColour& a, const RgbColour& b, int count, double slant) {
  return [=](double s, double t) { return fraction(s * count + slant * t) < 0.5 ? a : b; };
}

Pattern checks(const RgbColour& a, const RgbColour& b, int columns, int rows) {
  return [=](double s, double t) {
    const auto parity = static_cast<long>(std::floor(s * columns) + std::floor(t * rows));
    return parity % 2 == 0 ? a : b;
  };
}

Pattern dots(const RgbColour& ground, const RgbColour& dot, int columns, int rows, double radius) {
  return [=](double s, double t) {
    const double row = std::floor(t * rows);
    const double x = fraction(s * columns + (std::fmod(row, 2.0) == 0.0 ? 0.0 : 0.5)) - 0.5;
    const double y = fraction(t * rows) - 0.5;
    return std::hypot(x, y) < radius ? dot : ground;
  };
}

Pattern zigzag(const RgbColour& a, const RgbColour& b, int columns, int rows) {
  return [=](double s, double t) {
    const double wave = std::abs(fraction(s * columns) - 0.5);
    return fraction(t * rows + wave) < 0.5 ? a : b;
  };
}

Pattern gradient(const RgbColour& bottom, const RgbColour& top) {
  return [=](double, double t) { return mix(bottom, top, t); };
}

Pattern wood(const RgbColour& light, const RgbColour& dark, int boards, Rng& rng) {
  const Noise bend(3, 4 * boards, rng);
  const Noise grain(6, 40 * boards, rng);
  const Noise tone(1, 2 * boards, rng);
  return [=](double s, double t) {
    const double board = std::floor(t * boards);
    const double shifted = s + 0.37 * board;
    const double rings = fraction(t * boards * 5.0 + 2.5 * bend(shifted, t));
    double share = 0.45 * rings * rings + 0.35 * grain(shifted, t);
    share += 0.25 * tone(0.0, (board + 0.5) / boards);
    const bool joint = boards > 1 && fraction(t * boards) < 0.03;
    return mix(light, dark, joint ? 1.3 : share);
  };
}

Pattern tiles(const RgbColour& tile, const RgbColour& joint, int columns, int rows, Rng& rng) {
  std::vector<double> tone(static_cast<std::size_t>(columns * rows));
  for (double& brightness : tone) brightness = rng.uniform(0.9, 1.05);
  return [=](double s, double t) -> RgbColour {
    const double x = s * columns;
    const double y = t * rows;
    if (fraction(x) < 0.03 || fraction(y) < 0.03) return joint;
    const auto index = static_cast<std::size_t>(std::floor(y) * columns + std::floor(x));
    return tile * tone[index];
  };
}

Pattern mottled(const RgbColour& a, const RgbColour& b, int cells, Rng& rng) {
  const Noise coarse(cells, cells, rng);
  const Noise fine(3 * cells, 3 * cells, rng);
  return [=](double s, double t) { return mix(a, b, 0.7 * coarse(s, t) + 0.3 * fine(s, t)); };
}

Pattern any_pattern(const RgbColour& a, const RgbColour& b, Rng& rng) {
  const int count = 2 + static_cast<int>(rng.uniform_index(4));
  switch (rng.uniform_index(7)) {
    case 0: return bands(a, b, count);
    case 1: return stripes(a, b, 3 * count);
    case 2: return checks(a, b, 4 * count, 2 * count);
    case 3: return dots(a, b, 3 * count, count + 2, 0.3);
    case 4: return zigzag(a, b, 3 * count, count);
    case 5: return stripes(a, b, 2 * count, 2.0);
    default: return gradient(a, b);
  }
}

}  // namespace vantage
