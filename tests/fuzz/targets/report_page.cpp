// The JSON files of a run folder, made a page of.
#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/report/report.hpp"
#include "vantage/report/report_data.hpp"

namespace vantage::fuzz {
namespace {

/// What a page needs beside them.
bool put_the_rest(const InputFolder& folder) {
  folder.put("run/config.yaml", "scans: 2\n");
  folder.put("run/steps.csv", "time_s,scan\n0,1\n");
  folder.put("run/trajectory.tum", "0 0 0 0 0 0 0 1\n");
  folder.put("run/trajectory_estimated.tum", "0 0 0 0 0 0 0 1\n");
  VoxelMap map;
  map.box_m = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()};
  map.voxels.push_back({0.5F, 0.5F, 0.5F});
  write_voxels(folder.path() / "run/voxels.bin", map);
  return true;
}

}  // namespace

void read_input(std::string_view bytes, const InputFolder& folder) {
  static const bool rest = put_the_rest(folder);
  const auto parts = parts_of(bytes, 4);
  folder.put("run/manifest.json", parts[0]);
  folder.put("run/bound.json", parts[1]);
  folder.put("run/branches.json", parts[2]);
  folder.put("run/metrics.json", parts[3]);
  if (rest) write_report(folder.path() / "run", {.steps = "scans", .map = true});
}

}  // namespace vantage::fuzz
