// What all flying tasks share: images that may be used, objects in a scene, the model's file.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/temporary_directory.hpp"
#include "tests/tasks/flight/two_objects.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/data_root.hpp"
#include "vantage/core/log.hpp"
#include "vantage/runtime/episode_loop.hpp"
#include "vantage/tasks/flight/flight_world.hpp"
#include "vantage/tasks/flight/full_turn.hpp"
#include "vantage/tasks/flight/image_gate.hpp"
#include "vantage/tasks/flight/object_mjcf.hpp"
#include "vantage/tasks/flight/recognition_model_file.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

CameraImages image_of(float depth_m) {
  return {.width_px = 2,
          .height_px = 1,
          .focal_px = 50.0,
          .range_max_m = 3.5,
          .rgb = {},
          .depth_m = {depth_m, 1.5F}};
}

bool admits(ImageGate& gate, bool arrived, float depth_m) {
  CameraImages image = image_of(depth_m);
  return gate.admit(arrived, image);
}

TEST(ImageGate, AdmitsWhatArrivedAndIsNew) {
  ImageGate gate(9);
  EXPECT_TRUE(admits(gate, true, 1.0F));
  EXPECT_FALSE(admits(gate, true, 1.0F)) << "stale";
  EXPECT_TRUE(admits(gate, true, 1.25F));
  EXPECT_FALSE(admits(gate, false, 2.0F)) << "lost";
  EXPECT_FALSE(admits(gate, true, 1.25F)) << "as the last that was used";
  EXPECT_TRUE(admits(gate, true, 1.0F));
}

TEST(ImageGate, DiscardsReadingsThatSayNothing) {
  ImageGate gate(9);
  CameraImages image = image_of(3.5F);
  EXPECT_TRUE(gate.admit(true, image));
  EXPECT_EQ(image.depth_m, (std::vector<float>{0.0F, 1.5F}));
}

TEST(ImageGate, IsBlindAfterSoManyInARow) {
  ImageGate gate(3);
  EXPECT_FALSE(admits(gate, false, 1.0F));
  EXPECT_FALSE(admits(gate, false, 1.0F));
  EXPECT_TRUE(admits(gate, true, 1.0F)) << "and they are counted anew";
  EXPECT_FALSE(admits(gate, false, 2.0F));
  EXPECT_FALSE(admits(gate, true, 1.0F));
  try {
    admits(gate, false, 2.0F);
    FAIL() << "it still waits";
  } catch (const EpisodeFailed& error) {
    EXPECT_STREQ(error.what(), "the robot is blind: the last 3 images were lost or stale");
  }
}

TEST(ImageGate, LooksUntilAnImageIsAdmitted) {
  struct Taken {
    bool arrived;
    CameraImages images;
  };
  ImageGate gate(9);
  int taken = 0;
  const Taken first = gate.first_admitted([&] {
    ++taken;
    return Taken{taken > 2, image_of(static_cast<float>(taken))};
  });
  EXPECT_EQ(taken, 3);
  EXPECT_EQ(first.images.depth_m[0], 3.0F);
}

TEST(FlightWorld, IsCommandedAtEveryStep) {
  EXPECT_NO_THROW(require_flight_world({.timestep_s = 0.0025, .control_period_s = 0.0025}));
  EXPECT_THROW(require_flight_world({.timestep_s = 0.0025, .control_period_s = 0.005}),
               ConfigError);
  EXPECT_NEAR(std::cos(kTurn_rad / 6.0), 0.5, 1e-12) << "of a full turn";
}

TEST(ObjectMjcf, StandsOnTheMiddleOfItsFoot) {
  TurntableObject object;
  object.specular = 0.25;
  object.box_m = {Eigen::Vector3d(-0.5, -0.25, 0.125), Eigen::Vector3d(1.0, 1.25, 0.625)};
  const ObjectMjcf mjcf = object_mjcf("mug", object, {{1.5, -2.5, 0.75}, 0.6});
  EXPECT_EQ(mjcf.assets,
            "    <mesh name=\"mug\" file=\"mug.obj\"/>\n"
            "    <texture name=\"mug\" type=\"2d\" file=\"mug.png\"/>\n"
            "    <material name=\"mug\" texture=\"mug\" specular=\"0.25\" shininess=\"0.425\"/>\n");
  EXPECT_EQ(mjcf.body,
            fmt::format("    <body name=\"mug\" pos=\"1.5 -2.5 0.75\" quat=\"{} 0 0 {}\">\n"
                        "      <geom name=\"mug\" type=\"mesh\" mesh=\"mug\" material=\"mug\" "
                        "pos=\"-0.25 -0.5 -0.125\"/>\n"
                        "    </body>\n",
                        std::cos(0.3), std::sin(0.3)));
  EXPECT_EQ(mjcf_file("A\n", "B\n"),
            "<mujoco>\n  <asset>\nA\n  </asset>\n  <worldbody>\nB\n  </worldbody>\n</mujoco>\n");
}

TEST(ObjectDatabase, IsThatOfTheDataset) {
  const DatasetOptions dataset = dataset_of({.seed = 7, .objects = 12, .models = ""});
  EXPECT_EQ(dataset.seed, 7U);
  EXPECT_EQ(dataset.objects, 12);
  EXPECT_EQ(dataset.models, "");
  EXPECT_THROW(dataset_of({.seed = 7, .objects = 12, .models = "no/such/folder"}), InputError);
}

TEST(RecognitionModelFile, KeepsItsNameWhereItIsNotFound) {
  const support::TemporaryDirectory folder;
  write_file(folder / "mine.model", "bytes");
  EXPECT_EQ(found_model_name("", folder.path()), "");
  EXPECT_EQ(found_model_name("no/such.model", folder.path()), "no/such.model");
  const fs::path found = found_model_name("mine.model", folder.path());
  EXPECT_TRUE(found.is_absolute());
  EXPECT_EQ(found.filename(), "mine.model");
  const std::vector<InputFile> inputs = flight_inputs("no/such.model", {});
  ASSERT_EQ(inputs.size(), 1U);
  EXPECT_EQ(inputs[0].key, "model");
  EXPECT_EQ(inputs[0].path, data_root() / "no/such.model");
  try {
    find_recognition_model("no/such.model");
    FAIL() << "there is none";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("vantage train --recipe FILE.yaml --out no/such.model"));
  }
}

/// They are compiled into the world: another mesh is another episode.
TEST(FlightInputs, ScannedObjectsAreAmongThem) {
  const support::TemporaryDirectory folder;
  for (const char* name : {"cup", "box", "fork", "no_object"}) {
    fs::create_directory(folder / name);
  }
  for (const char* name : {"cup", "box", "fork"}) {
    write_file(folder / name / "model.obj", "v 0 0 0");
    write_file(folder / name / "texture.png", "");
  }
  write_file(folder / "no_object" / "model.obj", "");
  const ObjectDatabaseOptions two{.seed = 1, .objects = 2, .models = folder.path().string()};
  std::vector<std::string> keys;
  for (const InputFile& input : flight_inputs("a.model", two)) keys.push_back(input.key);
  EXPECT_THAT(keys, testing::ElementsAre(
                        "model", "database.models/box/model.obj", "database.models/box/texture.png",
                        "database.models/cup/model.obj", "database.models/cup/texture.png"));
  EXPECT_EQ(flight_inputs("a.model", {.seed = 1, .objects = 2, .models = "no/such"}).size(), 1U);
}

TEST(RecognitionModelFile, MustKnowWhatStandsThereOrCallItUnknown) {
  const fs::path path = "my.model";
  Recogniser recogniser = support::recogniser_of_two();
  EXPECT_NO_THROW(require_known(recogniser, path, "bowl_2", "stands on the table"));
  EXPECT_NO_THROW(require_known(recogniser, path, "", "stands on the table"));
  EXPECT_NO_THROW(require_answer(recogniser, path, "mug_1", "stands on the table"));
  try {
    require_answer(recogniser, path, "lamp_1", "stands on the table");
    FAIL() << "it has no answer";
  } catch (const ConfigError& error) {
    EXPECT_THAT(
        error.what(),
        HasSubstr("model: my.model: knows 2 objects, but not 'lamp_1', which stands on the table"));
  }
  recogniser.states.unknown_category = {kNoCategory};
  EXPECT_NO_THROW(require_answer(recogniser, path, "lamp_1", "stands on the table"));
  EXPECT_THROW(require_known(recogniser, path, "lamp_1", "is expected there"), ConfigError);
}

TEST(RecognitionModelFile, IsNamedByItsKeyWhereItIsNotFound) {
  try {
    find_recognition_model("no/such.model");
    FAIL() << "there is none";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("model: no/such.model: no such file"));
  }
}

TEST(RecognitionModelFile, TellsWhereUnknownIsTheRightAnswer) {
  const support::TemporaryDirectory folder;
  Recogniser recogniser = support::recogniser_of_two();
  recogniser.states.unknown_category = {kNoCategory};
  log_to_file(folder / "log.txt");
  for (const char* object : {"", "mug_1", "bowl_2", "lamp_1"}) {
    require_answer(recogniser, "my.model", object, "stands on the table");
  }
  log_to_file({});
  const std::string log = read_file(folder / "log.txt");
  EXPECT_EQ(std::ranges::count(log, '\n'), 1) << log;
  EXPECT_THAT(log, HasSubstr("my.model: does not know 'lamp_1', which stands on the table"));
}

TEST(ObjectDatabase, OfModelsIsFoundWhereTheyLie) {
  const support::TemporaryDirectory folder;
  const std::string models = folder.path().string();
  const DatasetOptions dataset = dataset_of({.seed = 7, .objects = 12, .models = models});
  EXPECT_EQ(dataset.models, models);
  EXPECT_EQ(dataset.seed, 7U);
  EXPECT_EQ(dataset.objects, 12);
}

}  // namespace
}  // namespace vantage
