/// Pictures of objects that may become observations: of each direction the nearest, until it is
/// clear that there will be no nearer one.
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "vantage/recognition/object_looks.hpp"
#include "vantage/perception/object_search.hpp"

namespace vantage {

struct KeptLook {
  int id = 0;
  int direction = 0;
  SeenObject seen;
  Pose T_world_camera = Pose::Identity();  ///< as estimated
  double time_s = 0.0;
};

class KeptLooks {
 public:
  explicit KeptLooks(const LookOptions& options) : options_(options) {}

  /// The object is in view, though perhaps not for a look.
  void sighted(int id, double time_s) { sighted_s_[id] = time_s; }
  /// Whether a picture from so far is nearer than what is kept of that direction.
  [[nodiscard]] bool improves(int id, int direction, double distance_m) const;
  /// In place of what was kept of its direction.
  void keep(KeptLook look);
  void forget(int id);
  /// Those that are due, nearest first; they are no longer kept.
  /// @param direction_of an object, that the camera is in now
  std::vector<KeptLook> take_due(double time_s, const std::function<int(int id)>& direction_of);
  /// All, nearest first.
  std::vector<KeptLook> take_all();

 private:
  [[nodiscard]] bool due(const KeptLook& look, double time_s, int direction) const;

  LookOptions options_;
  std::vector<KeptLook> kept_;
  std::map<int, double> sighted_s_;  ///< last, by id
};

}  // namespace vantage
