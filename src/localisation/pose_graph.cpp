#include "vantage/localisation/pose_graph.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <ceres/ceres.h>

#include <array>
#include <cmath>
#include <limits>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using Block = std::array<double, 3>;

/// Row by row.
void write(const Eigen::MatrixXd& matrix, double* to) {
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) *to++ = matrix(row, column);
  }
}

/// S with S^T S = information, which may lack directions.
Eigen::Matrix3d square_root(const Eigen::Matrix3d& information) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(information);
  const Eigen::Vector3d scale = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  return scale.asDiagonal() * solver.eigenvectors().transpose();
}

struct Linearised {
  Eigen::Vector3d error;
  Eigen::Matrix3d by_from;
  Eigen::Matrix3d by_to;
};

/// R(from)^T (p_to - p_from) - t and the turn, with their derivatives.
Linearised linearised(const Pose2& measured, const double* from, const double* to) {
  const double c = std::cos(from[2]);
  const double s = std::sin(from[2]);
  const double dx = to[0] - from[0];
  const double dy = to[1] - from[1];
  Linearised at;
  at.error << c * dx + s * dy - measured.x_m, -s * dx + c * dy - measured.y_m,
      wrap_angle(to[2] - from[2] - measured.yaw_rad);
  at.by_from << -c, -s, -s * dx + c * dy, s, -c, -c * dx - s * dy, 0.0, 0.0, -1.0;
  at.by_to << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0;
  return at;
}

class EdgeCost : public ceres::SizedCostFunction<3, 3, 3> {
 public:
  explicit EdgeCost(const PoseEdge& edge)
      : measured_(edge.T_from_to), root_(square_root(edge.information)) {}

  bool Evaluate(double const* const* poses, double* residuals, double** jacobians) const override {
    const Linearised at = linearised(measured_, poses[0], poses[1]);
    write(root_ * at.error, residuals);
    if (jacobians == nullptr) return true;
    if (jacobians[0] != nullptr) write(root_ * at.by_from, jacobians[0]);
    if (jacobians[1] != nullptr) write(root_ * at.by_to, jacobians[1]);
    return true;
  }

 private:
  Pose2 measured_;
  Eigen::Matrix3d root_;
};

Block block_of(const Pose2& pose) { return {pose.x_m, pose.y_m, pose.yaw_rad}; }

/// J^T J of all poses but the first.
Eigen::SparseMatrix<double> normal_matrix(std::span<const Pose2> poses,
                                          std::span<const PoseEdge> edges) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](std::size_t row, std::size_t column, const Eigen::Matrix3d& block) {
    if (row == 0 || column == 0) return;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        entries.emplace_back(static_cast<int>(3 * (row - 1)) + r,
                             static_cast<int>(3 * (column - 1)) + c, block(r, c));
      }
    }
  };
  for (const PoseEdge& edge : edges) {
    const Linearised at = linearised(edge.T_from_to, block_of(poses[edge.from]).data(),
                                     block_of(poses[edge.to]).data());
    const Eigen::Matrix3d weighted_from = edge.information * at.by_from;
    const Eigen::Matrix3d weighted_to = edge.information * at.by_to;
    add(edge.from, edge.from, at.by_from.transpose() * weighted_from);
    add(edge.from, edge.to, at.by_from.transpose() * weighted_to);
    add(edge.to, edge.from, at.by_to.transpose() * weighted_from);
    add(edge.to, edge.to, at.by_to.transpose() * weighted_to);
  }
  const auto size = static_cast<int>(3 * (poses.size() - 1));
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

Eigen::Vector3d edge_error(const PoseEdge& edge, std::span<const Pose2> poses) {
  return linearised(edge.T_from_to, block_of(poses[edge.from]).data(),
                    block_of(poses[edge.to]).data())
      .error;
}

bool optimise_pose_graph(std::vector<Pose2>& poses, std::span<const PoseEdge> edges) {
  if (poses.size() < 2 || edges.empty()) return true;
  std::vector<Block> blocks;
  for (const Pose2& pose : poses) blocks.push_back(block_of(pose));
  ceres::Problem problem;
  for (Block& block : blocks) problem.AddParameterBlock(block.data(), 3);
  for (const PoseEdge& edge : edges) {
    expects(edge.from < poses.size() && edge.to < poses.size(), "an edge between known poses");
    problem.AddResidualBlock(new EdgeCost(edge), nullptr, blocks[edge.from].data(),
                             blocks[edge.to].data());
  }
  problem.SetParameterBlockConstant(blocks.front().data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;  // no BLAS with threads
  options.num_threads = 1;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-10;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    poses[i] = {blocks[i][0], blocks[i][1], wrap_angle(blocks[i][2])};
  }
  return summary.termination_type == ceres::CONVERGENCE;
}

std::vector<Eigen::Matrix3d> pose_covariances(std::span<const Pose2> poses,
                                              std::span<const PoseEdge> edges,
                                              std::span<const std::size_t> which) {
  std::vector<Eigen::Matrix3d> covariances(which.size(), Eigen::Matrix3d::Zero());
  if (poses.size() < 2) return covariances;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(normal_matrix(poses, edges));
  const bool sound = solver.info() == Eigen::Success && (solver.vectorD().array() > 0.0).all();
  for (std::size_t i = 0; i < which.size(); ++i) {
    if (which[i] == 0) continue;
    if (!sound) {
      covariances[i].setConstant(std::numeric_limits<double>::infinity());
      continue;
    }
    const auto row = static_cast<Eigen::Index>(3 * (which[i] - 1));
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(solver.rows(), 3);
    unit.middleRows<3>(row).setIdentity();
    covariances[i] = solver.solve(unit).middleRows<3>(row);
  }
  return covariances;
}

}  // namespace vantage
