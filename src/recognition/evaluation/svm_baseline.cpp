#include "vantage/recognition/evaluation/svm_baseline.hpp"

#include <fmt/format.h>
#include <opencv2/ml.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

/// Where each feature lies in a row, and what makes it comparable to the others.
struct Scaling {
  std::vector<Eigen::VectorXf> mean;  ///< of each feature
  std::vector<float> scale;           ///< of each feature
  int columns = 0;
};

Scaling scaling_of(std::span<const ViewFeatures> views) {
  Scaling scaling;
  for (std::size_t f = 0; f < views.front().features.size(); ++f) {
    Eigen::VectorXd sum;
    double squares = 0.0;
    double count = 0.0;
    for (const ViewFeatures& view : views) {
      if (!view.features[f].extracted()) continue;
      const Eigen::VectorXd x = view.features[f].vector.cast<double>();
      sum = count == 0.0 ? x : Eigen::VectorXd(sum + x);
      squares += x.squaredNorm();
      count += 1.0;
    }
    if (count == 0.0) {
      throw InputError(
          fmt::format("baselines: none of {} views to train on has feature {}", views.size(), f));
    }
    sum /= count;
    const double spread = squares / count - sum.squaredNorm();
    scaling.mean.emplace_back(sum.cast<float>());
    scaling.scale.push_back(static_cast<float>(1.0 / std::sqrt(std::max(2.0 * spread, 1e-12))));
    scaling.columns += static_cast<int>(sum.size());
  }
  return scaling;
}

cv::Mat rows_of(std::span<const ViewFeatures> views, const Scaling& scaling) {
  cv::Mat rows = cv::Mat::zeros(static_cast<int>(views.size()), scaling.columns, CV_32F);
  for (std::size_t i = 0; i < views.size(); ++i) {
    float* out = rows.ptr<float>(static_cast<int>(i));
    for (std::size_t f = 0; f < scaling.mean.size(); ++f) {
      const Eigen::Index size = scaling.mean[f].size();
      if (views[i].features[f].extracted()) {
        Eigen::Map<Eigen::VectorXf>(out, size) =
            scaling.scale[f] * (views[i].features[f].vector - scaling.mean[f]);
      }
      out += size;
    }
  }
  return rows;
}

void set_up(cv::ml::SVM& machine, const LinearSvm& svm, std::size_t) {
  machine.setKernel(cv::ml::SVM::LINEAR);
  machine.setC(svm.c);
}

void set_up(cv::ml::SVM& machine, const KernelSvm& svm, std::size_t features) {
  machine.setKernel(cv::ml::SVM::RBF);
  machine.setC(svm.c);
  machine.setGamma(svm.gamma / static_cast<double>(features));
}

}  // namespace

std::vector<int> nearest_predictions(const LabelledFeatures& training,
                                     std::span<const ViewFeatures> test) {
  expects(!training.views.empty() && training.views.size() == training.label.size(),
          "training views with a label each");
  const Scaling scaling = scaling_of(training.views);
  const cv::Mat known = rows_of(training.views, scaling);
  const cv::Mat asked = rows_of(test, scaling);
  std::vector<int> result;
  for (int i = 0; i < asked.rows; ++i) {
    int nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < known.rows; ++k) {
      const double distance = cv::norm(asked.row(i), known.row(k), cv::NORM_L2SQR);
      if (distance >= least) continue;
      least = distance;
      nearest = k;
    }
    result.push_back(training.label[static_cast<std::size_t>(nearest)]);
  }
  return result;
}

std::vector<int> svm_predictions(const Svm& svm, const LabelledFeatures& training,
                                 std::span<const ViewFeatures> test) {
  expects(!training.views.empty() && training.views.size() == training.label.size(),
          "training views with a label each");
  if (std::ranges::adjacent_find(training.label, std::not_equal_to{}) == training.label.end()) {
    throw InputError("baselines: support vector machines need two objects or more to train on");
  }
  const Scaling scaling = scaling_of(training.views);
  const auto machine = cv::ml::SVM::create();
  machine->setType(cv::ml::SVM::C_SVC);
  machine->setTermCriteria({cv::TermCriteria::MAX_ITER + cv::TermCriteria::EPS, 1000, 1e-4});
  std::visit(
      [&](const auto& options) {
        check_options(options, std::string(options.name));
        set_up(*machine, options, scaling.mean.size());
      },
      svm);
  const cv::Mat labels(static_cast<int>(training.label.size()), 1, CV_32S,
                       const_cast<int*>(training.label.data()));
  machine->train(rows_of(training.views, scaling), cv::ml::ROW_SAMPLE, labels);
  cv::Mat predicted;
  machine->predict(rows_of(test, scaling), predicted);
  std::vector<int> result;
  for (int i = 0; i < predicted.rows; ++i) {
    result.push_back(static_cast<int>(std::lround(predicted.at<float>(i))));
  }
  return result;
}

}  // namespace vantage
