#include "vantage/recognition/kept_looks.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace vantage {
namespace {

/// A picture replaces another if it is nearer by that.
constexpr double kNearer_m = 0.1;

double distance_m(const KeptLook& look) { return look.seen.sighting.distance_m; }

}  // namespace

bool KeptLooks::improves(int id, int direction, double distance_m) const {
  return std::ranges::none_of(kept_, [&](const KeptLook& kept) {
    return kept.id == id && kept.direction == direction &&
           distance_m > kept.seen.sighting.distance_m - kNearer_m;
  });
}

void KeptLooks::keep(KeptLook look) {
  std::erase_if(kept_, [&](const KeptLook& kept) {
    return kept.id == look.id && kept.direction == look.direction;
  });
  kept_.push_back(std::move(look));
}

void KeptLooks::forget(int id) {
  std::erase_if(kept_, [id](const KeptLook& kept) { return kept.id == id; });
  sighted_s_.erase(id);
}

bool KeptLooks::due(const KeptLook& look, double time_s, int direction) const {
  if (distance_m(look) > options_.near_m) {
    const auto sighted = sighted_s_.find(look.id);
    return sighted == sighted_s_.end() || time_s - sighted->second >= options_.left_after_s;
  }
  return look.direction != direction || time_s - look.time_s >= options_.patience_s;
}

std::vector<KeptLook> KeptLooks::take_due(double time_s,
                                          const std::function<int(int id)>& direction_of) {
  const auto first_due = std::stable_partition(
      kept_.begin(), kept_.end(),
      [&](const KeptLook& look) { return !due(look, time_s, direction_of(look.id)); });
  std::vector<KeptLook> taken(std::make_move_iterator(first_due),
                              std::make_move_iterator(kept_.end()));
  kept_.erase(first_due, kept_.end());
  std::ranges::stable_sort(taken, {}, distance_m);
  return taken;
}

std::vector<KeptLook> KeptLooks::take_all() {
  std::vector<KeptLook> taken = std::exchange(kept_, {});
  std::ranges::stable_sort(taken, {}, distance_m);
  return taken;
}

}  // namespace vantage
