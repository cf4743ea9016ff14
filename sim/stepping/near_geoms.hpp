/// Which geoms can touch another in the next steps.
#pragma once

#include <Eigen/Geometry>

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <vector>

struct mjModel_;
using mjModel = mjModel_;
struct mjData_;
using mjData = mjData_;

namespace vantage {

class ModelPart;

/// Takes geoms with nothing near out of MuJoCo's steps, which else place all of a building, sort
/// it, and ask each part of a robot for the floor, every time. Steps are the same to the bit.
class NearGeoms {
 public:
  /// @param model outlives this
  explicit NearGeoms(const mjModel& model);
  ~NearGeoms();

  /// To be called before the first step and when positions jump; `at` holds the present poses of
  /// geoms.
  void start(const mjData& at);
  /// Sees whether others are near by now. `at` may lag by a step.
  void follow(const mjData& at);
  /// One step of MuJoCo. Poses of what stands still and is not near are left as they were.
  void step(mjData& data);

  [[nodiscard]] bool is_near(int geom) const { return near_[static_cast<std::size_t>(geom)] != 0; }
  [[nodiscard]] const ModelPart& stepped() const { return *stepped_; }

 private:
  /// A body on joints with all that it carries.
  struct Tree {
    std::vector<int> geoms;
    Eigen::AlignedBox3d reach;  ///< world, of all of them
  };

  /// A geom without a joint.
  struct Fixed {
    int geom;
    bool bounded;                                         ///< stays in its box
    Eigen::AlignedBox3d box_m = {};                       ///< world
    Eigen::Vector3d p_world_m = Eigen::Vector3d::Zero();  ///< of planes, with the normal
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  };

  [[nodiscard]] Eigen::AlignedBox3d reach_of(int geom) const;
  [[nodiscard]] bool meets_unbounded(int moving, const Fixed& fixed) const;
  void place_fixed(const mjData& at);
  void look_anew(const mjData& at);
  void mark_pair(int geom, int other);
  void mark_beside_fixed(const Tree& tree);
  void mark_beside_moving(const Tree& tree, const Tree& other);

  const mjModel& model_;
  std::unique_ptr<ModelPart> stepped_;
  std::vector<Fixed> fixed_;
  std::map<int, Tree> trees_;             ///< by the body that they hang on
  std::vector<Eigen::Vector3d> started_;  ///< where geoms were then, world
  std::vector<char> near_;                ///< of each geom; of what nothing can touch never
};

}  // namespace vantage
