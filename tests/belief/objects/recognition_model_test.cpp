#include "vantage/belief/objects/recognition_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "tests/belief/objects/recognition_world.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/bytes.hpp"
#include "vantage/core/hash.hpp"

namespace vantage {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::size_t kVersionAt = 26;
constexpr std::size_t kSizeAt = kVersionAt + 4;
constexpr std::size_t kHashAt = kSizeAt + 8;
constexpr std::size_t kHeader = kHashAt + 8;

RecognitionModel small_model() {
  RecognitionModel model;
  model.states = test::make_states({0, 0, 1}, 4);
  model.transitions = prior_counts(TableTransition{}, 4, 3.0);
  Rng rng(31);
  for (const std::string name : {"colour", "sift"}) {
    FeatureModel feature{.name = name,
                         .statistics = empty_statistics(6, model.states.size()),
                         .psi = 0.25,
                         .cost_s = 0.5,
                         .blobs = {{"vocabulary", std::string("a\0b", 3)}, {"empty", ""}}};
    for (int v = 0; v < 40; ++v) {
      const auto state = static_cast<int>(rng.uniform_index(12));
      add_view(feature.statistics, state, Eigen::VectorXf::NullaryExpr(6, [&] {
                 return static_cast<float>(rng.normal(state, 1.0));
               }));
    }
    model.features.push_back(std::move(feature));
  }
  return model;
}

/// With the size and hash that belong to its payload, as someone hostile would write them.
std::string sealed(const std::string& bytes) {
  const std::string_view payload = std::string_view(bytes).substr(kHeader);
  std::string header = bytes.substr(0, kSizeAt);
  put(header, static_cast<std::uint64_t>(payload.size()));
  put(header, hash_bytes(payload));
  return header.append(payload);
}

class RecognitionFile : public ::testing::Test {
 protected:
  void SetUp() override {
    write_recognition_model(small_model(), path_);
    whole_ = read_file(path_);
  }

  /// The error of reading these bytes; empty if they were read.
  std::string error_of(const std::string& bytes) {
    std::filesystem::remove(path_);
    std::ofstream(path_, std::ios::binary) << bytes;
    try {
      read_recognition_model(path_);
      return "";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("small.model"));
      return error.what();
    }
  }

  support::TemporaryDirectory directory_;
  std::filesystem::path path_ = directory_ / "small.model";
  std::string whole_;
};

TEST_F(RecognitionFile, KeepsEverything) {
  const RecognitionModel written = small_model();
  const RecognitionModel read = read_recognition_model(path_);
  EXPECT_EQ(read.states.objects, written.states.objects);
  EXPECT_EQ(read.states.categories, written.states.categories);
  EXPECT_EQ(read.states.category_of, written.states.category_of);
  EXPECT_EQ(read.states.bins, written.states.bins);
  EXPECT_EQ(read.transitions.slip, written.transitions.slip);
  EXPECT_EQ(read.transitions.other_category, written.transitions.other_category);
  ASSERT_EQ(read.features.size(), 2U);
  for (std::size_t f = 0; f < 2; ++f) {
    EXPECT_EQ(read.features[f].name, written.features[f].name);
    EXPECT_EQ(read.features[f].psi, 0.25);
    EXPECT_EQ(read.features[f].cost_s, 0.5);
    EXPECT_EQ(read.features[f].blobs, written.features[f].blobs);
    EXPECT_EQ(read.features[f].statistics.count, written.features[f].statistics.count);
  }
}

TEST_F(RecognitionFile, RecognisesAsTheModelThatWasWritten) {
  const FeatureModel before = small_model().features[0];
  const FeatureModel after = read_recognition_model(path_).features[0];
  const ObservationModel written = make_observation_model(before, 4, ShrunkVariance{});
  const ObservationModel read = make_observation_model(after, 4, ShrunkVariance{});
  EXPECT_EQ(read.feature, "colour");
  EXPECT_EQ(read.psi, 0.25);
  EXPECT_EQ(read.cost_s, 0.5);
  const Eigen::VectorXf view = Eigen::VectorXf::Constant(6, 4.0F);
  EXPECT_TRUE(log_likelihood(read, view).isApprox(log_likelihood(written, view), 1e-4));
}

TEST_F(RecognitionFile, HoldsAModelThatLearntNothingYet) {
  write_recognition_model({}, path_);
  const RecognitionModel read = read_recognition_model(path_);
  EXPECT_EQ(read.states.object_count(), 0);
  EXPECT_EQ(read.transitions.slip.size(), 0);
  EXPECT_EQ(read.transitions.same_object, 0.0);
  EXPECT_EQ(read.transitions.other_instance, 0.0);
  EXPECT_EQ(read.transitions.other_category, 0.0);
  EXPECT_EQ(read.view_correlation, 0.0);
  EXPECT_TRUE(read.features.empty());
}

TEST_F(RecognitionFile, SaysWhatIsWrong) {
  EXPECT_THAT(error_of(""), HasSubstr("is empty"));
  EXPECT_THAT(error_of("a letter, not a model, though long enough"),
              HasSubstr("is not a recognition model"));
  std::string newer = whole_;
  newer[kVersionAt] = 9;
  EXPECT_THAT(error_of(newer), HasSubstr("is of version 9, this program reads 1 and 2"));
  std::string damaged = whole_;
  damaged[kHeader + 50] ^= 1;
  EXPECT_THAT(error_of(damaged), HasSubstr("is damaged"));
  EXPECT_THAT(error_of(whole_ + "x"), HasSubstr("after its header"));
  EXPECT_THAT(error_of(sealed(whole_ + "x")), HasSubstr("ends within the notes on pictures"));
  std::filesystem::remove(path_);
  EXPECT_THROW(read_recognition_model(path_), InputError);
}

TEST_F(RecognitionFile, CutShortAnywhereIsAnError) {
  for (std::size_t length = 0; length < whole_.size(); ++length) {
    const std::string part = whole_.substr(0, length);
    EXPECT_NE(error_of(part), "") << length;
    if (length < kHeader) continue;
    EXPECT_THAT(error_of(sealed(part)), HasSubstr("ends within")) << length;
  }
}

TEST_F(RecognitionFile, NamesTheNumberThatMakesNoSense) {
  const auto with = [&](std::size_t at, auto value) {
    std::string bytes = whole_;
    std::memcpy(bytes.data() + at, &value, sizeof value);
    return error_of(sealed(bytes));
  };
  EXPECT_THAT(with(kHeader, std::int32_t{0}), HasSubstr("0 yaw bins"));
  EXPECT_THAT(with(kHeader, std::int32_t{1}), HasSubstr("1 yaw bins, must be in [2, 3600]"));
  EXPECT_THAT(with(kHeader, std::int32_t{1 << 30}), HasSubstr("yaw bins, must be in"));
  EXPECT_THAT(with(kHeader, std::int32_t{3601}), HasSubstr("3601 yaw bins"));
  EXPECT_THAT(with(kHeader, std::int32_t{3600}), HasSubstr("16 counts of slips"));
  EXPECT_THAT(with(kHeader, std::int32_t{2}), HasSubstr("16 counts of slips, 2 bins need 4"));
  EXPECT_THAT(with(kHeader + 4, std::uint32_t{0xffffffff}),
              HasSubstr("ends within the categories"));
  const std::size_t object = whole_.find("object_1");
  EXPECT_THAT(with(object + 8, std::int32_t{7}), HasSubstr("'object_1' is of category 7, of 2"));
  EXPECT_THAT(with(object + 7, '0'), HasSubstr("object 'object_0' appears twice"));
  const std::size_t psi = whole_.find("colour") + 6;
  EXPECT_THAT(with(psi, -1.0), HasSubstr("psi of feature colour is -1"));
  EXPECT_THAT(with(psi + 8, std::nan("")), HasSubstr("cost_s of feature colour is nan"));
  EXPECT_THAT(with(psi + 16, std::uint8_t{2}),
              HasSubstr("unknown of feature colour is marked 2, must be 0 or 1"));
}

TEST_F(RecognitionFile, HoldsTenMillionStatesAndNoMore) {
  const std::size_t objects_at = whole_.find("object_0") - 8;
  const auto of_objects = [&](std::uint32_t objects) {
    std::string bytes = whole_.substr(0, objects_at);
    const std::int32_t bins = 2500;
    std::memcpy(bytes.data() + kHeader, &bins, sizeof bins);
    put(bytes, objects);
    return error_of(sealed(bytes + std::string(8 * objects, '\0')));
  };
  EXPECT_THAT(of_objects(4000), HasSubstr("object '' appears twice"));
  EXPECT_THAT(of_objects(4001), HasSubstr("4001 objects of 2500 bins are too many"));
}

TEST_F(RecognitionFile, SurvivesDamageThatItsHashDoesNotShow) {
  Rng rng(32);
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string bytes = whole_;
    const auto edits = 1 + rng.uniform_index(3);
    for (std::size_t e = 0; e < edits; ++e) {
      const std::size_t at = kHeader + rng.uniform_index(bytes.size() - kHeader);
      const std::array<char, 5> values{'\0', '\1', '\x7f', '\x80', '\xff'};
      bytes[at] = values[rng.uniform_index(values.size())];
    }
    if (!error_of(sealed(bytes)).empty()) ++refused;
  }
  EXPECT_GT(refused, 500);
}

TEST_F(RecognitionFile, KeepsWhatWasLearntOfUnknownObjects) {
  RecognitionModel model = small_model();
  model.view_correlation = 0.35;
  model.features[1].unknown = UnknownFactors{.instance = -3.5, .category = 12.25};
  write_recognition_model(model, path_);
  const RecognitionModel read = read_recognition_model(path_);
  EXPECT_EQ(read.view_correlation, 0.35);
  EXPECT_FALSE(read.features[0].unknown);
  ASSERT_TRUE(read.features[1].unknown);
  EXPECT_EQ(read.features[1].unknown->instance, -3.5);
  EXPECT_EQ(read.features[1].unknown->category, 12.25);
}

TEST_F(RecognitionFile, OfFactorsThatAreNotFiniteIsRefused) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const UnknownFactors& factors :
       {UnknownFactors{.instance = -infinity, .category = 1.0},
        UnknownFactors{.instance = 1.0, .category = std::nan("")}}) {
    RecognitionModel model = small_model();
    model.features[1].unknown = factors;
    write_recognition_model(model, path_);
    EXPECT_THAT(error_of(read_file(path_)),
                HasSubstr("what is unknown of feature sift is not finite"));
  }
}

/// What version 1 had not: the correlation behind the transitions, and a mark behind each cost.
std::string as_version_1(std::string bytes, const RecognitionModel& model) {
  const auto erase_behind = [&](std::size_t at, std::size_t count) { bytes.erase(at, count); };
  for (std::size_t f = model.features.size(); f-- > 0;) {
    std::string head;
    put_text(head, model.features[f].name);
    put(head, model.features[f].psi);
    put(head, model.features[f].cost_s);
    erase_behind(bytes.find(head) + head.size(), 1);
  }
  std::string first;
  put_text(first, model.features[0].name);
  const std::size_t count_at = bytes.find(first) - sizeof(std::uint32_t);
  erase_behind(count_at - sizeof(double), sizeof(double));
  bytes[kVersionAt] = 1;
  return sealed(bytes);
}

TEST_F(RecognitionFile, OfVersionOneKnowsNothingOfUnknownObjects) {
  EXPECT_EQ(error_of(as_version_1(whole_, small_model())), "");
  const RecognitionModel read = read_recognition_model(path_);
  EXPECT_EQ(read.view_correlation, 0.0);
  EXPECT_FALSE(read.features[0].unknown);
  EXPECT_EQ(read.features[1].blobs, small_model().features[1].blobs);
  EXPECT_EQ(read.features[1].statistics.count, small_model().features[1].statistics.count);
}

TEST_F(RecognitionFile, OfImpossibleCorrelationIsRefused) {
  RecognitionModel model = small_model();
  model.view_correlation = 1.5;
  write_recognition_model(model, path_);
  EXPECT_THAT(error_of(read_file(path_)), HasSubstr("correlation of views is 1.5"));
  model.view_correlation = -0.25;
  write_recognition_model(model, path_);
  EXPECT_THAT(error_of(read_file(path_)), HasSubstr("is -0.25, must be in [0, 1]"));
  model.view_correlation = 1.0;
  write_recognition_model(model, path_);
  EXPECT_EQ(error_of(read_file(path_)), "");
}

TEST_F(RecognitionFile, KeepsNotesCountsAndMoments) {
  RecognitionModel model = small_model();
  model.pictures = "cut out of their background";
  model.transitions.same_object = 7.25;
  model.transitions.other_instance = 0.5;
  model.transitions.other_category = 1.75;
  write_recognition_model(model, path_);
  const RecognitionModel read = read_recognition_model(path_);
  EXPECT_EQ(read.pictures, "cut out of their background");
  EXPECT_EQ(read.transitions.same_object, 7.25);
  EXPECT_EQ(read.transitions.other_instance, 0.5);
  EXPECT_EQ(read.transitions.other_category, 1.75);
  for (std::size_t f = 0; f < 2; ++f) {
    const GaussianStatistics& before = model.features[f].statistics;
    const GaussianStatistics& after = read.features[f].statistics;
    EXPECT_LT((after.mean - before.mean).cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_LT((after.squared_deviation - before.squared_deviation).cwiseAbs().maxCoeff(), 1e-2);
  }
}

TEST_F(RecognitionFile, NamesWhatAppearsTwice) {
  std::string bytes = whole_;
  bytes[bytes.find("category_1") + 9] = '0';
  EXPECT_THAT(error_of(sealed(bytes)), HasSubstr("category 'category_0' appears twice"));
  RecognitionModel model = small_model();
  model.features[1].name = "colour";
  write_recognition_model(model, path_);
  EXPECT_THAT(error_of(read_file(path_)), HasSubstr("feature 'colour' appears twice"));
}

TEST_F(RecognitionFile, EndsWithItsNotes) {
  std::string noted = whole_;
  put_text(noted, "notes");
  EXPECT_EQ(error_of(sealed(noted)), "");
  EXPECT_THAT(error_of(sealed(noted + "x")), HasSubstr("has 1 bytes too many"));
}

TEST_F(RecognitionFile, NamesABlobThatAppearsTwice) {
  RecognitionModel model = small_model();
  auto& blobs = model.features[0].blobs;
  blobs["one"] = "a";
  blobs["two"] = "b";
  write_recognition_model(model, path_);
  std::string bytes = read_file(path_);
  ASSERT_EQ(error_of(bytes), "");
  bytes.replace(bytes.find("two"), 3, "one");
  EXPECT_THAT(error_of(sealed(bytes)), HasSubstr("blob 'one' appears twice"));
}

TEST_F(RecognitionFile, OfASingleByteIsNotEmptyButNoModel) {
  EXPECT_THAT(error_of("v"), HasSubstr("is not a recognition model"));
}

TEST_F(RecognitionFile, ObjectsAreOfCategoriesThatThereAre) {
  const std::size_t category = whole_.find("object_1") + 8;
  const auto with = [&](std::int32_t value) {
    std::string bytes = whole_;
    std::memcpy(bytes.data() + category, &value, sizeof value);
    return error_of(sealed(bytes));
  };
  EXPECT_EQ(with(1), "");
  EXPECT_THAT(with(2), HasSubstr("'object_1' is of category 2, of 2"));
  EXPECT_THAT(with(-1), HasSubstr("'object_1' is of category -1, of 2"));
}

TEST_F(RecognitionFile, OfItsFirstLineAloneIsAModelThatWasCutShort) {
  EXPECT_THAT(error_of(whole_.substr(0, kVersionAt)), HasSubstr("ends within the header"));
}

/// Nine bytes each, more than all that comes behind them.
TEST_F(RecognitionFile, HoldsManySmallBlobs) {
  RecognitionModel model;
  FeatureModel& feature = model.features.emplace_back();
  feature.name = "many";
  feature.statistics = empty_statistics(1, 0);
  for (char name = '!'; name <= '~'; ++name) feature.blobs[std::string(1, name)] = "";
  write_recognition_model(model, path_);
  const RecognitionModel read = read_recognition_model(path_);
  ASSERT_EQ(read.features.size(), 1U);
  EXPECT_EQ(read.features[0].blobs, feature.blobs);
}

}  // namespace
}  // namespace vantage
