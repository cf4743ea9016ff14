#include "vantage/perception/images/image_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <cmath>

#include "tests/support/room_pictures.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/perception/images/npy.hpp"

namespace vantage {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class ImageFiles : public testing::Test {
 protected:
  std::filesystem::path path(const char* name) const { return folder_.path() / name; }
  /// As NumPy writes it.
  void put_npy(const char* name, const std::string& type, const std::string& shape,
               const std::string& bytes, bool by_columns = false) const {
    std::string header = "{'descr': '" + type +
                         "', 'fortran_order': " + (by_columns ? "True" : "False") + ", 'shape': (" +
                         shape + "), }";
    header.resize(118, ' ');
    write_file(path(name), std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header + bytes);
  }
  template <class T>
  static std::string bytes_of(std::vector<T> values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
  }
  template <class Read>
  void expect_error(Read&& read, const std::string& reason) const {
    try {
      read();
      ADD_FAILURE() << "no error";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(reason));
    }
  }
  support::TemporaryDirectory folder_;
};

TEST_F(ImageFiles, DepthOfIntegersIsMillimetresAndOfFloatsAsLarge) {
  put_npy("mm.npy", "<u2", "1, 3", bytes_of<std::uint16_t>({800, 0, 65535}));
  EXPECT_THAT(read_depth_image(path("mm.npy")).depth_m, ElementsAre(0.8F, 0.0F, 0.0F));
  put_npy("m.npy", "<f4", "2, 2", bytes_of<float>({0.8F, NAN, -1.0F, 1.2F}));
  const DepthImage metres = read_depth_image(path("m.npy"));
  EXPECT_EQ(metres.unit_m, 1.0);
  EXPECT_THAT(metres.depth_m, ElementsAre(0.8F, 0.0F, 0.0F, 1.2F));
  put_npy("float_mm.npy", "<f8", "1, 2", bytes_of<double>({800.0, 900.0}));
  EXPECT_EQ(read_depth_image(path("float_mm.npy")).unit_m, 0.001);
  EXPECT_FLOAT_EQ(read_depth_image(path("mm.npy"), 0.0002).depth_m[0], 0.16F);
}

TEST_F(ImageFiles, AnArrayByColumnsOrWithAThirdAxisIsTheSame) {
  put_npy("rows.npy", "<i4", "2, 3", bytes_of<std::int32_t>({1, 2, 3, 4, 5, 6}));
  put_npy("columns.npy", "<i4", "2, 3", bytes_of<std::int32_t>({1, 4, 2, 5, 3, 6}), true);
  put_npy("axis.npy", "<i4", "2, 3, 1", bytes_of<std::int32_t>({1, 2, 3, 4, 5, 6}));
  for (const char* name : {"rows.npy", "columns.npy", "axis.npy"}) {
    EXPECT_THAT(read_npy(path(name)).values, ElementsAre(1, 2, 3, 4, 5, 6)) << name;
  }
  put_npy("half.npy", "<f2", "1, 2", bytes_of<std::uint16_t>({0x3c00, 0xc000}));
  EXPECT_THAT(read_npy(path("half.npy")).values, ElementsAre(1.0, -2.0));
}

TEST_F(ImageFiles, WhatIsNoDepthSaysWhy) {
  put_npy("short.npy", "<u2", "2, 2", bytes_of<std::uint16_t>({1, 2}));
  expect_error([&] { read_depth_image(path("short.npy")); }, "short.npy: is cut short");
  put_npy("text.npy", "<U4", "2, 2", "");
  expect_error([&] { read_depth_image(path("text.npy")); }, "'<U4'");
  std::string wide =
      "{'descr': '<u2', 'fortran_order': False, 'shape': (2," + std::string(1 << 20, ' ') + "2), }";
  const auto size = static_cast<std::uint32_t>(wide.size());
  wide.insert(0, bytes_of<std::uint32_t>({size}));
  write_file(path("wide.npy"), std::string("\x93NUMPY\x02\x00", 8) + wide);
  expect_error([&] { read_depth_image(path("wide.npy")); }, "wide.npy: is cut short");
  write_file(path("no.npy"), "hello, this is not an array");
  expect_error([&] { read_depth_image(path("no.npy")); }, "is no NPY file");
  cv::imwrite(path("eight.png").string(), cv::Mat(2, 2, CV_8UC1, cv::Scalar(9)));
  expect_error([&] { read_depth_image(path("eight.png")); }, "8-bit");
  cv::imwrite(path("full.png").string(), cv::Mat(2, 2, CV_16UC1, cv::Scalar(65535)));
  expect_error([&] { read_depth_image(path("full.png")); }, "65535");
  cv::imwrite(path("near.png").string(), cv::Mat(2, 2, CV_16UC1, cv::Scalar(8)));
  expect_error([&] { read_depth_image(path("near.png")); }, "--depth-unit of");
  expect_error([&] { read_depth_image(path("near.png")); }, "--depth-unit-m of `recognise`");
}

TEST_F(ImageFiles, ColourMayHaveAlphaOrNone) {
  cv::imwrite(path("alpha.png").string(), cv::Mat(1, 1, CV_8UC4, cv::Scalar(1, 2, 3, 9)));
  EXPECT_THAT(read_colour_image(path("alpha.png")).rgb, ElementsAre(3, 2, 1));
  cv::imwrite(path("grey.png").string(), cv::Mat(1, 1, CV_8UC1, cv::Scalar(7)));
  EXPECT_THAT(read_colour_image(path("grey.png")).rgb, ElementsAre(7, 7, 7));
  EXPECT_EQ(image_kind(path("alpha.png")), ImageKind::colour);
  EXPECT_EQ(image_kind(path("grey.png")), ImageKind::mask);
  cv::imwrite(path("a.jpg").string(), cv::Mat(16, 16, CV_8UC3, cv::Scalar(7, 7, 7)));
  std::filesystem::resize_file(path("a.jpg"), std::filesystem::file_size(path("a.jpg")) / 2);
  expect_error([&] { read_colour_image(path("a.jpg")); }, "a.jpg: is no whole image");
}

}  // namespace
}  // namespace vantage
