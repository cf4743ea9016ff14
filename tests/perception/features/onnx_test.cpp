#include "vantage/perception/features/onnx.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "tests/perception/features/onnx_bytes.hpp"
#include "tests/support/object_views.hpp"
#include "tests/support/temporary_directory.hpp"

namespace vantage {
namespace {
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(OnnxNetwork, ComputesWhatItsFileSays) {
  const OnnxNetwork network(averaging_network(), "mean.onnx");
  constexpr Eigen::Index plane = Eigen::Index{224} * 224;
  Eigen::VectorXf input(3 * plane);
  for (Eigen::Index c = 0; c < 3; ++c) {
    input.segment(c * plane, plane).setLinSpaced(plane, 0.0F, static_cast<float>(c));
  }
  const Eigen::VectorXf output = network.compute(input);
  ASSERT_EQ(output.size(), 3);
  for (Eigen::Index c = 0; c < 3; ++c) EXPECT_NEAR(output[c], 0.5 * static_cast<double>(c), 1e-3);
}

TEST(OnnxNetwork, ThatTakesOtherInputsIsNamed) {
  const OnnxNetwork network(convolution_network(5), "five.onnx");
  EXPECT_THAT([&] { (void)network.compute(Eigen::VectorXf::Zero(3 * 224 * 224)); },
              ThrowsMessage<InputError>(
                  HasSubstr("'five.onnx' cannot take an input of 1 x 3 x 224 x 224")));
}

TEST(OnnxNetwork, FilesThatAreNoneAreNamed) {
  EXPECT_THAT([] { OnnxNetwork("no network at all", "junk.onnx"); },
              ThrowsMessage<InputError>(HasSubstr("'junk.onnx' is no ONNX network")));
}

class OnnxFeature : public testing::Test {
 protected:
  OnnxFeature() {
    options.file = (directory.path() / "mean.onnx").string();
    std::ofstream(options.file, std::ios::binary) << averaging_network();
  }
  support::TemporaryDirectory directory;
  Onnx options;
};

// Means of three channels on the unit sphere have two or three components.
TEST_F(OnnxFeature, ComponentsOfWhatTheNetworkGives) {
  Rng rng(1);
  const auto views = ball_views(5, 40, rng);
  const TrainedOnnx trained = options.train(views, rng);
  EXPECT_EQ(trained.dimension(), 3);
  const FeatureResult a = trained.extract(views[0]);
  ASSERT_TRUE(a.extracted());
  EXPECT_EQ(a.vector.size(), 3);
  EXPECT_NE(a.vector, trained.extract(views[1]).vector);
}

TEST_F(OnnxFeature, WhatIsBesideTheMaskDoesNotCount) {
  Rng rng(1);
  const auto views = ball_views(5, 40, rng);
  const TrainedOnnx trained = options.train(views, rng);
  ObjectView other = views[0];
  for (int i = 0; i < 3 * 40; ++i) other.rgb[static_cast<std::size_t>(i)] = 255;
  for (int i = 0; i < 40; ++i) other.mask[static_cast<std::size_t>(i)] = 0;
  ObjectView same = views[0];
  for (int i = 0; i < 40; ++i) same.mask[static_cast<std::size_t>(i)] = 0;
  EXPECT_EQ(trained.extract(other).vector, trained.extract(same).vector);
}

TEST_F(OnnxFeature, WorksWithoutTheFileOnceTrained) {
  Rng rng(1);
  const auto views = ball_views(4, 40, rng);
  const TrainedOnnx trained = options.train(views, rng);
  std::filesystem::remove(options.file);
  std::string bytes;
  trained.put_state(bytes);
  ByteReader reader(bytes, "state");
  const TrainedOnnx back = Onnx::take_state(reader);
  EXPECT_EQ(back.extract(views[0]).vector, trained.extract(views[0]).vector);
  EXPECT_THAT([&] { (void)options.train(views, rng); },
              ThrowsMessage<InputError>(HasSubstr(options.file)));
}

TEST_F(OnnxFeature, NeedsTwoViews) {
  Rng rng(1);
  const auto views = ball_views(1, 40, rng);
  EXPECT_THAT([&] { (void)options.train(views, rng); },
              ThrowsMessage<InputError>(HasSubstr("1 training views can be used, fewer than 2")));
}

/// Means of an even colour, whatever share of the square it fills: its direction is known.
TEST(TrainedOnnx, ColoursAreWhatNetworksOfImageNetExpect) {
  const Pca as_it_is{Eigen::VectorXf::Zero(3), Eigen::MatrixXf::Identity(3, 3),
                     Eigen::VectorXf::Ones(3)};
  const TrainedOnnx trained(OnnxNetwork(averaging_network(), "mean.onnx"), as_it_is);
  EXPECT_EQ(trained.dimension(), 3);
  const Eigen::Vector3d value(200.0 / 255.0, 100.0 / 255.0, 50.0 / 255.0);
  const Eigen::Vector3d mean(0.485, 0.456, 0.406);
  const Eigen::Vector3d deviation(0.229, 0.224, 0.225);
  const Eigen::Vector3d expected = ((value - mean).array() / deviation.array()).matrix();
  for (const int height_px : {224, 112}) {
    ObjectView view = blank_view(224, height_px);
    std::ranges::fill(view.mask, 1);
    for (std::size_t i = 0; i < view.mask.size(); ++i) {
      view.rgb[3 * i] = 200;
      view.rgb[3 * i + 1] = 100;
      view.rgb[3 * i + 2] = 50;
    }
    const FeatureResult result = trained.extract(view);
    ASSERT_TRUE(result.extracted()) << result.skipped;
    EXPECT_LT((result.vector.cast<double>() - expected.normalized()).norm(), 3e-4) << height_px;
  }
}

TEST(TrainedOnnx, NeedsSixteenPixels) {
  const Pca as_it_is{Eigen::VectorXf::Zero(3), Eigen::MatrixXf::Identity(3, 3),
                     Eigen::VectorXf::Ones(3)};
  const TrainedOnnx trained(OnnxNetwork(averaging_network(), "mean.onnx"), as_it_is);
  const auto skipped = [&](int width_px, int height_px) {
    ObjectView view = blank_view(width_px, height_px);
    std::ranges::fill(view.mask, 1);
    return trained.extract(view).skipped;
  };
  EXPECT_EQ(skipped(4, 4), "");
  EXPECT_EQ(skipped(5, 3), "the mask has 15 usable pixels, fewer than 16");
}

/// The network gives three numbers.
TEST(TrainedOnnx, ComponentsOfAnotherNetworkAreRefused) {
  const auto why_not = [](Eigen::Index outputs) -> std::string {
    std::string bytes;
    put_text(bytes, "mean.onnx");
    put_text(bytes, averaging_network());
    put_matrix(bytes, Eigen::MatrixXf::Zero(outputs, 1));
    put_matrix(bytes, Eigen::MatrixXf::Identity(outputs, 2));
    put_matrix(bytes, Eigen::MatrixXf::Ones(2, 1));
    ByteReader reader(bytes, "model");
    try {
      (void)Onnx::take_state(reader);
      reader.finish();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(why_not(3), "");
  EXPECT_EQ(why_not(4), "model: holds components of another network");
}

/// The network's weights are zero.
TEST(TrainedOnnx, AnOutputOfZerosHasNoDirection) {
  constexpr Eigen::Index outputs = Eigen::Index{224} * 224;
  const Pca sum{Eigen::VectorXf::Zero(outputs), Eigen::MatrixXf::Ones(outputs, 1),
                Eigen::VectorXf::Ones(1)};
  const TrainedOnnx trained(OnnxNetwork(convolution_network(3), "zero.onnx"), sum);
  ObjectView view = blank_view(224, 224);
  std::ranges::fill(view.mask, 1);
  EXPECT_EQ(trained.extract(view).skipped, "the network's output is zero or not finite");
}

/// Half as high, or as wide, as the square: of its 4 x 4 parts the two in the middle are filled.
TEST(TrainedOnnx, TheObjectIsInTheMiddleOfTheSquare) {
  const Pca as_it_is{Eigen::VectorXf::Zero(48), Eigen::MatrixXf::Identity(48, 48),
                     Eigen::VectorXf::Ones(48)};
  const TrainedOnnx trained(OnnxNetwork(pooling_network(), "pool.onnx"), as_it_is);
  for (const bool wide : {true, false}) {
    ObjectView view = blank_view(wide ? 224 : 112, wide ? 112 : 224);
    std::ranges::fill(view.mask, 1);
    std::ranges::fill(view.rgb, 255);
    const FeatureResult result = trained.extract(view);
    ASSERT_TRUE(result.extracted()) << result.skipped;
    ASSERT_EQ(result.vector.size(), 48);
    for (Eigen::Index i = 0; i < 48; ++i) {
      const Eigen::Index part = wide ? i / 4 % 4 : i % 4;
      EXPECT_EQ(result.vector[i] > 0.01F, part == 1 || part == 2) << wide << " " << i;
      EXPECT_NEAR(result.vector[i], result.vector[i / 16 * 16 + 5] * (part % 3 != 0 ? 1.0F : 0.0F),
                  1e-4F);
    }
  }
}

}  // namespace
}  // namespace vantage
