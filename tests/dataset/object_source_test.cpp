#include "vantage/dataset/object_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/models/catalogue/database/object_database.hpp"
#include "vantage/models/catalogue/shapes/obj.hpp"
#include "vantage/models/catalogue/shapes/texture.hpp"

namespace vantage {
namespace {

TEST(ObjectSource, TakesTheFirstOfTheCatalogue) {
  const auto names = object_names({.objects = 10});
  const auto objects = object_database(1);
  ASSERT_EQ(names.size(), 10U);
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(names[i].object, objects[i].name);
    EXPECT_EQ(names[i].category, objects[i].category);
  }
  EXPECT_EQ(object_names({.objects = 1000}).size(), 326U);
}

TEST(ObjectSource, BoundsAreThoseOfTheMesh) {
  const TurntableObject object = make_turntable_object({}, object_names({.objects = 1}).front());
  const auto box = bounds(generate(object_database(1).front()).mesh);
  EXPECT_TRUE(object.box_m.isApprox(box));
  EXPECT_TRUE(object.png.starts_with("\x89PNG"));
}

class Scans : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"toy_2", "duck"}) {
      std::filesystem::create_directories(root_ / name);
      write_file(root_.path() / name / "model.obj",
                 "# scan\nv 0 0 0.1\nv 0.2 0 0.1\r\nv 0 -0.3 0.1\nv 0\t0 0.5\nvn 0 0 9\nf 1 2 3\n");
      write_png(Image(8, 8, RgbColour::Ones()), root_.path() / name / "texture.png");
    }
    std::filesystem::create_directories(root_ / "empty");
    options_.models = root_.path();
  }
  support::TemporaryDirectory root_;
  DatasetOptions options_;
};

TEST_F(Scans, AreCategoriesOfTheirOwn) {
  const auto names = object_names(options_);
  ASSERT_EQ(names.size(), 2U);
  EXPECT_EQ(names[0].object, "duck_1");
  EXPECT_EQ(names[1].object, "toy_2_1");
  EXPECT_EQ(names[1].category, "toy_2");
}

TEST_F(Scans, BoundsAreReadFromTheFile) {
  const TurntableObject object = make_turntable_object(options_, object_names(options_)[1]);
  EXPECT_TRUE(object.box_m.min().isApprox(Eigen::Vector3d(0, -0.3, 0.1)));
  EXPECT_TRUE(object.box_m.max().isApprox(Eigen::Vector3d(0.2, 0, 0.5)));
}

TEST_F(Scans, DamageIsNamed) {
  write_file(root_.path() / "duck" / "model.obj", "v 1 2\n");
  EXPECT_THROW(make_turntable_object(options_, object_names(options_)[0]), InputError);
  write_file(root_.path() / "duck" / "model.obj", "f 1 2 3\n");
  EXPECT_THROW(make_turntable_object(options_, object_names(options_)[0]), InputError);
  options_.models = root_ / "empty";
  EXPECT_THROW(object_names(options_), InputError);
}

TEST(DatasetOptionsTest, FramesAreWholeSteps) {
  EXPECT_EQ(DatasetOptions{.step_deg = 20.0}.frames(), 18);
  EXPECT_EQ(DatasetOptions{.step_deg = 22.5}.frames(), 16);
  EXPECT_EQ(DatasetOptions{.step_deg = 100.0}.frames(), 3);
  EXPECT_EQ(DatasetOptions{.step_deg = 0.1}.frames(), 3600);
  EXPECT_THROW(check_options(DatasetOptions{.supersampling = 2}), ConfigError);
}

TEST_F(Scans, AFolderWithoutOneIsNamedWithWhatIsLookedFor) {
  options_.models = root_ / "empty";
  EXPECT_THAT([&] { object_names(options_); },
              testing::ThrowsMessage<InputError>(
                  testing::AllOf(testing::StartsWith(options_.models + ": "),
                                 testing::HasSubstr("{model.obj, texture.png}"))));
}

TEST(ObjectSource, MakesTheObjectOfItsSeed) {
  const DatasetOptions options{.seed = 2, .objects = 3};
  const DatabaseObject wanted = object_database(2)[2];
  const ObjectName name = object_names(options).back();
  EXPECT_EQ(name.object, wanted.name);
  EXPECT_EQ(name.family, wanted.family);
  const GeneratedObject made = generate(wanted);
  const TurntableObject object = make_turntable_object(options, name);
  EXPECT_TRUE(object.obj == to_obj(made.mesh));
  EXPECT_TRUE(object.png == png_bytes(made.texture));
  EXPECT_EQ(object.specular, made.specular);
  EXPECT_TRUE(object.box_m.isApprox(bounds(made.mesh)));
}

TEST_F(Scans, AreTakenAsTheyAre) {
  const ObjectName name = object_names(options_)[1];
  EXPECT_EQ(name.family, "toy_2") << "it has no near-duplicates";
  const TurntableObject object = make_turntable_object(options_, name);
  EXPECT_EQ(object.obj, read_file(root_.path() / "toy_2" / "model.obj"));
  EXPECT_TRUE(object.png == read_file(root_.path() / "toy_2" / "texture.png"));
  EXPECT_EQ(object.specular, 0.2);
  options_.objects = 1;
  ASSERT_EQ(object_names(options_).size(), 1U);
  EXPECT_EQ(object_names(options_)[0].object, "duck_1");
}

TEST_F(Scans, AreFoldersWithBothFilesInOrderOfTheirNames) {
  const std::filesystem::path duck = root_.path() / "duck";
  for (const char* name : {"zebra", "ant", "mole", "bee", "cow"}) {
    std::filesystem::copy(duck, root_.path() / name);
  }
  for (int i = 0; i < 30; ++i) {
    const std::filesystem::path half = root_.path() / ("half_" + std::to_string(i));
    const char* file = i % 2 == 0 ? "model.obj" : "texture.png";
    std::filesystem::create_directories(half);
    std::filesystem::copy_file(duck / file, half / file);
  }
  std::vector<std::string> names;
  for (const ObjectName& name : object_names(options_)) names.push_back(name.object);
  EXPECT_THAT(names, testing::ElementsAre("ant_1", "bee_1", "cow_1", "duck_1", "mole_1", "toy_2_1",
                                          "zebra_1"));
}

}  // namespace
}  // namespace vantage
