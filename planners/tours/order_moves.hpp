/// The changes that local search tries on an order of places or views.
#pragma once

#include <cstddef>
#include <vector>

namespace vantage {

/// Or-opt: the `length` from `from` on go elsewhere: they begin at `to` afterwards. [Or1976]
/// @pre from + length and to + length are at most the size
std::vector<std::size_t> with_moved(std::vector<std::size_t> order, std::size_t from,
                                    std::size_t length, std::size_t to);

/// 2-opt: those from `begin` to before `end` are gone through the other way round.
/// @pre begin <= end, and end is at most the size
std::vector<std::size_t> with_reversed(std::vector<std::size_t> order, std::size_t begin,
                                       std::size_t end);

}  // namespace vantage
