// Taking scans into the map: ours, and OctoMap's insertPointCloud on the same images, cell by
// cell of the same edge.
#include <octomap/octomap.h>

#include <filesystem>
#include <memory>

#include "bench/measures.hpp"
#include "bench/situation.hpp"
#include "vantage/belief/map/free_space.hpp"
#include "vantage/belief/map/sensor_model.hpp"
#include "vantage/core/log.hpp"
#include "vantage/perception/clouds/point_cloud.hpp"
#include "vantage/tasks/exploration/exploration_session.hpp"

namespace vantage::bench {
namespace {
namespace fs = std::filesystem;

constexpr double kEdge_m = 0.05;

/// A scan of the head: images that were taken where the robot took itself to stand.
struct Scan {
  std::vector<HeadView> views;
  Pose T_world_base;

  [[nodiscard]] std::vector<PosedImage> images() const {
    std::vector<PosedImage> posed;
    for (const HeadView& view : views) {
      posed.push_back({view.image, T_world_base * view.T_base_camera});
    }
    return posed;
  }
};

class Scanning : public ExplorationParts {
 public:
  using ExplorationParts::ExplorationParts;

  void update(const ExplorationObservation& observation) {
    ExplorationParts::update(observation);
    scans.push_back({observation.views, to_se3(robot_.estimated_base())});
  }

  std::vector<Scan> scans;
};

std::vector<Scan> scans_of_office(const Exploration& task, const RunRequest& request) {
  ExplorationSession<Scanning> session(request, task);
  run_episode(session.parts);
  return std::move(session.parts.scans);
}

/// Cubes whose faces are those of OctoMap's.
OccupancyGrid empty_grid() {
  GridFrame frame;
  frame.min_corner_m = {-7.5, -5.0, 0.0};
  frame.cell_size_m = Eigen::Vector3d::Constant(kEdge_m);
  frame.cells = {300, 200, 40};
  return OccupancyGrid(frame);
}

/// @param stride_px of the pixels that mark surfaces; all carve
OccupancyGrid integrate(const std::vector<Scan>& scans, const Exploration& task, int stride_px,
                        int threads) {
  OccupancyGrid grid = empty_grid();
  for (const Scan& scan : scans) {
    const auto images = scan.images();
    PointCloud points;
    for (const auto& [image, T_world_camera] : images) {
      append(points, transform(to_cloud(image, stride_px), T_world_camera));
    }
    add_measurements(grid, points.points, task.sensor_model, threads);
    carve_free_space(grid, images, task.free_space, threads);
  }
  return grid;
}

struct Insertion {
  int stride_px = 1;        ///< 1: the whole images, which we carve by too
  bool discretise = false;  ///< one of the points in a voxel for all: OctoMap's faster way
};

std::unique_ptr<octomap::OcTree> insert(const std::vector<Scan>& scans, const Insertion& how) {
  auto tree = std::make_unique<octomap::OcTree>(kEdge_m);
  for (const Scan& scan : scans) {
    for (const auto& [image, T_world_camera] : scan.images()) {
      octomap::Pointcloud cloud;
      for (const Eigen::Vector3f& p :
           transform(to_cloud(image, how.stride_px), T_world_camera).points) {
        cloud.push_back(p.x(), p.y(), p.z());
      }
      const Eigen::Vector3f p = T_world_camera.translation().cast<float>();
      tree->insertPointCloud(cloud, {p.x(), p.y(), p.z()}, -1.0, true, how.discretise);
    }
  }
  tree->updateInnerOccupancy();
  return tree;
}

/// Cells that both know, and those that both call the same.
struct Overlap {
  double both = 0.0;
  double same = 0.0;
  double ours = 0.0;     ///< known cells
  double octomap = 0.0;  ///< of those in the grid's box
};

Overlap overlap(const OccupancyGrid& grid, const octomap::OcTree& tree) {
  Overlap overlap;
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    const Eigen::Vector3d p = grid.frame.centre(grid.frame.cell(cell));
    const octomap::OcTreeNode* node = tree.search(p.x(), p.y(), p.z());
    const CellState state = grid.state(cell);
    overlap.octomap += node != nullptr ? 1.0 : 0.0;
    overlap.ours += state != CellState::unobserved ? 1.0 : 0.0;
    if (node == nullptr || state == CellState::unobserved) continue;
    overlap.both += 1.0;
    overlap.same += tree.isNodeOccupied(node) == (state == CellState::occupied) ? 1.0 : 0.0;
  }
  return overlap;
}

void run_benchmark() {
  const fs::path directory = fs::temp_directory_path() / "vantage_bench_integration";
  fs::create_directories(directory);
  const auto resolved = load_episode("assets/episodes/office_small.yaml", {"scans=4"});
  const auto& task = std::get<Exploration>(resolved.task);
  const RunRequest request = lean_request(resolved, directory);
  const std::vector<Scan> scans = scans_of_office(task, request);
  fs::remove_all(directory);

  constexpr int kRepeats = 3;
  const auto count = static_cast<double>(scans.size());
  OccupancyGrid grid;
  const auto ours_ms = [&](int stride_px, int threads) {
    return median_ms(kRepeats, [&] { grid = integrate(scans, task, stride_px, threads); }) / count;
  };
  std::unique_ptr<octomap::OcTree> tree;
  const auto octomap_ms = [&](const Insertion& how) {
    return median_ms(1, [&] { tree = insert(scans, how); }) / count;
  };
  std::vector<std::pair<std::string, double>> figures;
  const auto add = [&](const std::string& name, double figure) {
    figures.emplace_back(name, figure);
  };
  const double every_ms = octomap_ms({.discretise = false});
  const double every_ours_ms = ours_ms(1, 1);
  const Overlap every = overlap(grid, *tree);
  const double discretised_ms = octomap_ms({.discretise = true});
  const double marked_ms = octomap_ms({.stride_px = task.stride_px});
  const double scan_ms = ours_ms(task.stride_px, 1);
  add("scan_ms", scan_ms);
  add("scan_two_threads_ms", ours_ms(task.stride_px, kThreads));
  add("every_pixel_scan_ms", every_ours_ms);
  add("octomap_scan_ms", every_ms);
  add("octomap_discretised_scan_ms", discretised_ms);
  add("octomap_marked_pixels_scan_ms", marked_ms);
  add("octomap_over_ours", every_ms / scan_ms);
  add("octomap_over_ours_every_pixel", every_ms / every_ours_ms);
  add("octomap_discretised_over_ours", discretised_ms / scan_ms);
  add("octomap_marked_pixels_over_ours", marked_ms / scan_ms);
  add("known_cells", every.ours);
  add("octomap_known_cells", every.octomap);
  add("both_know_cells", every.both);
  add("same_state_share", every.same / every.both);
  print_figures("integration", 1, request.config, figures);
}

}  // namespace
}  // namespace vantage::bench

int main() { return vantage::bench::run_main(vantage::bench::run_benchmark); }
