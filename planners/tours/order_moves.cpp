#include "vantage/planners/tours/order_moves.hpp"

#include <algorithm>

#include "vantage/core/error.hpp"

namespace vantage {

std::vector<std::size_t> with_moved(std::vector<std::size_t> order, std::size_t from,
                                    std::size_t length, std::size_t to) {
  expects(std::max(from, to) + length <= order.size(), "a segment of the order");
  const auto at = [&](std::size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
  if (to < from) {
    std::rotate(at(to), at(from), at(from + length));
  } else {
    std::rotate(at(from), at(from + length), at(to + length));
  }
  return order;
}

std::vector<std::size_t> with_reversed(std::vector<std::size_t> order, std::size_t begin,
                                       std::size_t end) {
  expects(begin <= end && end <= order.size(), "a part of the order");
  std::reverse(order.begin() + static_cast<std::ptrdiff_t>(begin),
               order.begin() + static_cast<std::ptrdiff_t>(end));
  return order;
}

}  // namespace vantage
