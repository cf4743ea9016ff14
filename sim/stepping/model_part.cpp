#include "vantage/sim/stepping/model_part.hpp"

#include <mujoco/mjxmacro.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <string_view>

namespace vantage {
namespace {

enum class RowOf { body, geom, other };

constexpr RowOf row_of(std::string_view count) {
  if (count == "nbody") return RowOf::body;
  return count == "ngeom" ? RowOf::geom : RowOf::other;
}

/// Calls `f` with the pointer to each array of bodies or geoms, the bytes of its rows, and whether
/// they are of bodies.
// NOLINTNEXTLINE(google-readability-function-size): as many as MuJoCo's model has arrays
void for_each_array(mjModel& model, auto&& f) {
  const mjModel* m = &model;
#undef MJ_M
#define MJ_M(n) m->n
#define X(type, name, nr, nc)                                                               \
  if constexpr (row_of(#nr) != RowOf::other) {                                              \
    f(model.name, sizeof(type) * static_cast<std::size_t>(nc), row_of(#nr) == RowOf::body); \
  }
  MJMODEL_POINTERS
#undef X
}

void for_each_array(const mjModel& model, mjData& data, auto&& f) {
  const mjModel* m = &model;
#define X(type, name, nr, nc)                                                              \
  if constexpr (row_of(#nr) != RowOf::other) {                                             \
    f(data.name, sizeof(type) * static_cast<std::size_t>(nc), row_of(#nr) == RowOf::body); \
  }
  MJDATA_POINTERS
#undef X
#undef MJ_M
}

/// Arrays besides those of bodies and geoms that name bodies; -1 is none.
std::array<std::pair<int**, int>, 7> arrays_of_body_ids(mjModel& m) {
  return {{{&m.jnt_bodyid, m.njnt},
           {&m.dof_bodyid, m.nv},
           {&m.site_bodyid, m.nsite},
           {&m.cam_bodyid, m.ncam},
           {&m.cam_targetbodyid, m.ncam},
           {&m.light_bodyid, m.nlight},
           {&m.light_targetbodyid, m.nlight}}};
}

bool any_of(const int* values, int count, std::initializer_list<int> wanted) {
  return std::any_of(values, values + count, [&](int value) {
    return std::find(wanted.begin(), wanted.end(), value) != wanted.end();
  });
}

/// Of pairs, tendons, constraints, sensors and actuators that name geoms or bodies.
bool names_what_may_be_left_out(const mjModel& m) {
  const auto bodies_or_geoms = {int{mjOBJ_BODY}, int{mjOBJ_XBODY}, int{mjOBJ_GEOM}};
  return m.npair > 0 || m.nwrap > 0 ||
         any_of(m.eq_type, m.neq, {mjEQ_CONNECT, mjEQ_WELD, mjEQ_DISTANCE}) ||
         any_of(m.sensor_objtype, m.nsensor, bodies_or_geoms) ||
         any_of(m.sensor_reftype, m.nsensor, bodies_or_geoms) ||
         any_of(m.actuator_trntype, m.nu, {mjTRN_BODY});
}

constexpr int kSignatureBits = 16;
constexpr int kSignatureMask = (1 << kSignatureBits) - 1;

std::array<int, 2> excluded_bodies(int signature) {
  return {(signature >> kSignatureBits) - 1, (signature & kSignatureMask) - 1};
}

int signature_of(int body, int other) { return ((body + 1) << kSignatureBits) + other + 1; }

bool moves(const mjModel& m, int body) {
  return m.body_weldid[body] != 0 || m.body_mocapid[m.body_rootid[body]] >= 0;
}

}  // namespace

std::vector<ModelPart::Run> ModelPart::runs_of(const std::vector<int>& ids) {
  std::vector<Run> runs;
  for (std::size_t to = 0; to < ids.size(); ++to) {
    const auto from = static_cast<std::size_t>(ids[to]);
    if (runs.empty() || runs.back().from + runs.back().count != from) runs.push_back({from, to, 0});
    ++runs.back().count;
  }
  return runs;
}

ModelPart::ModelPart(const mjModel& model)
    : model_(model), part_(model), lists_all_(names_what_may_be_left_out(model)) {
  for_each_array(part_, [&](auto*& array, std::size_t bytes, bool of_bodies) {
    const auto rows = static_cast<std::size_t>(of_bodies ? model.nbody : model.ngeom);
    model_rows_.push_back({array, std::vector<std::byte>(rows * bytes)});
    array =
        reinterpret_cast<std::remove_reference_t<decltype(array)>>(model_rows_.back().own.data());
  });
  mjData names_only{};
  for_each_array(part_, names_only, [&](auto*&, std::size_t bytes, bool of_bodies) {
    const auto rows = static_cast<std::size_t>(of_bodies ? model.nbody : model.ngeom);
    data_rows_.push_back({nullptr, std::vector<std::byte>(rows * bytes)});
  });
  for (const auto& [ids, count] : arrays_of_body_ids(part_)) {
    body_ids_.push_back({*ids, std::vector<int>(*ids, *ids + count)});
  }
  excludes_.assign(model.exclude_signature, model.exclude_signature + model.nexclude);
  find_always_listed();
  list_moving();
}

void ModelPart::list_moving() {
  list(std::vector<char>(static_cast<std::size_t>(model_.ngeom), 0));
}

void ModelPart::find_always_listed() {
  always_.assign(static_cast<std::size_t>(model_.nbody), lists_all_ ? 1 : 0);
  const auto add = [&](int body) {
    for (; body > 0; body = model_.body_parentid[body]) always_[static_cast<std::size_t>(body)] = 1;
  };
  always_[0] = 1;
  std::vector<char> moving_root(always_.size(), 0);
  for (int body = 0; body < model_.nbody; ++body) {
    if (moves(model_, body)) moving_root[static_cast<std::size_t>(model_.body_rootid[body])] = 1;
  }
  for (int body = 1; body < model_.nbody; ++body) {  // sums over a tree are of all of it
    if (moving_root[static_cast<std::size_t>(model_.body_rootid[body])] != 0) add(body);
  }
  for (const BodyIds& ids : body_ids_) {
    for (const int body : ids.own) add(body);
  }
  for (const int signature : excludes_) {
    for (const int body : excluded_bodies(signature)) add(body);
  }
  moving_.resize(static_cast<std::size_t>(model_.ngeom));
  for (int geom = 0; geom < model_.ngeom; ++geom) {
    moving_[static_cast<std::size_t>(geom)] = moves(model_, model_.geom_bodyid[geom]) ? 1 : 0;
  }
}

void ModelPart::list(std::span<const char> flags) {
  std::vector<char> body_listed = always_;
  geoms_.clear();
  for (int geom = 0; geom < model_.ngeom; ++geom) {
    const auto i = static_cast<std::size_t>(geom);
    if (!lists_all_ && moving_[i] == 0 && flags[i] == 0) continue;
    geoms_.push_back(geom);
    for (int body = model_.geom_bodyid[geom]; body > 0; body = model_.body_parentid[body]) {
      body_listed[static_cast<std::size_t>(body)] = 1;
    }
  }
  bodies_.clear();
  new_body_.assign(body_listed.size(), -1);
  for (std::size_t body = 0; body < body_listed.size(); ++body) {
    if (body_listed[body] == 0) continue;
    new_body_[body] = static_cast<int>(bodies_.size());
    bodies_.push_back(static_cast<int>(body));
  }
  body_runs_ = runs_of(bodies_);
  geom_runs_ = runs_of(geoms_);
  gather_rows();
  rename_bodies();
  for (std::size_t i = 0; i < geoms_.size(); ++i) {
    if (flags[static_cast<std::size_t>(geoms_[i])] != 0) continue;
    part_.geom_contype[i] = part_.geom_conaffinity[i] = 0;
  }
}

void ModelPart::gather_rows() {
  std::size_t column = 0;
  for_each_array(part_, [&](auto*&, std::size_t bytes, bool of_bodies) {
    Rows& rows = model_rows_[column++];
    const auto* source = static_cast<const std::byte*>(rows.source);
    for (const Run& run : runs(of_bodies)) {
      std::copy_n(source + run.from * bytes, run.count * bytes, rows.own.data() + run.to * bytes);
    }
  });
  part_.nbody = static_cast<int>(bodies_.size());
  part_.ngeom = static_cast<int>(geoms_.size());
}

void ModelPart::rename_bodies() {
  const auto renamed = [&](int body) {
    return body < 0 ? body : new_body_[static_cast<std::size_t>(body)];
  };
  for (int* ids : {part_.body_parentid, part_.body_rootid, part_.body_weldid}) {
    std::transform(ids, ids + part_.nbody, ids, renamed);
  }
  std::fill_n(part_.body_geomnum, part_.nbody, 0);
  std::fill_n(part_.body_geomadr, part_.nbody, -1);
  for (int geom = 0; geom < part_.ngeom; ++geom) {
    const int body = renamed(part_.geom_bodyid[geom]);
    part_.geom_bodyid[geom] = body;
    if (part_.body_geomnum[body]++ == 0) part_.body_geomadr[body] = geom;
  }
  std::size_t array = 0;
  for (const auto& [ids, count] : arrays_of_body_ids(part_)) {
    BodyIds& named = body_ids_[array++];
    std::transform(named.source, named.source + count, named.own.begin(), renamed);
    *ids = named.own.data();
  }
  for (std::size_t i = 0; i < excludes_.size(); ++i) {
    const auto [body, other] = excluded_bodies(model_.exclude_signature[i]);
    excludes_[i] = signature_of(renamed(body), renamed(other));
  }
  part_.exclude_signature = excludes_.data();
}

/// The arrays that are swapped in hold the rows of the part, those that are swapped out the others.
ModelPart::Swapped::Swapped(ModelPart& part, mjData& data) : part_(part), data_(data) {
  std::size_t column = 0;
  for_each_array(part_.part_, data_, [&](auto*& array, std::size_t bytes, bool of_bodies) {
    Rows& rows = part_.data_rows_[column++];
    const auto* whole = reinterpret_cast<const std::byte*>(array);
    for (const Run& run : part_.runs(of_bodies)) {
      std::copy_n(whole + run.from * bytes, run.count * bytes, rows.own.data() + run.to * bytes);
    }
    rows.source = array;
    array = reinterpret_cast<std::remove_reference_t<decltype(array)>>(rows.own.data());
  });
}

ModelPart::Swapped::~Swapped() {
  std::size_t column = 0;
  for_each_array(part_.part_, data_, [&](auto*& array, std::size_t bytes, bool of_bodies) {
    Rows& rows = part_.data_rows_[column++];
    auto* whole = const_cast<std::byte*>(static_cast<const std::byte*>(rows.source));
    for (const Run& run : part_.runs(of_bodies)) {
      std::copy_n(rows.own.data() + run.to * bytes, run.count * bytes, whole + run.from * bytes);
    }
    array = reinterpret_cast<std::remove_reference_t<decltype(array)>>(whole);
  });
}

}  // namespace vantage
