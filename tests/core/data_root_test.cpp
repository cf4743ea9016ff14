#include "vantage/core/data_root.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

class DataRoot : public testing::Test {
 protected:
  DataRoot() { ::setenv("VANTAGE_DATA", (directory / "data").c_str(), 1); }
  ~DataRoot() override { ::unsetenv("VANTAGE_DATA"); }

  std::filesystem::path make(const std::string& name) {
    const auto path = directory / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << "x";
    return path;
  }
  support::TemporaryDirectory directory;
};

TEST_F(DataRoot, TheVariableWins) { EXPECT_EQ(data_root(), directory / "data"); }

TEST_F(DataRoot, WithoutVariableTheModelsAreThere) {
  ::unsetenv("VANTAGE_DATA");
  EXPECT_TRUE(std::filesystem::is_directory(data_root() / "models"));
}

TEST_F(DataRoot, BesideTheEpisodeBeforeTheOneThatCameWithVantage) {
  make("data/scenes/a.xml");
  const auto own = make("mine/scenes/a.xml");
  EXPECT_TRUE(
      std::filesystem::equivalent(find_input("scenes/a.xml", directory / "mine", "scene"), own));
  EXPECT_TRUE(
      std::filesystem::equivalent(find_input("scenes/a.xml", directory / "elsewhere", "scene"),
                                  directory / "data" / "scenes" / "a.xml"));
  EXPECT_EQ(find_input(own.string(), "/", "scene"), own);
}

TEST(SceneTitle, IsTheNameThatPeopleUse) {
  EXPECT_EQ(scene_title("models/scenes/office_small_2/scene.xml"), "office_small_2");
  EXPECT_EQ(scene_title("/home/me/kitchen.xml"), "kitchen");
  EXPECT_EQ(scene_title("scene.xml"), "scene");
  EXPECT_EQ(scene_title("./scene.xml"), "scene");
  EXPECT_EQ(scene_title("tabletop, 8 objects"), "tabletop, 8 objects");
  EXPECT_EQ(scene_title(""), "");
}

TEST_F(DataRoot, MissingFilesNameTheKeyAndTheFile) {
  try {
    (void)find_input("scenes/none.xml", directory.path(), "scene");
    FAIL() << "found a file that is not there";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("scene"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("none.xml"), std::string::npos);
  }
}

TEST_F(DataRoot, AFileHasANameThatLasts) {
  make("data/scenes/a.xml");
  const auto own = make("mine/b.xml");
  EXPECT_EQ(lasting_name(directory / "data/scenes/a.xml"), "scenes/a.xml");
  EXPECT_EQ(lasting_name(directory / "data/robots/../scenes/a.xml"), "scenes/a.xml");
  EXPECT_EQ(lasting_name(own), own.string());
}

TEST_F(DataRoot, TheVariableCountsUnlessItIsEmpty) {
  set_data_root(directory / "told");
  EXPECT_EQ(data_root(), directory / "data");
  ::setenv("VANTAGE_DATA", "", 1);
  EXPECT_EQ(data_root(), directory / "told");
  set_data_root({});
  EXPECT_NE(data_root(), directory / "told");
}

TEST_F(DataRoot, WhatIsNotThereIsToldWithTheKey) {
  const auto refusal = [&](const std::string& name, const std::filesystem::path& base) {
    try {
      return find_input(name, base, "scene").string();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  const std::string data = (directory / "data").string();
  EXPECT_EQ(refusal("", {}), "scene: no file named");
  EXPECT_EQ(refusal("/none/a.xml", {}), "scene: /none/a.xml: no such file");
  EXPECT_EQ(
      refusal("none/a.xml", "/base"),
      "scene: none/a.xml: no such file (looked in /base, the working directory and " + data + ")");
  EXPECT_EQ(
      refusal("none/a.xml", {}),
      "scene: none/a.xml: no such file (looked in ., the working directory and " + data + ")");
}

/// Asked of a copy of this program, in <prefix>/bin as it is installed.
TEST(InstalledDataRoot, IsBesideTheProgramIfThereAreModels) {
  if (const char* answer = std::getenv("VANTAGE_TEST_ANSWER"); answer != nullptr) {
    std::ofstream(answer) << data_root().string();
    return;
  }
  const support::TemporaryDirectory prefix;
  std::filesystem::create_directories(prefix / "bin");
  std::filesystem::copy_file("/proc/self/exe", prefix / "bin/program");
  const auto answer = [&] {
    const std::string file = (prefix / "answer").string();
    const std::string command = "env -u VANTAGE_DATA VANTAGE_TEST_ANSWER='" + file + "' '" +
                                (prefix / "bin/program").string() +
                                "' '--gtest_filter=InstalledDataRoot.*' > /dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0);
    std::string told;
    std::ifstream stream(file);
    std::getline(stream, told);
    return std::filesystem::path(told);
  };
  EXPECT_EQ(answer(), std::filesystem::path(VANTAGE_SOURCE_DIR));
  std::filesystem::create_directories(prefix / "share/vantage/models");
  EXPECT_EQ(answer(), std::filesystem::canonical(prefix.path()) / "share" / "vantage");
}

}  // namespace
}  // namespace vantage
