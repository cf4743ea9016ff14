/// Which fixed geoms the moving ones can touch in the next steps.
#pragma once

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

struct mjModel_;
using mjModel = mjModel_;
struct mjData_;
using mjData = mjData_;

namespace vantage {

/// Takes fixed geoms that are far from all that moves out of MuJoCo's search for contacts, which
/// else sorts all of a building in every step. Contacts are the same to the bit.
class NearGeoms {
 public:
  explicit NearGeoms(const mjModel& model);

  /// To be called when positions jump; `at` holds the present poses of geoms.
  void start(mjModel& stepping, const mjData& at);
  /// Before each step. `at` may lag by one.
  void follow(mjModel& stepping, const mjData& at);

  [[nodiscard]] std::size_t near_count() const { return near_count_; }  ///< that may be touched

 private:
  struct Fixed {
    int geom;
    int contype;
    int conaffinity;
  };
  /// A body on joints with all that it carries.
  struct Moving {
    std::vector<int> geoms;
    Eigen::AlignedBox3d reach;  ///< leaving it asks for a new look
  };

  const mjModel& model_;
  std::vector<Fixed> fixed_;
  std::vector<Moving> moving_;
  std::size_t near_count_ = 0;
};

}  // namespace vantage
