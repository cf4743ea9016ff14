/// Which geoms can touch another in the next steps.
#pragma once

#include <Eigen/Geometry>

#include <cstddef>
#include <map>
#include <vector>

struct mjModel_;
using mjModel = mjModel_;
struct mjData_;
using mjData = mjData_;

namespace vantage {

/// Takes geoms with nothing near out of MuJoCo's search for contacts, which else sorts all of a
/// building and asks each part of a robot for the floor in every step. Contacts are the same to the
/// bit.
class NearGeoms {
 public:
  /// @param model outlives this
  explicit NearGeoms(const mjModel& model);

  /// Sets the masks of `stepping`, a copy of the model. To be called when positions jump; `at`
  /// holds the present poses of geoms.
  void start(mjModel& stepping, const mjData& at);
  /// Before each step. `at` may lag by one.
  void follow(mjModel& stepping, const mjData& at);

  [[nodiscard]] bool is_near(int geom) const { return near_[static_cast<std::size_t>(geom)] != 0; }

 private:
  /// A body on joints with all that it carries.
  struct Tree {
    std::vector<int> geoms;
    Eigen::AlignedBox3d reach;  ///< world, of all of them
  };

  [[nodiscard]] Eigen::AlignedBox3d reach_of(int geom) const;
  [[nodiscard]] bool meets_unbounded(int moving, int fixed, const mjData& at) const;
  void mark_pair(int geom, int other);
  void mark_beside_fixed(const Tree& tree, const mjData& at);
  void mark_beside_moving(const Tree& tree, const Tree& other);

  const mjModel& model_;
  std::vector<int> fixed_;
  std::map<int, Tree> trees_;             ///< by the body that they hang on
  std::vector<Eigen::Vector3d> started_;  ///< where geoms were then, world
  std::vector<char> near_;                ///< of each geom
};

}  // namespace vantage
