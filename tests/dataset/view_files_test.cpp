#include "vantage/dataset/view_files.hpp"

#include <gtest/gtest.h>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/perception/dataset_reader.hpp"

namespace vantage {
namespace {

ObjectView random_view(Rng& rng) {
  ObjectView view;
  view.width_px = 1 + static_cast<int>(rng.uniform_index(40));
  view.height_px = 1 + static_cast<int>(rng.uniform_index(40));
  view.left_px = static_cast<int>(rng.uniform_index(600));
  view.top_px = static_cast<int>(rng.uniform_index(400));
  for (int i = 0; i < view.width_px * view.height_px; ++i) {
    for (int c = 0; c < 3; ++c)
      view.rgb.push_back(static_cast<std::uint8_t>(rng.uniform_index(256)));
    view.depth_m.push_back(0.001F * static_cast<float>(rng.uniform_index(4000)));
    view.mask.push_back(static_cast<std::uint8_t>(rng.uniform_index(2)));
  }
  view.mask.front() = 1;
  return view;
}

TEST(ViewFiles, AreReadAsTheyWereWritten) {
  const support::TemporaryDirectory folder;
  Rng rng(1);
  for (int i = 1; i <= 20; ++i) {
    const ObjectView view = random_view(rng);
    const double yaw_rad = rng.uniform(0.0, 6.2);
    const ViewEntry entry{{"cup", "cup_1", 2, i}, folder.path(), yaw_rad};
    write_view(view, entry);
    const LabelledView read = load_view(entry);
    EXPECT_EQ(read.view.width_px, view.width_px);
    EXPECT_EQ(read.view.left_px, view.left_px);
    EXPECT_EQ(read.view.top_px, view.top_px);
    EXPECT_EQ(read.view.rgb, view.rgb);
    EXPECT_EQ(read.view.mask, view.mask);
    for (std::size_t k = 0; k < view.depth_m.size(); ++k) {
      ASSERT_FLOAT_EQ(read.view.depth_m[k], view.depth_m[k]);
    }
  }
}

TEST(ViewFiles, AFolderThatIsNotThereIsNamed) {
  Rng rng(1);
  const ViewEntry entry{{"cup", "cup_1", 2, 1}, "/nonexistent/cup_1", 0.0};
  EXPECT_THROW(write_view(random_view(rng), entry), OutputError);
}

}  // namespace
}  // namespace vantage
