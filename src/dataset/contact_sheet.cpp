#include "vantage/dataset/contact_sheet.hpp"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/perception/dataset_reader.hpp"

namespace vantage {
namespace {

constexpr int kCaption_px = 12;

/// How unlike what is wanted a view is.
double strangeness(const ViewEntry& view, const ContactSheetOptions& options) {
  const double turn = view.yaw_rad - options.yaw_rad;
  const double apart_rad = std::abs(std::remainder(turn, 2.0 * std::numbers::pi));
  return apart_rad + (view.name.video == options.video ? 0.0 : 10.0);
}

/// The best view of each object, in order.
std::vector<const ViewEntry*> choose(const DatasetIndex& index,
                                     const ContactSheetOptions& options) {
  std::vector<const ViewEntry*> chosen;
  for (const ViewEntry& view : index.views) {
    if (chosen.empty() || chosen.back()->name.object != view.name.object) {
      chosen.push_back(&view);
    } else if (strangeness(view, options) < strangeness(*chosen.back(), options)) {
      chosen.back() = &view;
    }
  }
  return chosen;
}

void draw_cell(cv::Mat cell, const ViewEntry& entry, const ContactSheetOptions& options) {
  LabelledView labelled = load_view(entry);
  ObjectView& view = labelled.view;
  const cv::Mat rgb(view.height_px, view.width_px, CV_8UC3, view.rgb.data());
  const double zoom =
      static_cast<double>(options.cell_px) / std::max(view.width_px, view.height_px);
  cv::Mat image;
  cv::resize(rgb, image, {}, zoom, zoom, zoom < 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
  cv::cvtColor(image, image, cv::COLOR_RGB2BGR);
  const cv::Rect inside(0, 0, std::min(image.cols, cell.cols),
                        std::min(image.rows, options.cell_px));
  image(inside).copyTo(cell(inside));
  cv::putText(cell, entry.name.object, {1, options.cell_px + kCaption_px - 3},
              cv::FONT_HERSHEY_PLAIN, 0.6, {0, 0, 0}, 1, cv::LINE_AA);
}

}  // namespace

void write_contact_sheet(const DatasetIndex& index, const ContactSheetOptions& options,
                         const std::filesystem::path& path) {
  expects(options.cell_px > 0 && options.columns > 0, "a grid of cells");
  if (path.extension() != ".png") {
    throw ConfigError(path.string() + ": the name of a contact sheet ends in .png");
  }
  const std::vector<const ViewEntry*> chosen = choose(index, options);
  const int count = static_cast<int>(chosen.size());
  const int columns = std::min(options.columns, std::max(count, 1));
  const int rows = (count + columns - 1) / columns;
  const int height_px = options.cell_px + kCaption_px;
  cv::Mat sheet(rows * height_px, columns * options.cell_px, CV_8UC3, cv::Scalar::all(255));
  for (int i = 0; i < count; ++i) {
    const cv::Rect cell(i % columns * options.cell_px, i / columns * height_px, options.cell_px,
                        height_px);
    draw_cell(sheet(cell), *chosen[static_cast<std::size_t>(i)], options);
  }
  write_file_with(
      path, [&](const std::filesystem::path& part) { return cv::imwrite(part.string(), sheet); });
}

}  // namespace vantage
