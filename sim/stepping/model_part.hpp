/// A model without most of what stands still.
#pragma once

#include <mujoco/mujoco.h>

#include <cstddef>
#include <span>
#include <vector>

namespace vantage {

/// A view of a model that lists only some of its static geoms and bodies, in their order, so that
/// MuJoCo's loops over all of them pass by what a step does not ask for. Everything that can move
/// is listed always. What comes of it is the same to the bit, but for sums over all that stands
/// still, which no motion depends on.
class ModelPart {
 public:
  /// Lists no static geom yet. @param model outlives this; what changes in it is seen when listed
  explicit ModelPart(const mjModel& model);
  ModelPart(const ModelPart&) = delete;
  ModelPart& operator=(const ModelPart&) = delete;

  /// Lists static geoms whose flag is set; what moves and has none keeps out of contacts.
  void list(std::span<const char> flags);
  /// Lists no static geom.
  void list_moving();

  /// Calls `f` with this model and data of the whole model, of which it sees what is listed.
  template <class F>
  void run(mjData& data, F&& f) {
    const Swapped swapped(*this, data);
    f(part_, data);
  }

  [[nodiscard]] int geoms() const { return part_.ngeom; }
  /// Id in the whole model of a geom that is listed here.
  [[nodiscard]] int geom_id(int listed) const { return geoms_[static_cast<std::size_t>(listed)]; }

 private:
  /// Rows that follow on each other in the whole model and here.
  struct Run {
    std::size_t from;
    std::size_t to;
    std::size_t count;
  };
  struct Rows {
    const void* source = nullptr;  ///< in the whole model
    std::vector<std::byte> own;
  };
  /// An array that names bodies.
  struct BodyIds {
    const int* source;
    std::vector<int> own;
  };
  /// While it lives, data's arrays are those of the part.
  class Swapped {
   public:
    Swapped(ModelPart& part, mjData& data);
    ~Swapped();
    Swapped(const Swapped&) = delete;
    Swapped& operator=(const Swapped&) = delete;

   private:
    ModelPart& part_;
    mjData& data_;
  };

  void find_always_listed();
  void gather_rows();
  void rename_bodies();
  [[nodiscard]] const std::vector<Run>& runs(bool of_bodies) const {
    return of_bodies ? body_runs_ : geom_runs_;
  }
  [[nodiscard]] static std::vector<Run> runs_of(const std::vector<int>& ids);

  const mjModel& model_;
  mjModel part_;
  bool lists_all_;            ///< the model refers to geoms or bodies in ways not followed here
  std::vector<char> always_;  ///< of bodies
  std::vector<char> moving_;  ///< of geoms
  std::vector<int> bodies_;   ///< listed ones, ascending
  std::vector<int> geoms_;
  std::vector<int> new_body_;  ///< of each body its place in bodies_
  std::vector<Run> body_runs_;
  std::vector<Run> geom_runs_;
  std::vector<Rows> model_rows_;
  std::vector<Rows> data_rows_;
  std::vector<BodyIds> body_ids_;
  std::vector<int> excludes_;
};

}  // namespace vantage
