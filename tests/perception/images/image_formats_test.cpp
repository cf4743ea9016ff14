// Numbers of every type that arrays hold, limits of what is told from depth, and what files are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/perception/images/image_files.hpp"
#include "vantage/perception/images/npy.hpp"

namespace vantage {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

template <class T>
std::string raw(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

class ImageFormats : public testing::Test {
 protected:
  std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
  /// Version 1, its header `length` long, below 65536.
  std::filesystem::path array(const std::string& entries, const std::string& bytes,
                              std::size_t length = 118) const {
    std::string header = "{" + entries + "}";
    header.resize(length, ' ');
    const std::array<char, 2> size{static_cast<char>(length % 256),
                                   static_cast<char>(length / 256)};
    write_file(path("array.npy"),
               std::string("\x93NUMPY\x01\x00", 8) + std::string(size.data(), 2) + header + bytes);
    return path("array.npy");
  }
  std::filesystem::path array_of(const std::string& type, const std::string& shape,
                                 const std::string& bytes) const {
    return array("'descr': '" + type + "', 'fortran_order': False, 'shape': (" + shape + "), ",
                 bytes);
  }
  std::filesystem::path image(const std::string& name, const cv::Mat& pixels) const {
    cv::imwrite(path(name).string(), pixels);
    return path(name);
  }
  support::TemporaryDirectory folder_;
};

TEST_F(ImageFormats, ArraysKeepTheirShape) {
  const std::string bytes = raw<std::uint8_t>({1, 2, 3, 4, 5, 6});
  for (const auto& [shape, rows, columns] : {std::tuple("1, 6", 1, 6),
                                             {"6, 1", 6, 1},
                                             {"6,", 6, 1},
                                             {"2, 3", 2, 3},
                                             {"2, 3, 1", 2, 3},
                                             {"1, 2, 3", 2, 3},
                                             {"1, 2, 3, 1", 2, 3},
                                             {"2, , 3, ", 2, 3},
                                             {"1, 6, 1", 1, 6}}) {
    const NpyMatrix matrix = read_npy(array_of("|u1", shape, bytes));
    EXPECT_EQ(matrix.rows, rows) << shape;
    EXPECT_EQ(matrix.columns, columns) << shape;
  }
  EXPECT_THROW(read_npy(array_of("|u1", "2, 3, 2", bytes + bytes)), InputError);
}

TEST_F(ImageFormats, ArraysHoldNumbersOfEveryType) {
  const auto expect = [&](const std::string& type, const std::string& bytes, double a, double b,
                          bool integers) {
    const NpyMatrix matrix = read_npy(array_of(type, "2, 1", bytes));
    EXPECT_EQ(matrix.rows, 2) << type;
    EXPECT_EQ(matrix.columns, 1) << type;
    EXPECT_THAT(matrix.values, ElementsAre(a, b)) << type;
    EXPECT_EQ(matrix.integers, integers) << type;
  };
  expect("|u1", raw<std::uint8_t>({200, 7}), 200, 7, true);
  expect("|b1", raw<std::uint8_t>({1, 0}), 1, 0, true);
  expect(">u1", raw<std::uint8_t>({9, 8}), 9, 8, true);
  expect("|i1", raw<std::int8_t>({-100, 7}), -100, 7, true);
  expect("<u2", raw<std::uint16_t>({60000, 3}), 60000, 3, true);
  expect("<i2", raw<std::int16_t>({-30000, 3}), -30000, 3, true);
  expect("<u4", raw<std::uint32_t>({4000000000U, 3}), 4e9, 3, true);
  expect("<i4", raw<std::int32_t>({-2000000000, 3}), -2e9, 3, true);
  expect("<u8", raw<std::uint64_t>({1ULL << 63U, 3}), std::ldexp(1.0, 63), 3, true);
  expect("<i8", raw<std::int64_t>({-5000000000, 3}), -5e9, 3, true);
  expect("<f4", raw<float>({-0.25F, 3.5F}), -0.25, 3.5, false);
  expect("<f8", raw<double>({-0.1, 1e300}), -0.1, 1e300, false);
  for (const char* type : {">u2", ">f4", "<u3", "<c8", "u", ""}) {
    EXPECT_THAT([&] { read_npy(array_of(type, "2, 1", std::string(16, '\0'))); },
                ThrowsMessage<InputError>(HasSubstr("holds numbers of type")))
        << type;
  }
}

TEST_F(ImageFormats, HalvesAreReadAsTheyAreDefined) {
  const auto values = read_npy(array_of("<f2", "8, 1",
                                        raw<std::uint16_t>({0x0001, 0x83ff, 0x0400, 0x3555, 0x7bff,
                                                            0x7c00, 0xfc00, 0x7e00})))
                          .values;
  EXPECT_EQ(values[0], std::ldexp(1.0, -24));
  EXPECT_EQ(values[1], -1023.0 * std::ldexp(1.0, -24));
  EXPECT_EQ(values[2], std::ldexp(1.0, -14));
  EXPECT_EQ(values[3], 0.333251953125);
  EXPECT_EQ(values[4], 65504.0);
  EXPECT_EQ(values[5], std::numeric_limits<double>::infinity());
  EXPECT_EQ(values[6], -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(values[7]));
}

TEST_F(ImageFormats, AnArrayMayHaveALongHeader) {
  const std::string entries = "'descr': '<u2', 'fortran_order': False, 'shape': (3, 2), ";
  const std::string bytes = raw<std::uint16_t>({1, 2, 3, 4, 5, 6});
  const NpyMatrix matrix = read_npy(array(entries, bytes, 300));
  EXPECT_EQ(matrix.rows, 3);
  EXPECT_EQ(matrix.columns, 2);
  EXPECT_THAT(matrix.values, ElementsAre(1, 2, 3, 4, 5, 6));
  for (const std::uint32_t length : {70000U, (1U << 24U) + 100U}) {
    std::string header = "{" + entries + "}";
    header.resize(length, ' ');
    write_file(path("second.npy"),
               std::string("\x93NUMPY\x02\x00", 8) + raw<std::uint32_t>({length}) + header + bytes);
    EXPECT_THAT(read_npy(path("second.npy")).values, ElementsAre(1, 2, 3, 4, 5, 6)) << length;
  }
}

TEST_F(ImageFormats, HeadersOfArraysAreChecked) {
  const auto refuses = [&](const std::string& entries, const std::string& why) {
    EXPECT_THAT([&] { read_npy(array(entries, std::string(64, '\0'))); },
                ThrowsMessage<InputError>(HasSubstr(why)))
        << entries;
  };
  const std::string type = "'descr': '<u2', ";
  const std::string order = "'fortran_order': False, ";
  const std::string no_array = "its header is not that of an array";
  refuses(order + "'shape': (2, 2)", no_array);
  refuses(type + "'shape': (2, 2)", no_array);
  refuses(type + order, no_array);
  refuses("'descr': [('a', '<u2')], " + order + "'shape': (2, 2)", no_array);
  refuses(type + "'fortran_order': 0, 'shape': (2, 2)", no_array);
  refuses(type + order + "'shape': 4", no_array);
  refuses(type + order + "'shape': (a, 2)", no_array);
  refuses(type + order + "'shape': (2, 2", no_array);
  refuses(type + order + "'shape': (2, 2, 2)", "has shape (2, 2, 2), expected (rows, columns)");
  refuses(type + order + "'shape': (0, 2)", "has shape (0, 2)");
  refuses(type + order + "'shape': (2, -2)", "has shape (2, -2)");
  refuses(type + order + "'shape': (20001, 2)", "has shape (20001, 2)");
  refuses(type + order + "'shape': (2, 20001)", "has shape (2, 20001)");
  refuses(type + order + "'shape': (20000, 20000)", "is cut short");
  write_file(path("head.npy"), std::string("\x93NUMPY\x01\x00\x10\x00", 10) + "{'descr': '<u2'");
  EXPECT_THAT([&] { read_npy(path("head.npy")); },
              ThrowsMessage<InputError>(HasSubstr("head.npy: is cut short")));
  write_file(path("head.npy"), std::string("\x93NUMPY\x01\x00\x01\x00{", 11));
  EXPECT_THAT([&] { read_npy(path("head.npy")); },
              ThrowsMessage<InputError>(HasSubstr("is no NPY file")));
  write_file(path("head.npy"), std::string("\x93NUMPY\x01\x00\x02\x00{}", 12));
  EXPECT_THAT([&] { read_npy(path("head.npy")); }, ThrowsMessage<InputError>(HasSubstr(no_array)));
  EXPECT_THAT([&] { read_npy(array(type + order + "'shape': (0, 2)", "")); },
              ThrowsMessage<InputError>(HasSubstr("has shape (0, 2)")))
      << "of a file that ends with its header too";
}

TEST_F(ImageFormats, TheUnitOfDepthIsToldBetweenLimits) {
  const auto unit = [&](float value) {
    return read_depth_image(array_of("<f4", "2, 1", raw<float>({value, value}))).unit_m;
  };
  EXPECT_EQ(unit(0.02F), 1.0);
  EXPECT_EQ(unit(19.9F), 1.0);
  EXPECT_EQ(unit(100.0F), 0.001);
  EXPECT_EQ(unit(20000.0F), 0.001);
  const auto unit_of_integers = [&](std::uint16_t a, std::uint16_t b) {
    return read_depth_image(array_of("<u2", "2, 1", raw<std::uint16_t>({a, b}))).unit_m;
  };
  EXPECT_EQ(unit_of_integers(100, 99), 0.001) << "the upper one of two in the middle";
  EXPECT_EQ(unit_of_integers(20000, 20000), 0.001);
  EXPECT_EQ(unit_of_integers(0, 0), 0.001);
  for (const float bad : {20.0F, 99.0F, 20001.0F}) {
    EXPECT_THAT([&] { unit(bad); }, ThrowsMessage<InputError>(HasSubstr("neither millimetres")))
        << bad;
  }
  EXPECT_THROW(unit_of_integers(99, 99), InputError);
  EXPECT_THROW(unit_of_integers(15, 15), InputError) << "integers are no metres";
  EXPECT_THROW(unit_of_integers(20001, 20001), InputError);
}

TEST_F(ImageFormats, TheGreatestNumberIsNoMeasurementOfIntegersAlone) {
  const auto floats = array_of("<f4", "2, 1", raw<float>({65535.0F, 10.0F}));
  EXPECT_THAT(read_depth_image(floats, 0.001).depth_m,
              ElementsAre(testing::FloatEq(65.535F), testing::FloatEq(0.01F)));
  const auto some = array_of("<u2", "2, 1", raw<std::uint16_t>({65535, 65534}));
  EXPECT_THAT(read_depth_image(some, 0.001).depth_m, ElementsAre(0.0F, testing::FloatEq(65.534F)));
  const auto nothing = array_of("<u2", "2, 1", raw<std::uint16_t>({0, 0}));
  EXPECT_THAT(read_depth_image(nothing).depth_m, Each(0.0F));
}

TEST_F(ImageFormats, DepthImagesKeepTheirSize) {
  cv::Mat1w pixels(2, 3);
  for (int i = 0; i < 6; ++i) pixels(i / 3, i % 3) = static_cast<std::uint16_t>(500 + i);
  const DepthImage depth = read_depth_image(image("depth.PNG", pixels));
  EXPECT_EQ(depth.width_px, 3);
  EXPECT_EQ(depth.height_px, 2);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_FLOAT_EQ(depth.depth_m[i], 0.5F + 0.001F * static_cast<float>(i));
  }
  EXPECT_THAT([&] { read_depth_image(image("eight.png", cv::Mat1b(2, 3, std::uint8_t{9}))); },
              ThrowsMessage<InputError>(HasSubstr("is an image of 1 channel of 8-bit values; ")));
  const cv::Mat three(2, 3, CV_16UC3, cv::Scalar(900, 900, 900));
  EXPECT_THAT([&] { read_depth_image(image("three.png", three)); },
              ThrowsMessage<InputError>(HasSubstr("an image of 3 channels of 16-bit values")));
  EXPECT_THAT([&] { read_colour_image(image("three.png", three)); },
              ThrowsMessage<InputError>(HasSubstr("expected 8-bit colour")));
}

TEST_F(ImageFormats, ColourIsRedGreenBlueRowByRow) {
  cv::Mat3b pixels(1, 2);
  pixels(0, 0) = {3, 2, 1};
  pixels(0, 1) = {6, 5, 4};
  for (const char* name : {"colour.png", "colour.bmp", "colour.ppm"}) {
    const ColourImage colour = read_colour_image(image(name, pixels));
    EXPECT_EQ(colour.width_px, 2) << name;
    EXPECT_EQ(colour.height_px, 1) << name;
    EXPECT_THAT(colour.rgb, ElementsAre(1, 2, 3, 4, 5, 6)) << name;
  }
  write_file(path("empty.bmp"), "");
  EXPECT_THAT([&] { read_colour_image(path("empty.bmp")); },
              ThrowsMessage<InputError>(HasSubstr("is no whole image")));
  write_file(path("text.bmp"), "no picture at all");
  EXPECT_THAT([&] { read_colour_image(path("text.bmp")); },
              ThrowsMessage<InputError>(HasSubstr("cannot be decoded")));
}

/// As cameras write it: a small picture in the headers, and more behind the end.
TEST_F(ImageFormats, AJpegIsWholeUpToItsOwnEnd) {
  const cv::Mat3b pixels(16, 24, cv::Vec3b(90, 60, 30));
  const std::string bare = read_file(image("bare.jpg", pixels));
  const std::string small = bare.substr(0, 2) + std::string("\xff\xe1\x00\x08", 4) +
                            std::string("\xff\xd8\xff\xda\xff\xd9", 6) + bare.substr(2);
  for (const std::string& whole : {small, small + std::string(1000, '\x7f')}) {
    write_file(path("a.jpg"), whole);
    EXPECT_EQ(read_colour_image(path("a.jpg")).width_px, 24);
  }
  for (const std::string& cut : {small.substr(0, small.size() - 2), small.substr(0, 20),
                                 small.substr(0, 5), std::string("\xff")}) {
    write_file(path("a.jpg"), cut);
    EXPECT_THAT([&] { read_colour_image(path("a.jpg")); },
                ThrowsMessage<InputError>(HasSubstr("is no whole image")))
        << cut.size();
  }
}

/// A byte between headers, a header of 300 bytes, and a picture of nothing but its ends.
TEST_F(ImageFormats, AJpegIsFollowedFromHeaderToHeader) {
  const std::string bare = read_file(image("bare.jpg", cv::Mat3b(16, 24, cv::Vec3b(90, 60, 30))));
  const std::string comment = std::string("\xff\xfe\x01\x2c", 4) + std::string(298, ' ');
  for (const std::string& between : {std::string("\xff"), comment}) {
    write_file(path("a.jpg"), bare.substr(0, 2) + between + bare.substr(2));
    EXPECT_EQ(read_colour_image(path("a.jpg")).width_px, 24) << between.size();
  }
  write_file(path("a.jpg"), "\xff\xd8\xff\xda\xff\xd9");
  EXPECT_THAT([&] { read_colour_image(path("a.jpg")); },
              ThrowsMessage<InputError>(HasSubstr("cannot be decoded")));
}

TEST_F(ImageFormats, AMaskIsWhatIsNotBlack) {
  cv::Mat3b colour(2, 2, cv::Vec3b(0, 0, 0));
  colour(0, 1) = {0, 0, 1};
  colour(1, 0) = {5, 0, 0};
  const MaskImage mask = read_mask_image(image("colour.png", colour));
  EXPECT_THAT(mask.mask, ElementsAre(0, 1, 1, 0));
  cv::Mat alpha(1, 2, CV_8UC4, cv::Scalar(0, 0, 0, 255));
  alpha.at<cv::Vec4b>(0, 1) = {0, 9, 0, 255};
  const MaskImage without = read_mask_image(image("alpha.png", alpha));
  EXPECT_THAT(without.mask, ElementsAre(0, 1)) << "alpha does not count";
  EXPECT_EQ(without.width_px, 2);
  EXPECT_EQ(without.height_px, 1);
  cv::Mat1w sixteen(1, 2, std::uint16_t{0});
  sixteen(0, 0) = 256;
  EXPECT_THAT(read_mask_image(image("sixteen.png", sixteen)).mask, ElementsAre(1, 0));
}

TEST_F(ImageFormats, FilesAreToldByNameAndFirstBytes) {
  for (const char* name : {"a.jpg", "a.JPEG", "a.bmp", "a.ppm"}) {
    EXPECT_EQ(image_kind(path(name)), ImageKind::colour) << name;
  }
  EXPECT_EQ(image_kind(path("a.npy")), ImageKind::depth);
  EXPECT_EQ(image_kind(path("a.txt")), ImageKind::other);
  EXPECT_EQ(image_kind(path("a")), ImageKind::other);
  const auto png = [&](int bits, int type) {
    std::string head(26, '\1');
    head[24] = static_cast<char>(bits);
    head[25] = static_cast<char>(type);
    write_file(path("a.png"), head);
    return image_kind(path("a.png"));
  };
  EXPECT_EQ(png(16, 0), ImageKind::depth);
  EXPECT_EQ(png(8, 0), ImageKind::mask);
  EXPECT_EQ(png(1, 0), ImageKind::mask);
  EXPECT_EQ(png(16, 4), ImageKind::depth);
  EXPECT_EQ(png(8, 4), ImageKind::mask);
  for (const int type : {2, 3, 6}) EXPECT_EQ(png(16, type), ImageKind::colour) << type;
}

TEST_F(ImageFormats, APictureOfTwoChannelsIsNoColour) {
  write_file(path("two.pam"),
             "P7\nWIDTH 2\nHEIGHT 1\nDEPTH 2\nMAXVAL 255\nTUPLTYPE GRAYSCALE_ALPHA\nENDHDR\n"
             "\1\2\3\4");
  EXPECT_THAT([&] { read_colour_image(path("two.pam")); },
              ThrowsMessage<InputError>(
                  HasSubstr("is an image of 2 channels of 8-bit values; expected 8-bit colour")));
}

TEST_F(ImageFormats, ATiffIsToldByItsPixels) {
  const cv::Mat3b colour(2, 3, cv::Vec3b(1, 2, 3));
  const cv::Mat1b grey(2, 3, std::uint8_t{9});
  const cv::Mat1w depth(2, 3, std::uint16_t{900});
  EXPECT_EQ(image_kind(image("colour.tif", colour)), ImageKind::colour);
  EXPECT_EQ(image_kind(image("grey.tiff", grey)), ImageKind::mask);
  EXPECT_EQ(image_kind(image("depth.TIF", depth)), ImageKind::depth);
  write_file(path("text.tif"), "no picture at all");
  EXPECT_EQ(image_kind(path("text.tif")), ImageKind::other);
}

}  // namespace
}  // namespace vantage
