#include "vantage/perception/clouds/posts.hpp"

#include <algorithm>
#include <cmath>

namespace vantage {
namespace {

/// How far behind the mean of its returns a post's middle lies, in half its width: 1 for a square
/// face seen straight on, 0.5 for one seen over its edge, 0.785 for a round post.
constexpr double kBehind = 0.75;
constexpr double kSpoils = 4.0;

Eigen::Vector2d in_world(const Pose2& T_world_base, const Eigen::Vector2d& p_base) {
  const Pose2 p = compose(T_world_base, {p_base.x(), p_base.y(), 0.0});
  return {p.x_m, p.y_m};
}

/// Whether the beam beside a post goes past it.
bool passes(const PlanarScan& scan, std::size_t beam, double range_m, double gap_m) {
  if (beam >= scan.range_m.size()) return false;
  const auto beside_m = static_cast<double>(scan.range_m[beam]);
  return !std::isnan(beside_m) && beside_m > range_m + gap_m;
}

/// The post that the beams [first, end) show; nothing if it is none.
void add_post(const PlanarScan& scan, std::size_t first, std::size_t end,
              const PostOptions& options, std::vector<Eigen::Vector2d>& posts) {
  const std::size_t beams = end - first;
  if (beams < static_cast<std::size_t>(options.min_beams) || first == 0) return;
  double range_m = 0.0;
  double azimuth_rad = 0.0;
  for (std::size_t i = first; i < end; ++i) {
    range_m += static_cast<double>(scan.range_m[i]) / static_cast<double>(beams);
    azimuth_rad += scan.azimuth_rad[i] / static_cast<double>(beams);
  }
  if (!passes(scan, first - 1, range_m, options.gap_m) ||
      !passes(scan, end, range_m, options.gap_m)) {
    return;
  }
  const double step_rad = scan.azimuth_rad[first] - scan.azimuth_rad[first - 1];
  const double width_m = range_m * step_rad * static_cast<double>(beams);
  if (width_m > options.max_width_m) return;
  const double middle_m = range_m + kBehind * 0.5 * width_m;
  posts.push_back(in_world(scan.T_base_sensor, middle_m * Eigen::Vector2d(std::cos(azimuth_rad),
                                                                          std::sin(azimuth_rad))));
}

struct Pair {
  Eigen::Vector2d seen_base;
  Eigen::Vector2d known_world;
};

Eigen::Vector2d mean_of(const std::vector<Pair>& pairs, Eigen::Vector2d Pair::*member) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Pair& pair : pairs) sum += pair.*member;
  return sum / static_cast<double>(pairs.size());
}

Pose2 rigid_motion(const std::vector<Pair>& pairs) {
  const Eigen::Vector2d seen = mean_of(pairs, &Pair::seen_base);
  const Eigen::Vector2d known = mean_of(pairs, &Pair::known_world);
  double along = 0.0;
  double across = 0.0;
  for (const Pair& pair : pairs) {
    const Eigen::Vector2d a = pair.seen_base - seen;
    const Eigen::Vector2d b = pair.known_world - known;
    along += a.dot(b);
    across += a.x() * b.y() - a.y() * b.x();
  }
  const double yaw_rad = std::atan2(across, along);
  const Eigen::Vector2d p = known - in_world({0.0, 0.0, yaw_rad}, seen);
  return {p.x(), p.y(), yaw_rad};
}

double spread_m(const std::vector<Pair>& pairs) {
  const Eigen::Vector2d known = mean_of(pairs, &Pair::known_world);
  double sum = 0.0;
  for (const Pair& pair : pairs) sum += (pair.known_world - known).squaredNorm();
  return std::sqrt(sum / static_cast<double>(pairs.size()));
}

}  // namespace

std::vector<Eigen::Vector2d> find_posts(const PlanarScan& scan, const PostOptions& options) {
  std::vector<Eigen::Vector2d> posts;
  const std::size_t beams = scan.range_m.size();
  const auto returned = [&](std::size_t i) {
    return static_cast<double>(scan.range_m[i]) <= scan.range_max_m;
  };
  std::size_t first = 0;
  while (first < beams) {
    std::size_t end = first + 1;
    while (returned(first) && end < beams && returned(end) &&
           std::abs(scan.range_m[end] - scan.range_m[end - 1]) < options.gap_m) {
      ++end;
    }
    if (returned(first)) add_post(scan, first, end, options, posts);
    first = end;
  }
  return posts;
}

void PostMap::remember(const std::vector<Eigen::Vector2d>& posts_base, const Pose2& T_world_base) {
  for (const Eigen::Vector2d& p_base : posts_base) {
    const Eigen::Vector2d p = in_world(T_world_base, p_base);
    const auto same = std::ranges::find_if(
        posts_, [&](const Post& post) { return (post.p_world_m - p).norm() < options_.same_m; });
    Post& post = same == posts_.end() ? posts_.emplace_back() : *same;
    if (post.seen == 0.0) post.p_world_m = p;
    post.seen += 1.0;
    post.p_world_m += (p - post.p_world_m) / post.seen;
  }
}

PostFix PostMap::locate(const std::vector<Eigen::Vector2d>& posts_base, const Pose2& guess) const {
  PostFix fix{.T_world_base = guess};
  std::vector<Pair> pairs;
  for (const Eigen::Vector2d& p_base : posts_base) {
    const Eigen::Vector2d p = in_world(guess, p_base);
    const auto distance_m = [&](const Post& post) { return (post.p_world_m - p).norm(); };
    const auto nearest = std::ranges::min_element(posts_, {}, distance_m);
    if (nearest == posts_.end() || distance_m(*nearest) > options_.same_m) continue;
    pairs.push_back({p_base, nearest->p_world_m});
  }
  if (pairs.size() < static_cast<std::size_t>(options_.min_posts)) return fix;
  if (spread_m(pairs) < options_.min_spread_m) return fix;
  const Pose2 pose = rigid_motion(pairs);
  for (const Pair& pair : pairs) {
    const Eigen::Vector2d p = in_world(pose, pair.seen_base);
    if ((p - pair.known_world).norm() > kSpoils * options_.sigma_m) return fix;
    const Eigen::Vector2d lever = p - Eigen::Vector2d(pose.x_m, pose.y_m);
    Eigen::Matrix<double, 2, 3> row;
    row << 1.0, 0.0, -lever.y(), 0.0, 1.0, lever.x();
    fix.information += row.transpose() * row / (options_.sigma_m * options_.sigma_m);
  }
  fix.T_world_base = pose;
  fix.found = true;
  return fix;
}

}  // namespace vantage
