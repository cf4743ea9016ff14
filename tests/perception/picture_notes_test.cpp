#include "vantage/perception/picture_notes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"
#include "vantage/perception/object_cut.hpp"

namespace vantage {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(PictureNotes, ComeBackFromText) {
  PictureNotes notes;
  notes.cut = "depth";
  notes.focal_px = 525.25;
  notes.centre_px = {319.5, 239.25};
  notes.recordings = {"kitchen", "office"};
  notes.bins = 3;
  notes.views = {"front", "", "back"};
  notes.degrees = false;
  const PictureNotes back = picture_notes_of(to_text(notes), "notes");
  EXPECT_EQ(back.cut, "depth");
  EXPECT_EQ(back.focal_px, 525.25);
  EXPECT_EQ(back.centre_px, (std::array{319.5, 239.25}));
  EXPECT_THAT(back.recordings, ElementsAre("kitchen", "office"));
  EXPECT_EQ(back.bins, 3);
  EXPECT_THAT(back.views, ElementsAre("front", "", "back"));
  EXPECT_FALSE(back.degrees);
}

TEST(PictureNotes, AreThoseOfTheFolderIfItHasAny) {
  const support::TemporaryDirectory folder;
  EXPECT_FALSE(read_picture_notes(folder.path()));
  EXPECT_FALSE(read_picture_notes(folder.path() / "none"));
  write_file(folder.path() / "pictures.yaml", "bins: 12\n");
  const auto notes = read_picture_notes(folder.path());
  ASSERT_TRUE(notes);
  EXPECT_EQ(notes->bins, 12);
  EXPECT_EQ(notes->cut, "mask");
}

TEST(PictureNotes, NameTheFileAndWhatIsWrong) {
  const auto refuses = [](const char* text, const char* why) {
    EXPECT_THAT([&] { picture_notes_of(text, "pictures"); },
                ThrowsMessage<ConfigError>(testing::AllOf(HasSubstr("pictures"), HasSubstr(why))))
        << text;
  };
  refuses("cut: hand\n", "'hand' is none of mask, depth, whole");
  refuses("bins: 3\nviews: [front, back]\n", "2 names for 3 bins");
  refuses("focal_px: 0.0\n", "focal_px");
  EXPECT_NO_THROW(picture_notes_of("bins: 2\nviews: [front, back]\n", "pictures"));
  EXPECT_NO_THROW(picture_notes_of("bins: 3\nviews: []\n", "pictures"));
}

TEST(PictureNotes, FindABinByItsNameInAnyCase) {
  PictureNotes notes;
  notes.views = {"front", "", "Back_Left", "back"};
  EXPECT_EQ(bin_of_view(notes, "FRONT"), 0);
  EXPECT_EQ(bin_of_view(notes, "back_left"), 2);
  EXPECT_EQ(bin_of_view(notes, "bacK"), 3);
  EXPECT_EQ(bin_of_view(notes, "bac"), std::nullopt);
  EXPECT_EQ(bin_of_view(notes, ""), std::nullopt) << "a bin without a name is none";
}

TEST(ObjectCutNames, GoToAndFro) {
  EXPECT_EQ(to_string(ObjectCut::mask), "mask");
  EXPECT_EQ(to_string(ObjectCut::depth), "depth");
  EXPECT_EQ(to_string(ObjectCut::whole), "whole");
  for (const ObjectCut cut : {ObjectCut::mask, ObjectCut::depth, ObjectCut::whole}) {
    EXPECT_EQ(object_cut_of(to_string(cut), "here"), cut);
  }
  EXPECT_THAT([] { object_cut_of("Mask", "here"); },
              ThrowsMessage<ConfigError>("here: 'Mask' is none of mask, depth, whole"));
}

}  // namespace
}  // namespace vantage
