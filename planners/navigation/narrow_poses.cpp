#include "vantage/planners/navigation/narrow_poses.hpp"

#include <cmath>
#include <utility>

#include "vantage/planners/navigation/distance_field.hpp"

namespace vantage {

NarrowPoses::NarrowPoses(PathField& field, std::vector<Leeway> leeway)
    : field_(field),
      space_(*field.space),
      leeway_(std::move(leeway)),
      row_of_(field.map.size(), kNone) {
  std::uint32_t rows = 0;
  for (std::size_t cell = 0; cell < leeway_.size(); ++cell) {
    if (is_narrow(cell)) row_of_[cell] = rows++;
  }
  pose_at_.assign(rows * static_cast<std::size_t>(space_.headings()), kUnknown);
}

std::size_t NarrowPoses::slot(std::size_t cell, int heading) const {
  return row_of_[cell] * static_cast<std::size_t>(space_.headings()) +
         static_cast<std::size_t>(heading);
}

Eigen::Array2i NarrowPoses::middle(std::size_t cell) const {
  return field_.map.cell(cell) * space_.parts() + space_.parts() / 2;
}

std::optional<Eigen::Array2i> NarrowPoses::nearest_fitting(std::size_t cell, int heading,
                                                           Margin margin) const {
  if (!space_.may_fit(middle(cell), heading, margin)) return {};
  const int reach = space_.parts() / 2;
  double nearest = kInfinity;
  std::optional<Eigen::Array2i> best;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const double off = std::hypot(dx, dy);
      const Eigen::Array2i fine = middle(cell) + Eigen::Array2i(dx, dy);
      if (off >= nearest || !space_.fits(fine, heading, margin)) continue;
      nearest = off;
      best = fine;
    }
  }
  return best;
}

std::uint32_t NarrowPoses::at(std::size_t cell, int heading) {
  std::uint32_t& pose = pose_at_[slot(cell, heading)];
  if (pose != kUnknown) return pose;
  pose = kNone;
  std::optional<Eigen::Array2i> fine = nearest_fitting(cell, heading, Margin::preferred);
  const bool roomy = fine.has_value();
  if (!roomy) fine = nearest_fitting(cell, heading, least_);
  if (!fine) return pose;
  pose = static_cast<std::uint32_t>(field_.narrow.size());
  const Eigen::Vector2d p_m = space_.centre(*fine);
  field_.narrow.push_back({.pose = {p_m.x(), p_m.y(), space_.heading_rad(heading)},
                           .cell = cell,
                           .cost = kInfinity,
                           .parent = PathField::kNone});
  placed_.push_back({*fine, heading, roomy});
  return pose;
}

std::uint32_t NarrowPoses::add_start() {
  const int heading = space_.nearest_heading(field_.start.yaw_rad);
  const Eigen::Array2i fine = middle(field_.start_cell);
  least_ = space_.fits(fine, heading) ? Margin::least : Margin::tight;
  const auto pose = static_cast<std::uint32_t>(field_.narrow.size());
  field_.narrow.push_back({.pose = field_.start,
                           .cell = field_.start_cell,
                           .cost = kInfinity,
                           .parent = PathField::kNone});
  placed_.push_back({fine, heading, space_.fits(fine, heading, Margin::preferred)});
  pose_at_[slot(field_.start_cell, heading)] = pose;
  return pose;
}

bool NarrowPoses::fits_between(const Eigen::Array2i& a, const Eigen::Array2i& b,
                               int heading) const {
  return space_.fits(a + (b - a) / 2, heading, least_) ||
         space_.fits(b + (a - b) / 2, heading, least_);
}

bool NarrowPoses::is_roomy_between(const Eigen::Array2i& a, const Eigen::Array2i& b,
                                   int heading) const {
  return space_.fits(a + (b - a) / 2, heading, Margin::preferred) &&
         space_.fits(b + (a - b) / 2, heading, Margin::preferred);
}

bool NarrowPoses::fits_turning(const Place& from, const Place& to_next) const {
  return space_.fits_turning((from.fine + to_next.fine) / 2, from.heading, least_);
}

bool NarrowPoses::is_roomy_turning(const Place& from, const Place& to_next) const {
  return from.roomy && to_next.roomy &&
         space_.fits_turning((from.fine + to_next.fine) / 2, from.heading, Margin::preferred);
}

}  // namespace vantage
