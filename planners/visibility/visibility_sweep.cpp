#include "vantage/planners/visibility/visibility_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "vantage/core/rounding.hpp"
#include "vantage/planners/visibility/cell_walk.hpp"
#include "vantage/planners/visibility/partly_seen.hpp"
#include "vantage/planners/visibility/sweep_kernels.hpp"
#include "vantage/planners/visibility/transmittance_layer.hpp"

namespace vantage {
namespace {

/// Cells beyond those in view whose transmittance is computed, so that interpolation finds
/// neighbours.
constexpr int kMargin = 2;
/// A cell of at least this transmittance is plainly seen.
constexpr float kPlain = 0.998F;

class PyramidSweep {
 public:
  PyramidSweep(const SweepTables& tables, std::span<const SweptView> views, const Pyramid& pyramid)
      : tables_(tables),
        frame_(tables.frame),
        cells_(tables.layers[static_cast<std::size_t>(pyramid.axis)].get()),
        views_(views),
        pyramid_(pyramid),
        axes_(sweep_axes(pyramid.axis)),
        nu_(frame_.cells[axes_.u]),
        nv_(frame_.cells[axes_.v]),
        nw_(frame_.cells[axes_.w]),
        apex_m_(views.front().cone.apex_m()),
        source_((apex_m_ - frame_.min_corner_m).array() / frame_.cell_size_m.array() - 0.5),
        step_u_(Eigen::Vector3d::Unit(axes_.u) * frame_.cell_size_m[axes_.u]),
        before_(nu_, nv_),
        current_(nu_, nv_),
        arriving_(static_cast<std::size_t>(nu_) + 2 * TransmittanceLayer::kPadding),
        slanted_(static_cast<std::size_t>(nu_) + 2 * TransmittanceLayer::kPadding, 0.0F),
        utility_(static_cast<std::size_t>(nu_) + kLanes),
        kept_(utility_.size()),
        in_view_(views.size() * static_cast<std::size_t>(nv_)),
        sums_bits_(views.size(), 0.0) {
    for (const auto& [cone, options, blocks] : views) {
      bounds_.emplace_back(cone, step_u_);
      meets_.push_back(may_see(cone, pyramid, frame_.cell_size_m));
      partly_seen_.emplace_back(options.rays_per_view, options.first_share);
    }
  }

  std::vector<SampledSum> run() {
    std::vector<SampledSum> corrected(views_.size());
    if (std::ranges::none_of(meets_, [](auto meets) { return meets != 0; })) return corrected;
    const double from = source_[axes_.w];
    const int step = pyramid_.ascending ? 1 : -1;
    const int first = CellSpan::between(from, nw_, nw_).begin - (pyramid_.ascending ? 0 : 1);
    for (int w = first; w >= 0 && w < nw_; w += step) {
      layer_ = w;
      depth_ = std::abs(w - from);
      sweep_layer();
      std::swap(before_, current_);
    }
    for (std::size_t i = 0; i < views_.size(); ++i) {
      corrected[i] = SampledSum::exact(sums_bits_[i]);
      corrected[i] +=
          partly_seen_[i].sum_errors(views_[i].options.tolerance * sums_bits_[i],
                                     [&](const auto& target) { return error_bits(target); });
    }
    return corrected;
  }

 private:
  [[nodiscard]] Eigen::Array3i cell(int u, int v) const {
    Eigen::Array3i at;
    at[axes_.u] = u;
    at[axes_.v] = v;
    at[axes_.w] = layer_;
    return at;
  }

  /// Cells whose distance from the sensor along `axis` is at most the layer's depth plus `more`.
  [[nodiscard]] CellSpan within(int axis, int count, double more) const {
    const double reach = depth_ + more;
    return CellSpan::between(source_[axis] - reach, source_[axis] + reach, count);
  }

  /// The same for the cells that are this pyramid's own: ties belong to the lower axis.
  [[nodiscard]] CellSpan own(int axis, int count) const {
    constexpr double kRounding = 1e-9;
    return within(axis, count, axis > axes_.w ? kRounding : -kRounding);
  }

  void sweep_layer() {
    const auto [u, v] = bounds_in_view();
    current_.set_known(u, v);
    if (u.empty() || v.empty()) return;
    if (depth_ >= 1.0) before_.extend(reach(axes_.u, u), reach(axes_.v, v));
    const CellSpan own_v = own(axes_.v, nv_);
    for (int row = v.begin; row < v.end; ++row) {
      sweep_row(row, u);
      if (row >= own_v.begin && row < own_v.end) add_utility(row);
    }
  }

  /// The pyramid's own cells of row `v` that view `i` holds.
  [[nodiscard]] RowBounds::Runs& in_view(std::size_t i, int v) {
    return in_view_[i * static_cast<std::size_t>(nv_) + static_cast<std::size_t>(v)];
  }

  /// The cells of the layer to work out: a box round those in view. Fills `in_view_`.
  std::pair<CellSpan, CellSpan> bounds_in_view() {
    CellSpan u;
    CellSpan v;
    const CellSpan own_v = own(axes_.v, nv_);
    const CellSpan own_u = own(axes_.u, nu_);
    for (int row = own_v.begin; row < own_v.end; ++row) {
      const Eigen::Vector3d start_m = frame_.centre(cell(0, row));
      for (std::size_t i = 0; i < views_.size(); ++i) {
        if (meets_[i] == 0) continue;
        const auto& seen = in_view(i, row) =
            bounds_[i].runs_of_row(start_m, own_u.begin, own_u.end);
        for (const auto& run : seen.runs) {
          if (run.begin < run.end) v.include({row, row + 1});
          u.include({run.begin, run.end});
        }
      }
    }
    if (u.empty() || v.empty()) return {};
    const auto widen = [&](CellSpan span, int axis, int count) {
      return CellSpan{span.begin - kMargin, span.end + kMargin}.cut(within(axis, count, kMargin));
    };
    return {widen(u, axes_.u, nu_), widen(v, axes_.v, nv_)};
  }

  /// The cells of the layer before that rays to `span` cross.
  [[nodiscard]] CellSpan reach(int axis, CellSpan span) const {
    const auto crossed = [&](int i) { return i + (source_[axis] - i) / depth_; };
    return {floor_int(crossed(span.begin)) - 1, floor_int(crossed(span.end - 1)) + 3};
  }

  void sweep_row(int v, CellSpan u) {
    if (depth_ < 1.0 || layer_before() < 0 || layer_before() >= nw_) return see_all(v, u);
    const double lateral = (source_[axes_.v] - v) / depth_;
    const int shift = floor_int(lateral);
    const CellSpan needed = reach(axes_.u, u);
    blend_rows(before_.row(v + shift), before_.row(v + shift + 1),
               static_cast<float>(lateral - shift), needed.begin, needed.end,
               arriving_.data() + TransmittanceLayer::kPadding);
    const int v_slanted = v + floor_int(lateral + 0.5);
    copy_slanted(v_slanted, needed);
    SweepRow row;
    row.arriving = arriving_.data() + TransmittanceLayer::kPadding;
    row.cells = cells_ + row_start(v, layer_);
    row.straight = cells_ + row_start(v, layer_before());
    row.slanted = slanted_.data() + TransmittanceLayer::kPadding;
    row.straight_depth = depth_of(v);
    row.slanted_depth = depth_of(v_slanted);
    row.source = static_cast<float>(source_[axes_.u]);
    row.depth = static_cast<float>(depth_);
    row.across = static_cast<float>(std::abs(lateral));
    advance_in_runs(row, u, v);
  }

  /// Nothing stands between the sensor and the cells round it.
  void see_all(int v, CellSpan u) {
    const float* cells = cells_ + row_start(v, layer_);
    std::fill(current_.row(v) + u.begin, current_.row(v) + u.end, 1.0F);
    for (int i = u.begin; i < u.end; ++i)
      utility_[static_cast<std::size_t>(i)] = std::max(cells[i], 0.0F);
  }

  /// Beyond the grid there is nothing: the padding stays 0.
  void copy_slanted(int v, CellSpan needed) {
    const CellSpan inside = needed.cut({0, nu_});
    float* cells = slanted_.data() + TransmittanceLayer::kPadding;
    if (v < 0 || v >= nv_) {
      std::fill(cells + inside.begin, cells + inside.end, 0.0F);
    } else {
      const float* row = cells_ + row_start(v, layer_before());
      std::copy(row + inside.begin, row + inside.end, cells + inside.begin);
    }
  }

  /// Optical depths of the unobserved cells of row `v` in the layer before.
  [[nodiscard]] const float* depth_of(int v) const {
    return tables_.row_of_depths(axes_.w, std::clamp(v, 0, nv_ - 1), layer_before());
  }

  /// Along a row, the crossed cell moves against the cell itself at most a few times.
  void advance_in_runs(const SweepRow& row, CellSpan u, int v) {
    for (int begin = u.begin; begin < u.end;) {
      const int shift = floor_int((source_[axes_.u] - begin) / depth_);
      // (source - i) / depth >= shift
      const int last = floor_int(source_[axes_.u] - shift * depth_);
      const int end = std::clamp(last + 1, begin + 1, u.end);
      advance_row(row, shift, begin, end, current_.row(v), utility_.data());
      begin = end;
    }
  }

  void add_utility(int v) {
    for (std::size_t i = 0; i < views_.size(); ++i) {
      const RowBounds::Runs& seen = in_view(i, v);
      for (const auto& [begin, end] : seen.runs) {
        if (begin < end) add_run(i, v, begin, end, seen.exact);
      }
    }
  }

  void add_run(std::size_t i, int v, int begin, int end, bool all_inside) {
    ConeRow view;
    const float* seen = utility_.data();
    if (!all_inside) {
      view = views_[i].cone.row(frame_.centre(cell(0, v)), step_u_);
      keep_in_view(view, utility_.data(), begin, end, kept_.data());
      seen = kept_.data();
    }
    const double seen_bits = sum_run(seen, begin, end);
    sums_bits_[i] += seen_bits;
    if (views_[i].blocks != nullptr && seen_bits > 0.0) {
      views_[i].blocks->add(seen, axes_.u, cell(begin, v), end);
    }
    const float* cells = cells_ + row_start(v, layer_);
    partly_seen_[i].offer(end - begin, [&](int k) {
      const int u = begin + k;
      const bool doubtful =
          cells[u] > 0.0F && in_doubt(u, v) && (all_inside || view.contains(static_cast<float>(u)));
      return PartlySeen::Cell{
          .cell = cell(u, v), .visible = current_.row(v)[u], .weight = doubtful ? cells[u] : 0.0F};
    });
  }

  /// Neither plainly seen, nor hidden like its neighbours.
  [[nodiscard]] bool in_doubt(int u, int v) {
    const float* row = current_.row(v);
    if (row[u] >= kPlain) return false;
    return row[u] > kDark || row[u - 1] > kDark || row[u + 1] > kDark ||
           current_.row(v - 1)[u] > kDark;
  }

  /// Utility of the cell by an exact ray, less that by the sweep.
  [[nodiscard]] double error_bits(const PartlySeen::Cell& target) const {
    float depth = 0.0F;
    const auto pass = [&](std::size_t cell) {
      depth += tables_.optical_depth(cell);
      return depth < kOpaque;
    };
    const bool arrives = walk_to_cell(frame_, apex_m_, target.cell, pass);
    const float visible = arrives ? std::exp(-depth) : 0.0F;
    return static_cast<double>(target.weight *
                               (visible - (target.visible > kDark ? target.visible : 0.0F)));
  }

  [[nodiscard]] int layer_before() const { return layer_ + (pyramid_.ascending ? -1 : 1); }

  [[nodiscard]] std::size_t row_start(int v, int w) const {
    return (static_cast<std::size_t>(w) * static_cast<std::size_t>(nv_) +
            static_cast<std::size_t>(v)) *
           static_cast<std::size_t>(nu_);
  }

  const SweepTables& tables_;
  const GridFrame& frame_;
  const float* cells_;  ///< the layers along the pyramid's axis
  std::span<const SweptView> views_;
  Pyramid pyramid_;
  SweepAxes axes_;
  int nu_;
  int nv_;
  int nw_;
  Eigen::Vector3d apex_m_;
  Eigen::Array3d source_;  ///< of the rays, in cells; whole numbers are centres
  Eigen::Vector3d step_u_;
  std::vector<RowBounds> bounds_;    ///< per view
  std::vector<std::uint8_t> meets_;  ///< per view: has it a part in the pyramid?
  TransmittanceLayer before_;
  TransmittanceLayer current_;
  std::vector<float> arriving_;
  std::vector<float> slanted_;
  std::vector<float> utility_;
  std::vector<float> kept_;               ///< of it, what a view holds
  std::vector<RowBounds::Runs> in_view_;  ///< per view and row
  std::vector<double> sums_bits_;
  std::vector<PartlySeen> partly_seen_;  ///< per view
  int layer_ = 0;
  double depth_ = 0.0;  ///< layers from the sensor
};

}  // namespace

std::vector<SampledSum> sweep_pyramid(const SweepTables& tables, std::span<const SweptView> views,
                                      const Pyramid& pyramid) {
  return PyramidSweep(tables, views, pyramid).run();
}

}  // namespace vantage
