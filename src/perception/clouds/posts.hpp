/// Posts, such as the legs of a table, in a line of a planar scanner: what a robot without walls
/// localises by.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/geometry/range_scan.hpp"

namespace vantage {

struct PostOptions {
  int min_beams = 3;
  double max_width_m = 0.25;
  double gap_m = 0.12;
  double same_m = 0.12;
  double sigma_m = 0.015;
  int min_posts = 3;
  double min_spread_m = 0.3;
  void fields(auto&& f) {
    f("min_beams", min_beams,
      "least number of neighbouring returns that make a post; higher finds fewer, surer ones",
      between(1, 100));
    f("max_width_m", max_width_m, "greatest width of a post; higher takes wider things for posts",
      above(0.0));
    f("gap_m", gap_m,
      "step in range between neighbouring beams that parts a post from what is beside it; higher "
      "finds fewer",
      above(0.0));
    f("same_m", same_m,
      "distance within which a post is taken for a remembered one; higher tolerates a worse guess",
      above(0.0));
    f("sigma_m", sigma_m,
      "standard deviation of the middle of a post; one four times as far from its place spoils the "
      "fix",
      above(0.0));
    f("min_posts", min_posts, "least number of posts that fix a pose", between(2, 1000));
    f("min_spread_m", min_spread_m,
      "least distance of the posts from their middle, RMS, below which they leave the heading open",
      above(0.0));
  }
};

/// The middles of posts, base frame: the returns are of their near side. One that may be partly
/// hidden is left out.
std::vector<Eigen::Vector2d> find_posts(const PlanarScan& scan, const PostOptions& options);

struct PostFix {
  Pose2 T_world_base;  ///< the guess unless found
  bool found = false;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< of (x, y, yaw)
};

/// Posts in the world, each the mean of where it was seen.
class PostMap {
 public:
  explicit PostMap(const PostOptions& options = {}) : options_(options) {}

  void remember(const std::vector<Eigen::Vector2d>& posts_base, const Pose2& T_world_base);
  /// Where the posts seen say that the base is: each paired with the one remembered that is nearest
  /// from the guess, the rigid motion of least squares.
  [[nodiscard]] PostFix locate(const std::vector<Eigen::Vector2d>& posts_base,
                               const Pose2& guess) const;
  [[nodiscard]] std::size_t size() const { return posts_.size(); }

 private:
  struct Post {
    Eigen::Vector2d p_world_m;
    double seen = 0.0;
  };
  PostOptions options_;
  std::vector<Post> posts_;
};

}  // namespace vantage
