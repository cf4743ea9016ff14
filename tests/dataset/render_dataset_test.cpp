#include "vantage/dataset/render_dataset.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/dataset/turntable.hpp"
#include "vantage/models/catalogue/shapes/mesh_builders.hpp"
#include "vantage/models/catalogue/shapes/obj.hpp"
#include "vantage/models/catalogue/shapes/texture.hpp"
#include "vantage/perception/dataset_reader.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

/// Few and small views.
DatasetOptions few(int objects) {
  return {.objects = objects, .step_deg = 120.0, .supersampling = 1};
}

std::map<std::string, std::string> contents(const fs::path& root) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (entry.is_regular_file()) {
      files[fs::relative(entry.path(), root).string()] = read_file(entry.path());
    }
  }
  return files;
}

/// Folders of objects that are not complete.
std::ptrdiff_t unfinished_in(const fs::path& root) {
  return std::ranges::count_if(
      fs::recursive_directory_iterator(root),
      [](const fs::directory_entry& entry) { return entry.path().extension() == ".part"; });
}

/// Descriptors by which this process has the folder open.
int descriptors_of(const fs::path& folder) {
  int count = 0;
  std::error_code gone;
  for (const auto& entry : fs::directory_iterator("/proc/self/fd")) {
    count += fs::read_symlink(entry.path(), gone) == fs::canonical(folder) ? 1 : 0;
  }
  return count;
}

TEST(RenderDataset, IsReadAsADataset) {
  const support::TemporaryDirectory out;
  const DatasetOutcome outcome = render_dataset(few(3), {.root = out / "d"});
  EXPECT_EQ(outcome.objects, 3);
  EXPECT_EQ(outcome.rendered, 3);
  EXPECT_EQ(outcome.views, 3 * 3 * 3);
  const DatasetIndex index = index_dataset(out / "d");
  ASSERT_EQ(index.views.size(), 27U);
  for (const ViewEntry& entry : index.views) {
    SCOPED_TRACE(to_string(entry.name));
    const LabelledView read = load_view(entry);
    int on_object = 0;
    int measured = 0;
    for (std::size_t i = 0; i < read.view.mask.size(); ++i) {
      on_object += read.view.mask[i];
      measured += read.view.mask[i] != 0 && read.view.depth_m[i] > 0.0F ? 1 : 0;
    }
    EXPECT_GT(on_object, 500);
    EXPECT_GT(measured, on_object * 3 / 4);
    EXPECT_GE(read.view.left_px, 0);
    EXPECT_LE(read.view.left_px + read.view.width_px, 640);
    EXPECT_LE(read.view.top_px + read.view.height_px, 480);
  }
}

TEST(RenderDataset, ViewsOfAVideoAreAStepApart) {
  const support::TemporaryDirectory out;
  render_dataset(few(1), {.root = out / "d"});
  const auto views = index_dataset(out / "d").views;
  for (std::size_t i = 1; i < views.size(); ++i) {
    if (views[i].name.video != views[i - 1].name.video) continue;
    const double step =
        std::remainder(views[i].yaw_rad - views[i - 1].yaw_rad, 2 * std::numbers::pi);
    EXPECT_NEAR(step, 2.0 * std::numbers::pi / 3.0, 1e-5);
  }
}

TEST(RenderDataset, TheObjectStandsUprightOnItsPlane) {
  const support::TemporaryDirectory out;
  DatasetOptions options = few(1);  // a mug
  options.depth_noise = false;
  options.edge_dropout = 0.0;
  options.mask_growth_px = 0;
  render_dataset(options, {.root = out / "d"});
  for (const ViewEntry& entry : index_dataset(out / "d").views) {
    const ObjectView view = load_view(entry).view;
    double low = 1e9;
    double high = -1e9;
    for (int row = 0; row < view.height_px; ++row) {
      for (int column = 0; column < view.width_px; ++column) {
        if (view.mask[view.index(row, column)] == 0) continue;
        const double height = view.up.dot(view.point(row, column));
        low = std::min(low, height);
        high = std::max(high, height);
      }
    }
    EXPECT_GT(high - low, 0.08) << to_string(entry.name);
    EXPECT_LT(high - low, 0.12) << to_string(entry.name);
  }
}

TEST(RenderDataset, AnotherSessionShowsTheSameObjectsInOtherLight) {
  const support::TemporaryDirectory out;
  DatasetOptions options = few(1);
  options.depth_noise = false;
  render_dataset(options, {.root = out / "first"});
  options.session = 2;
  render_dataset(options, {.root = out / "second"});
  const auto first = index_dataset(out / "first").views;
  const auto second = index_dataset(out / "second").views;
  ASSERT_EQ(first.size(), second.size());
  EXPECT_EQ(first.front().name, second.front().name);
  EXPECT_GT(std::abs(std::remainder(first.front().yaw_rad - second.front().yaw_rad,
                                    2.0 * std::numbers::pi)),
            1e-3);
  EXPECT_NE(contents(out / "first"), contents(out / "second"));
}

TEST(RenderDataset, AVideoIsTheSameWhicheverOthersThereAre) {
  const support::TemporaryDirectory out;
  render_dataset(few(1), {.root = out / "all"});
  DatasetOptions options = few(1);
  options.videos = {2};
  EXPECT_EQ(render_dataset(options, {.root = out / "second"}).views, 3);
  const auto all = contents(out / "all");
  for (const auto& [name, content] : contents(out / "second")) {
    if (name == "dataset.yaml") continue;
    EXPECT_THAT(name, testing::HasSubstr("mug_1_2_"));
    EXPECT_EQ(all.at(name), content) << name;
  }
  options.videos = {3};
  EXPECT_THROW(render_dataset(options, {.root = out / "third"}), ConfigError);
}

TEST(RenderDataset, GoesOnWhereItWasStopped) {
  const support::TemporaryDirectory out;
  render_dataset(few(4), {.root = out / "whole"});
  std::atomic<int> views = 0;
  const DatasetOutcome stopped =
      render_dataset(few(4), {.root = out / "parts", .stop = [&] { return ++views > 22; }});
  EXPECT_TRUE(stopped.stopped);
  EXPECT_LT(stopped.objects, 4);
  EXPECT_EQ(unfinished_in(out / "parts"), 0);
  fs::create_directories(out / "parts" / "mug" / ".mug_2.part");  // as a kill leaves it
  write_file(out / "parts" / "mug" / ".mug_2.part" / "mug_2_1_1_crop.png", "half");
  const DatasetOutcome resumed = render_dataset(few(4), {.root = out / "parts"});
  EXPECT_FALSE(resumed.stopped);
  EXPECT_EQ(resumed.objects, 4);
  EXPECT_EQ(resumed.rendered + stopped.rendered, 4);
  fs::remove_all(out / "parts" / "mug" / ".mug_2.part");
  EXPECT_TRUE(contents(out / "whole") == contents(out / "parts"));
}

TEST(RenderDataset, OtherOptionsNeedOverwrite) {
  const support::TemporaryDirectory out;
  render_dataset(few(1), {.root = out / "d"});
  DatasetOptions other = few(1);
  other.seed = 9;
  EXPECT_THROW(render_dataset(other, {.root = out / "d"}), ConfigError);
  EXPECT_EQ(render_dataset(few(2), {.root = out / "d"}).rendered, 1);  // one more
  EXPECT_THROW(render_dataset(few(1), {.root = out / "d"}), ConfigError) << "it holds two";
  EXPECT_EQ(render_dataset(other, {.root = out / "d", .overwrite = true}).rendered, 1);
  EXPECT_THAT(dataset_options_text(out / "d"), testing::HasSubstr("seed: 9"));
}

TEST(RenderDataset, AnotherFolderIsLeftAlone) {
  const support::TemporaryDirectory out;
  write_file(out / "precious.txt", "mine");
  EXPECT_THROW(render_dataset(few(1), {.root = out.path(), .overwrite = true}), ConfigError);
  EXPECT_TRUE(fs::exists(out / "precious.txt"));
}

TEST(RenderDataset, AnObjectTooLargeForTheImageIsNamed) {
  const support::TemporaryDirectory out;
  DatasetOptions options = few(4);
  options.distance_m = 0.3;
  options.placement_m = 0.1;
  EXPECT_THROW(render_dataset(options, {.root = out / "d"}), InputError);
  EXPECT_EQ(unfinished_in(out / "d"), 0);
}

TEST(RenderDataset, OfADamagedModelNothingIsBegun) {
  const support::TemporaryDirectory out;
  fs::create_directories(out / "models/duck");
  write_file(out / "models/duck/model.obj", "v 1 2\n");
  write_file(out / "models/duck/texture.png", "is not read");
  DatasetOptions options = few(1);
  options.models = (out / "models").string();
  EXPECT_THROW(render_dataset(options, {.root = out / "d"}), InputError);
  EXPECT_FALSE(fs::exists(out / "d/duck"));
}

TEST(RenderDataset, TellsWhatIsMissing) {
  const support::TemporaryDirectory out;
  render_dataset(few(3), {.root = out / "d"});
  EXPECT_THAT(missing_objects(out / "d"), testing::IsEmpty());
  fs::remove_all(out / "d" / "mug" / "mug_2");
  EXPECT_THAT(missing_objects(out / "d"), testing::ElementsAre("mug_2"));
  fs::remove(out / "d" / "dataset.yaml");  // as of another's pictures
  EXPECT_THAT(missing_objects(out / "d"), testing::IsEmpty());
}

TEST(RenderDataset, OneProcessAtATimeRendersIntoAFolder) {
  const support::TemporaryDirectory out;
  int refused = 0;
  const auto another = [&] {
    try {
      render_dataset(few(1), {.root = out / "d"});
    } catch (const OutputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("another process"));
      ++refused;
    }
    EXPECT_EQ(descriptors_of(out / "d"), 1) << "that of the one that renders";
    return false;
  };
  render_dataset(few(1), {.root = out / "d", .stop = another});
  EXPECT_EQ(refused, 9);
}

TEST(RenderDataset, WhatIsRenderedIsNotReplacedMeanwhile) {
  const support::TemporaryDirectory out;
  DatasetOptions other = few(1);
  other.seed = 9;
  bool begun = false;
  const auto replace = [&] {
    const bool first = !std::exchange(begun, true);
    if (first) {
      EXPECT_THROW(render_dataset(other, {.root = out / "d", .overwrite = true}), OutputError);
    }
    return false;
  };
  EXPECT_EQ(render_dataset(few(1), {.root = out / "d", .stop = replace}).rendered, 1);
  EXPECT_EQ(dataset_options_text(out / "d").find("seed: 9"), std::string::npos);
}

TEST(RenderDataset, OverwritingLeavesNothingOfTheOldOne) {
  const support::TemporaryDirectory out;
  render_dataset(few(2), {.root = out / "d"});
  DatasetOptions other = few(1);
  other.seed = 9;
  render_dataset(other, {.root = out / "d", .overwrite = true});
  render_dataset(other, {.root = out / "new"});
  EXPECT_TRUE(contents(out / "d") == contents(out / "new"));
}

/// What was told before counts as well, so a process of its own has to do it.
TEST(RenderDataset, TellsHowFarItIs) {
  const support::TemporaryDirectory out;
  const auto renders = [&] {
    render_dataset(few(1), {.root = out / "d"});
    fs::remove_all(out.path());
    std::_Exit(0);
  };
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(renders(), testing::ExitedWithCode(0), "rendering: 100 % mug_1\n");
  GTEST_FLAG_SET(death_test_style, "fast");
}

/// One view an object.
DatasetOptions single_views(int objects) {
  DatasetOptions options = few(objects);
  options.step_deg = 360.0;
  options.videos = {1};
  return options;
}

TEST(RenderDataset, TellsOfEachObjectThatIsComplete) {
  const support::TemporaryDirectory out;
  std::vector<std::string> told;
  const auto tell = [&](int objects, int of, const std::string& object) {
    told.push_back(std::to_string(objects) + " of " + std::to_string(of) + ": " + object);
  };
  const auto render = [&] {
    told.clear();
    return render_dataset(single_views(2), {.root = out / "d", .tell = tell});
  };
  EXPECT_EQ(render().views, 2);
  EXPECT_THAT(told, testing::ElementsAre("1 of 2: mug_1", "2 of 2: mug_2"));
  fs::remove_all(out / "d/mug/mug_1");
  const DatasetOutcome again = render();
  EXPECT_EQ(again.objects, 2);
  EXPECT_EQ(again.rendered, 1);
  EXPECT_EQ(again.views, 1);
  EXPECT_FALSE(again.stopped);
  EXPECT_THAT(told, testing::ElementsAre("1 of 2: mug_2", "2 of 2: mug_1"))
      << "what was there comes first";
}

/// A seed stands for the same recordings for ever.
TEST(RenderDataset, ARecordingIsDrawnByItsSeedItsObjectAndItsVideo) {
  const support::TemporaryDirectory out;
  for (const int session : {1, 2}) {
    DatasetOptions options = few(1);
    options.seed = 3;
    options.session = session;
    options.videos = {2};
    const fs::path root = out / std::to_string(session);
    render_dataset(options, {.root = root});
    const auto views = index_dataset(root).views;
    ASSERT_EQ(views.size(), 3U);
    Rng rng = Rng::stream(
        3, views[0].name.object + (session == 1 ? std::string("/2") : std::string("/2/session 2")));
    const Session drawn = draw_session(options, 0.25 * std::numbers::pi, rng);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(views[i].name.frame, static_cast<int>(i) + 1);
      const double yaw_rad =
          drawn.first_yaw_rad + static_cast<double>(i) * 2.0 * std::numbers::pi / 3.0;
      EXPECT_NEAR(std::remainder(views[i].yaw_rad - yaw_rad, 2.0 * std::numbers::pi), 0.0, 1e-5);
    }
  }
}

TEST(RenderDataset, SaysWhyItReplacesNothing) {
  const support::TemporaryDirectory out;
  fs::create_directories(out / "d");
  write_file(out / "d/dataset.yaml", "objects: 2\n");
  const auto refusal = [&](const DatasetOptions& options, int jobs) {
    try {
      render_dataset(options, {.root = out / "d", .jobs = jobs});
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(refusal({.objects = 1}, 1), testing::HasSubstr("holds 2 objects, more than 1"));
  EXPECT_THAT(refusal({.seed = 9, .objects = 2}, 1),
              testing::HasSubstr("was rendered with other options, see dataset.yaml"));
  EXPECT_THAT(refusal({.objects = 2}, 0), testing::HasSubstr("jobs 0: must be at least 1"));
  EXPECT_EQ(read_file(out / "d/dataset.yaml"), "objects: 2\n");
}

TEST(RenderDataset, OfModelsThatHaveMovedNothingIsMissing) {
  const support::TemporaryDirectory out;
  fs::create_directories(out / "d");
  fs::create_directories(out / "models/duck");
  write_file(out / "models/duck/model.obj", "v 1 2 3\n");
  write_file(out / "models/duck/texture.png", "is not read");
  write_file(out / "d/dataset.yaml", "models: " + (out / "models").string() + "\n");
  EXPECT_THAT(missing_objects(out / "d"), testing::ElementsAre("duck_1"));
  fs::remove_all(out / "models");
  EXPECT_THAT(missing_objects(out / "d"), testing::IsEmpty());
  EXPECT_EQ(dataset_options_text(out / "none"), "");
}

TEST(RenderDataset, CutByDepthLeavesOutWhatIsTooFlat) {
  const support::TemporaryDirectory out;
  DatasetOptions options = single_views(1);
  options.cut_by_depth = true;
  options.depth_noise = false;
  options.edge_dropout = 0.0;
  EXPECT_EQ(render_dataset(options, {.root = out / "mug"}).views, 1);
  const Eigen::Vector3d size_m(0.1, 0.1, 0.003);
  fs::create_directories(out / "models/plate");
  write_file(out / "models/plate/model.obj",
             to_obj(make_rounded_box(size_m, 0.001, 2, unfold_box(size_m))));
  write_png(Image(8, 8, RgbColour::Ones()), out / "models/plate/texture.png");
  options.models = (out / "models").string();
  const DatasetOutcome flat = render_dataset(options, {.root = out / "plate"});
  EXPECT_EQ(flat.rendered, 1);
  EXPECT_EQ(flat.views, 0);
}

}  // namespace
}  // namespace vantage
