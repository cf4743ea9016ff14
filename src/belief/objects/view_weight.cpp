#include "vantage/belief/objects/view_weight.hpp"

#include "vantage/core/error.hpp"

namespace vantage {

double view_weight(int before, double correlation) {
  expects(before >= 0 && correlation >= 0.0 && correlation <= 1.0, "a correlation of views");
  if (before == 0 || correlation == 0.0) return 1.0;
  const double r = correlation;
  const auto worth = [r](double n) { return n / (1.0 + (n - 1.0) * r); };
  return worth(before + 1.0) - worth(before);
}

}  // namespace vantage
