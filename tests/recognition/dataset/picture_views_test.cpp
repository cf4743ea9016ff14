// Which views of a dataset are used, and how imported ones are made to fit.
#include "vantage/recognition/dataset/picture_views.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

ViewEntry entry_of(int video, int frame, std::shared_ptr<const PictureNotes> notes = nullptr) {
  ViewEntry entry;
  entry.name = {.category = "cup", .object = "cup_1", .video = video, .frame = frame};
  entry.folder = "/data/cup/cup_1";
  entry.notes = std::move(notes);
  return entry;
}

std::shared_ptr<const PictureNotes> notes_with(const PictureNotes& notes) {
  return std::make_shared<const PictureNotes>(notes);
}

PictureNotes notes_of_bins(int bins, double focal_px = 500.0) {
  PictureNotes notes;
  notes.bins = bins;
  notes.focal_px = focal_px;
  return notes;
}

PictureNotes notes_of_cut(const std::string& cut) {
  PictureNotes notes;
  notes.cut = cut;
  return notes;
}

/// One bin each.
PictureNotes notes_of_names(const std::vector<std::string>& names, bool degrees = false) {
  PictureNotes notes = notes_of_bins(static_cast<int>(names.size()));
  notes.views = names;
  notes.degrees = degrees;
  return notes;
}

std::vector<int> frames_of(const std::vector<ViewEntry>& views) {
  std::vector<int> frames;
  for (const ViewEntry& view : views) frames.push_back(view.name.frame);
  return frames;
}

std::string words_of(const auto& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(ChosenViews, OfARenderedDatasetAreThoseOfTheVideos) {
  DatasetIndex dataset;
  for (const int video : {1, 2, 4, 1, 2}) {
    dataset.views.push_back(entry_of(video, static_cast<int>(dataset.views.size())));
  }
  const std::vector<std::string> recordings{"hall"};
  EXPECT_THAT(frames_of(chosen_views(dataset, std::vector{1, 4}, recordings)),
              ElementsAre(0, 2, 3));
  EXPECT_THAT(frames_of(chosen_views(dataset, std::vector{2}, {})), ElementsAre(1, 4));
  EXPECT_THAT(words_of([&] {
                chosen_views(dataset, std::vector{3, 7}, {});
              }),
              HasSubstr("no views of video 3, 7"));
}

TEST(ChosenViews, OfPicturesAreThoseOfTheRecordings) {
  PictureNotes named;
  named.recordings = {"kitchen", "hall"};
  const auto notes = notes_with(named);
  DatasetIndex dataset;
  for (const int recording : {1, 2, 3, 0, 2}) {
    dataset.views.push_back(entry_of(recording, static_cast<int>(dataset.views.size()), notes));
  }
  const auto chosen = [&](const std::vector<std::string>& recordings) {
    return frames_of(chosen_views(dataset, std::vector{1}, recordings));
  };
  EXPECT_THAT(chosen({}), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(chosen({"hall"}), ElementsAre(1, 4));
  EXPECT_THAT(chosen({"kitchen"}), ElementsAre(0));
  EXPECT_THAT(chosen({"3", "kitchen"}), ElementsAre(0, 2)) << "one without a name is a number";
  EXPECT_THAT(chosen({"0"}), ElementsAre(3));
  EXPECT_THAT(
      words_of([&] {
        chosen({"attic", "2"});
      }),
      HasSubstr("recordings: the dataset has none of attic, 2; known: 0, 3, hall, kitchen"));
}

TEST(CommonNotes, AreThoseWithMostBins) {
  const auto four = notes_with(notes_of_bins(4, 100.0));
  const auto six = notes_with(notes_of_bins(6, 200.0));
  const auto also_six = notes_with(notes_of_bins(6, 300.0));
  EXPECT_FALSE(common_notes(std::vector{entry_of(1, 1), entry_of(2, 1)}, 0));
  EXPECT_FALSE(common_notes({}, 12));
  EXPECT_EQ(common_notes(std::vector{entry_of(1, 1, four), entry_of(1, 2, six)}, 0)->bins, 6);
  EXPECT_EQ(common_notes(std::vector{entry_of(1, 1, six), entry_of(1, 2, four)}, 0)->bins, 6);
  EXPECT_EQ(common_notes(std::vector{entry_of(1, 1, six), entry_of(1, 2, also_six)}, 0)->focal_px,
            200.0);
}

TEST(CommonNotes, TakeTheBinsAskedForWhereDirectionsAreAngles) {
  PictureNotes notes = notes_of_names({"front", "left", "right"}, true);
  const auto by_angle = std::vector{entry_of(1, 1, notes_with(notes))};
  const auto more = common_notes(by_angle, 12);
  EXPECT_EQ(more->bins, 12);
  EXPECT_THAT(more->views, IsEmpty());
  for (const int as_imported : {0, 3}) {
    EXPECT_EQ(common_notes(by_angle, as_imported)->bins, 3);
    EXPECT_EQ(common_notes(by_angle, as_imported)->views, notes.views);
  }
  notes.degrees = false;
  const auto by_name = std::vector{entry_of(1, 1, notes_with(notes))};
  EXPECT_EQ(common_notes(by_name, 3)->bins, 3);
  EXPECT_EQ(common_notes(by_name, 0)->bins, 3);
  EXPECT_THAT(words_of([&] { (void)common_notes(by_name, 12); }),
              HasSubstr("3 views that are told by name need as many, not 12"));
}

TEST(CommonNotes, AreOfPicturesCutAlike) {
  const std::vector<ViewEntry> views{entry_of(1, 1, notes_with(notes_of_cut("depth"))),
                                     entry_of(1, 2, notes_with(notes_of_cut("whole")))};
  EXPECT_THAT(words_of([&] { (void)common_notes(views, 0); }),
              HasSubstr("was cut by depth and /data/cup/cup_1 by whole"));
}

TEST(NotesOfAModel, AreKeptWithTheFloor) {
  RecognitionModel model;
  EXPECT_FALSE(notes_of(model));
  EXPECT_EQ(cut_of(model), ObjectCut::mask);
  EXPECT_EQ(std::get<ShrunkVariance>(floored(model, ShrunkVariance{.floor = 0.2})).floor, 0.2);
  PictureNotes notes = notes_of_bins(12, 525.5);
  notes.cut = "depth";
  keep_notes(notes, 0.3, model);
  EXPECT_EQ(notes_of(model)->bins, 12);
  EXPECT_EQ(notes_of(model)->focal_px, 525.5);
  EXPECT_EQ(cut_of(model), ObjectCut::depth);
  const auto low = std::get<ShrunkVariance>(floored(model, ShrunkVariance{.nu0 = 7.0}));
  EXPECT_EQ(low.floor, 0.3);
  EXPECT_EQ(low.nu0, 7.0);
  EXPECT_EQ(std::get<ShrunkVariance>(floored(model, ShrunkVariance{.floor = 0.5})).floor, 0.5);
  EXPECT_EQ(std::get<LiteralVariance>(floored(model, LiteralVariance{.floor = 0.2})).floor, 0.2);
}

TEST(UnseenStates, AreThoseThatNoFeatureHasAViewOf) {
  RecognitionModel model;
  model.states = {.objects = {"a_1", "a_2"}, .categories = {"a"}, .category_of = {0, 0}, .bins = 3};
  for (const std::vector<int>& count : {std::vector{1, 0, 0, 2, 0, 0}, {0, 0, 3, 0, 0, 1}}) {
    FeatureModel& feature = model.features.emplace_back();
    feature.statistics = empty_statistics(1, 6);
    feature.statistics.count = count;
  }
  EXPECT_THAT(unseen_states(model), IsEmpty()) << "of a model of no pictures";
  keep_notes({}, 0.0, model);
  EXPECT_THAT(unseen_states(model), ElementsAre(1, 4));
}

TEST(FitTo, LeavesAnglesAndMasksAsTheyAre) {
  std::vector<ViewEntry> views{entry_of(1, 1), entry_of(1, 2, notes_with(notes_of_bins(5)))};
  views[0].yaw_rad = 1.25;
  views[1].yaw_rad = 2.5;
  fit_to(std::nullopt, views);
  fit_to(notes_of_bins(7), views);
  EXPECT_EQ(views[0].yaw_rad, 1.25);
  EXPECT_EQ(views[1].yaw_rad, 2.5);
  EXPECT_FALSE(views[0].cut);
  EXPECT_FALSE(views[1].cut);
}

TEST(FitTo, CutsAsThePicturesOfTheModelWere) {
  std::vector<ViewEntry> views{entry_of(1, 1), entry_of(1, 2, notes_with(notes_of_cut("whole")))};
  fit_to(notes_of_cut("depth"), views);
  EXPECT_EQ(views[0].cut, ObjectCut::depth);
  EXPECT_EQ(views[1].cut, ObjectCut::depth);
}

TEST(FitTo, GivesViewsThePlaceOfTheirName) {
  const PictureNotes model = notes_of_names({"front", "left", "back"});
  const auto own = notes_with(notes_of_names({"Back", "top", "FRONT", "left"}));
  std::vector<ViewEntry> views;
  for (int q = 0; q < 4; ++q) {
    views.push_back(entry_of(1, q, own));
    views.back().yaw_rad = q * std::numbers::pi / 2.0;
  }
  std::vector<ViewEntry> top{views[1]};
  views.erase(views.begin() + 1);
  views.push_back(entry_of(1, 9));
  views.back().yaw_rad = 1.5;
  fit_to(model, views);
  EXPECT_NEAR(views[0].yaw_rad, 4.0 * std::numbers::pi / 3.0, 1e-12);
  EXPECT_NEAR(views[1].yaw_rad, 0.0, 1e-12);
  EXPECT_NEAR(views[2].yaw_rad, 2.0 * std::numbers::pi / 3.0, 1e-12);
  EXPECT_EQ(views[3].yaw_rad, 1.5) << "it was not imported";
  EXPECT_THAT(words_of([&] { fit_to(model, top); }),
              HasSubstr("cup_1_1_1_crop.png: is a view 'top', which the model does not know; "
                        "known: front, left, back"));
}

TEST(FitTo, NamesMustBeThereOnBothSides) {
  const PictureNotes by_name = notes_of_names({"front", "back"});
  const PictureNotes by_angle = notes_of_bins(2);
  std::vector<ViewEntry> nameless{entry_of(1, 1, notes_with(by_angle))};
  EXPECT_THROW(fit_to(by_name, nameless), InputError);
  std::vector<ViewEntry> named{entry_of(1, 1, notes_with(by_name))};
  EXPECT_THROW(fit_to(by_angle, named), InputError);
}

TEST(DropCopies, TakesOutTheSamePicturesOfTheSameObject) {
  const support::TemporaryDirectory folder;
  std::vector<ViewEntry> views;
  const auto put = [&](const std::string& object, const std::string& crop,
                       const std::string& depth) {
    ViewEntry view = entry_of(1, static_cast<int>(views.size()));
    view.name.object = object;
    view.folder = folder.path();
    write_file(view.file("crop.png"), crop);
    write_file(view.file("depthcrop.png"), depth);
    views.push_back(view);
  };
  put("cup_1", "red", "near");
  put("cup_1", "red", "far");
  put("cup_1", "blue", "near");
  put("cup_1", "red", "near");
  put("cup_2", "red", "near");
  put("cup_1", "blue", "near");
  const std::string example =
      views[3].file("crop.png").string() + " is " + views[0].file("crop.png").string();
  testing::internal::CaptureStderr();
  EXPECT_EQ(drop_copies(views), 2U);
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              HasSubstr("2 views are copies of others and count once: " + example + "\n"));
  EXPECT_THAT(frames_of(views), ElementsAre(0, 1, 2, 4));
  EXPECT_EQ(drop_copies(views), 0U);
}

TEST(NamedViews, AreThoseOfBinsThatHaveAName) {
  EXPECT_EQ(named_views(notes_of_names({"front", "", "left", ""})), "front, left");
  EXPECT_EQ(named_views(notes_of_bins(4)), "");
}

TEST(FitTo, SaysHowManyPicturesHaveNoMaskAsTheModelsHad) {
  const auto by_depth = notes_with(notes_of_cut("depth"));
  std::vector<ViewEntry> views{entry_of(1, 1, by_depth), entry_of(1, 2), entry_of(1, 3, by_depth)};
  const auto said = [&] {
    testing::internal::CaptureStderr();
    fit_to(notes_of_bins(8), views);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_THAT(said(), HasSubstr("2 of 3 here are cut by depth"));
  EXPECT_FALSE(views[0].cut) << "as they are";
  views = {entry_of(1, 2)};
  EXPECT_EQ(said(), "");
}

TEST(NotesOfAModel, HaveNoFloorWhereNoneIsSaid) {
  RecognitionModel model;
  model.pictures = "pictures: {bins: 12}\n";
  EXPECT_EQ(notes_of(model)->bins, 12);
  EXPECT_EQ(std::get<ShrunkVariance>(floored(model, ShrunkVariance{.floor = 0.2})).floor, 0.2);
}

TEST(CommonNotes, AreOfTheImportedViewsAmongOthers) {
  const auto four = notes_with(notes_of_bins(4));
  EXPECT_EQ(common_notes(std::vector{entry_of(1, 1), entry_of(1, 2, four)}, 0)->bins, 4);
}

TEST(FitTo, PassesByWhatWasNotImported) {
  const auto names = notes_with(notes_of_names({"left", "front"}));
  std::vector<ViewEntry> views{entry_of(1, 1), entry_of(1, 2, names)};
  fit_to(notes_of_names({"front", "left"}), views);
  EXPECT_NEAR(views[1].yaw_rad, std::numbers::pi, 1e-12);
}

TEST(DropCopies, TellsOfASingleOneAndNotOfNone) {
  const support::TemporaryDirectory folder;
  std::vector<ViewEntry> views(2, entry_of(1, 1));
  for (ViewEntry& view : views) view.folder = folder.path();
  write_file(views[0].file("crop.png"), "red");
  write_file(views[0].file("depthcrop.png"), "near");
  const auto said = [&] {
    testing::internal::CaptureStderr();
    drop_copies(views);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_THAT(said(), HasSubstr("1 views are copies"));
  EXPECT_EQ(said(), "");
}

}  // namespace
}  // namespace vantage
