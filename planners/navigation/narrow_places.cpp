#include "vantage/planners/navigation/narrow_places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vantage {
namespace {

using Cells = std::vector<std::size_t>;

/// How far from open places a nook begins, and how far about passages, nooks and the robot a search
/// may go.
constexpr double kSeam_m = 0.4;
constexpr double kAboutPassage_m = 0.2;
constexpr double kAboutNook_m = 0.6;
constexpr double kAboutStart_m = 1.0;

template <class Visit>
void for_each_beside(const FloorMap& floor, std::size_t cell, int neighbours, Visit&& visit) {
  const Eigen::Array2i at = floor.cell(cell);
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if ((dx == 0 && dy == 0) || (neighbours == 4 && dx != 0 && dy != 0)) continue;
      const Eigen::Array2i to = at + Eigen::Array2i(dx, dy);
      if (floor.contains(to)) visit(floor.index(to));
    }
  }
}

}  // namespace

std::vector<Cells> connected_parts(const FloorMap& floor, std::span<const std::uint8_t> flags,
                                   int neighbours) {
  std::vector<std::uint8_t> asked(flags.size(), 0);
  std::vector<Cells> parts;
  for (std::size_t first = 0; first < flags.size(); ++first) {
    if (flags[first] == 0 || asked[first] != 0) continue;
    asked[first] = 1;
    Cells part{first};
    for (std::size_t i = 0; i < part.size(); ++i) {
      for_each_beside(floor, part[i], neighbours, [&](std::size_t to) {
        if (flags[to] == 0 || asked[to] != 0) return;
        asked[to] = 1;
        part.push_back(to);
      });
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

namespace {

class NarrowPlaces {
 public:
  NarrowPlaces(const FloorMap& floor, std::span<const std::uint8_t> open,
               std::span<const std::uint8_t> may_stand, double least_area_m2)
      : floor_(floor),
        least_cells_(least_area_m2 / (floor.cell_m * floor.cell_m)),
        place_(floor.size(), kNone),
        steps_(floor.size(), 0),
        thin_(floor.size(), 0),
        left_(floor.size(), -1),
        leeway_(floor.size(), Leeway::none) {
    for (std::size_t cell = 0; cell < floor.size(); ++cell) {
      if (open[cell] != 0) leeway_[cell] = Leeway::open;
      thin_[cell] = open[cell] == 0 && may_stand[cell] != 0 ? 1 : 0;
    }
    number_open_places(open);
    follow_seams();
  }

  std::vector<Leeway> leeway(std::optional<std::size_t> start_cell) {
    find_nooks();
    if (start_cell && leeway_[*start_cell] != Leeway::open) spread({*start_cell}, kAboutStart_m);
    for (const std::size_t cell : meetings_) {
      spread({cell}, steps_[cell] * floor_.cell_m + kAboutPassage_m);
    }
    return std::move(leeway_);
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// An open place that is too small is as narrow as what is about it.
  void number_open_places(std::span<const std::uint8_t> open) {
    std::uint32_t count = 0;
    for (const Cells& part : connected_parts(floor_, open, 4)) {
      const bool worth_it = static_cast<double>(part.size()) >= least_cells_;
      for (const std::size_t cell : part) {
        thin_[cell] = worth_it ? 0 : 1;
        if (worth_it) place_[cell] = count;
      }
      if (worth_it) {
        ++count;
        seam_.insert(seam_.end(), part.begin(), part.end());
      }
    }
  }

  /// From all open places at once; where two meet there is a passage.
  void follow_seams() {
    for (std::size_t i = 0; i < seam_.size(); ++i) {
      const std::size_t from = seam_[i];
      bool meets = false;
      for_each_beside(floor_, from, 8, [&](std::size_t to) {
        if (thin_[to] != 0 && place_[to] == kNone) {
          place_[to] = place_[from];
          steps_[to] = steps_[from] + 1;
          seam_.push_back(to);
        } else if (place_[to] != kNone && place_[to] != place_[from]) {
          meets = true;
        }
      });
      if (meets) meetings_.push_back(from);
    }
  }

  void find_nooks() {
    const int seam_steps = static_cast<int>(std::lround(kSeam_m / floor_.cell_m));
    std::vector<std::uint8_t> far(floor_.size(), 0);
    for (std::size_t cell = 0; cell < floor_.size(); ++cell) {
      const bool alone = place_[cell] == kNone;
      far[cell] = thin_[cell] != 0 && (alone || steps_[cell] > seam_steps) ? 1 : 0;
    }
    for (const Cells& part : connected_parts(floor_, far, 8)) {
      if (static_cast<double>(part.size()) < least_cells_) continue;
      spread(part, kAboutNook_m);
      for (const std::size_t cell : part) {
        if (leeway_[cell] != Leeway::open) leeway_[cell] = Leeway::nook;
      }
    }
  }

  /// Makes a passage of what is narrow about these cells.
  void spread(const Cells& from, double reach_m) {
    const int reach = static_cast<int>(std::lround(reach_m / floor_.cell_m));
    Cells queue;
    const auto put = [&](std::size_t cell, int left) {
      if (left <= left_[cell]) return;
      left_[cell] = left;
      queue.push_back(cell);
    };
    for (const std::size_t cell : from) put(cell, reach);
    for (std::size_t taken = 0; taken < queue.size();) {
      const std::size_t cell = queue[taken++];
      if (leeway_[cell] == Leeway::none) leeway_[cell] = Leeway::passage;
      for_each_beside(floor_, cell, 8, [&](std::size_t to) {
        if (thin_[to] != 0) put(to, left_[cell] - 1);
      });
    }
  }

  const FloorMap& floor_;
  double least_cells_;
  std::vector<std::uint32_t> place_;  ///< the open place each cell is nearest to
  std::vector<int> steps_;            ///< from there
  std::vector<std::uint8_t> thin_;    ///< room at some heading, perhaps
  std::vector<int> left_;             ///< steps that a spread may go on from there
  std::vector<Leeway> leeway_;
  Cells seam_;
  Cells meetings_;
};

}  // namespace

std::vector<Leeway> find_narrow_places(const FloorMap& floor, std::span<const std::uint8_t> open,
                                       std::span<const std::uint8_t> may_stand,
                                       double least_area_m2,
                                       std::optional<std::size_t> start_cell) {
  expects(open.size() == floor.size() && may_stand.size() == floor.size(), "a flag per cell");
  return NarrowPlaces(floor, open, may_stand, least_area_m2).leeway(start_cell);
}

}  // namespace vantage
