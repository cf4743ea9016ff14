#include "vantage/belief/map/octomap/octomap_format.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using ::testing::HasSubstr;

std::string bt(const std::string& header, const std::string& data) {
  return "# Octomap OcTree binary file\n# (a comment)\n#\n" + header + "data\n" + data;
}
std::string ot(const std::string& header, const std::string& data) {
  return "# Octomap OcTree file\n" + header + "data\n" + data;
}
std::string full_record(float log_odds, char children) {
  std::string record(sizeof(float), '\0');
  std::memcpy(record.data(), &log_odds, sizeof(float));
  return record + children;
}

/// A chain of `levels` inner nodes, each the first child of the last, that ends in one leaf.
std::string binary_chain(int levels) {
  std::string data;
  for (int i = 1; i < levels; ++i) data += std::string("\x03\x00", 2);
  return data + std::string("\x02\x00", 2);
}

OctomapHeader check_octomap(const std::string& bytes, const std::string& name) {
  return parse_octomap(bytes, name, [](const OctomapLeaf&) {});
}

std::string error_of(const std::string& bytes) {
  try {
    check_octomap(bytes, "map.bt");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(OctomapFormat, ReadsTheHeader) {
  const std::string bytes = bt("id OcTree\nsize 2\nres 0.05\n", std::string("\x02\x00", 2));
  const OctomapHeader header = check_octomap(bytes, "map.bt");
  EXPECT_TRUE(header.binary);
  EXPECT_EQ(header.nodes, 2U);
  EXPECT_EQ(header.resolution_m, 0.05);
  EXPECT_EQ(bytes.size() - header.data_offset, 2U);
  EXPECT_FALSE(check_octomap(ot("id OcTree\nsize 0\nres 1\n", ""), "map.ot").binary);
}

TEST(OctomapFormat, RefusesATreeOfNoKnownType) {
  EXPECT_EQ(error_of(bt("size 0\nres 1\n", "")),
            "map.bt: header key 'id' is missing, expected OcTree");
  EXPECT_EQ(error_of(bt("id ColorOcTree\nsize 0\nres 1\n", "")),
            "map.bt: holds a tree of type 'ColorOcTree', expected OcTree");
}

TEST(OctomapFormat, ReadsTheHeaderItWrites) {
  for (const bool binary : {false, true}) {
    const OctomapHeader header = check_octomap(octomap_header({binary, 1.0 / 129, 0}), "map");
    EXPECT_EQ(header.binary, binary);
    EXPECT_NEAR(header.resolution_m, 1.0 / 129, 1e-13);
  }
}

TEST(OctomapFormat, RefusesWhatComesBehindTheTree) {
  const std::string binary = bt("id OcTree\nsize 17\nres 1\n", binary_chain(16));
  const std::string full = ot("id OcTree\nsize 1\nres 1\n", full_record(1.0F, 0));
  const std::string none = ot("id OcTree\nsize 0\nres 1\n", "");
  for (const std::string& bytes : {binary, full, none}) {
    EXPECT_EQ(error_of(bytes), "accepted");
    EXPECT_THAT(error_of(bytes + "\n"), HasSubstr("map.bt: damaged: the data go on behind"));
    EXPECT_THAT(error_of(bytes + bytes), HasSubstr("damaged")) << "two files in one";
  }
}

TEST(OctomapFormat, AcceptsTheFullDepthAndNoMore) {
  EXPECT_EQ(error_of(bt("id OcTree\nsize 17\nres 1\n", binary_chain(16))), "accepted");
  EXPECT_THAT(error_of(bt("id OcTree\nsize 18\nres 1\n", binary_chain(17))),
              HasSubstr("more than 16 levels"));
}

TEST(OctomapFormat, EndlessRecursionIsCaught) {
  const std::string children(200'000, '\xff');
  EXPECT_THAT(error_of(bt("id OcTree\nsize 9\nres 1\n", children)), HasSubstr("16 levels"));
  std::string chain;
  for (int i = 0; i < 100'000; ++i) chain += full_record(0.0F, 1);
  EXPECT_THAT(error_of(ot("id OcTree\nsize 9\nres 1\n", chain)), HasSubstr("16 levels"));
}

TEST(OctomapFormat, NamesWhatIsWrong) {
  EXPECT_THAT(error_of(""), HasSubstr("map.bt: is empty"));
  EXPECT_THAT(error_of("PNG"), HasSubstr("not an OctoMap file"));
  EXPECT_THAT(error_of("# Octomap OcTree file\nid OcTree\nsize 1\n"), HasSubstr("cut short"));
  EXPECT_THAT(error_of(ot("id ColorOcTree\nsize 0\nres 1\n", "")), HasSubstr("'ColorOcTree'"));
  EXPECT_THAT(error_of(ot("id OcTree\nsize -1\nres 1\n", "")), HasSubstr("'size' has value '-1'"));
  EXPECT_THAT(error_of(ot("id OcTree\nsize 1\nres big\n", "")), HasSubstr("'res' has value 'big'"));
  for (const std::string res : {"0", "-0.1", "nan", "inf"}) {
    EXPECT_THAT(error_of(ot("id OcTree\nsize 0\nres " + res + "\n", "")), HasSubstr("'res' is "));
  }
  EXPECT_THAT(error_of(ot("id OcTree\nsize 5\nres 1\n", full_record(1.0F, 0))),
              HasSubstr("'size' is 5, the data hold 1"));
  EXPECT_THAT(error_of(ot("id OcTree\nsize 2\nres 1\n", full_record(1.0F, 1))),
              HasSubstr("cut short: the tree goes on after 5 bytes"));
  EXPECT_THAT(error_of(ot("id OcTree\nsize 1\nres 1\n", full_record(std::nanf(""), 0))),
              HasSubstr("not a number"));
  EXPECT_THAT(error_of(bt("id OcTree\nsize 1\nres 1\n", std::string(2, '\0'))),
              HasSubstr("without children"));
}

TEST(OctomapFormat, WhatTheHeaderDoesNotSayIsZero) {
  EXPECT_THAT(error_of(ot("id OcTree\nsize 0\n", "")), HasSubstr("'res' is 0"));
  EXPECT_EQ(error_of(ot("id OcTree\nres 1\n", "")), "accepted") << "no nodes";
  EXPECT_THAT(error_of(ot("id OcTree\nres 1\n", full_record(1.0F, 0))),
              HasSubstr("the data go on behind the tree"));
}

TEST(OctomapFormat, ReadsWholeNumbersAlone) {
  for (const std::string size : {"1x", "1 2", "99999999999999999999999"}) {
    EXPECT_THAT(error_of(ot("id OcTree\nsize " + size + "\nres 1\n", "")),
                HasSubstr("'size' has value '" + size + "'"));
  }
  EXPECT_THAT(error_of(ot("id OcTree\nsize 0\nres 0.5m\n", "")),
              HasSubstr("'res' has value '0.5m'"));
}

TEST(OctomapFormat, CellsAreOfAMicrometreToAThousandKilometres) {
  for (const std::string res : {"1e-6", "1e6"}) {
    EXPECT_EQ(error_of(ot("id OcTree\nsize 0\nres " + res + "\n", "")), "accepted");
  }
  for (const std::string res : {"9e-7", "1.1e6"}) {
    EXPECT_THAT(error_of(ot("id OcTree\nsize 0\nres " + res + "\n", "")), HasSubstr("'res' is "));
  }
}

/// Of the root's eight children, x lowest: occupied on the x side, free on those of y and of z.
TEST(OctomapFormat, ChildrenLieByTheBitsOfTheirNumber) {
  std::vector<OctomapLeaf> leaves;
  const auto take = [&](const OctomapLeaf& leaf) { leaves.push_back(leaf); };
  const auto expect_leaf = [](const OctomapLeaf& leaf, const Eigen::Array3i& first,
                              float log_odds) {
    EXPECT_TRUE((leaf.first == first).all()) << leaf.first.transpose();
    EXPECT_EQ(leaf.edge_cells, 32768);
    EXPECT_EQ(leaf.log_odds, log_odds);
  };
  parse_octomap(bt("id OcTree\nsize 4\nres 1\n", std::string("\x18\x01", 2)), "map", take);
  ASSERT_EQ(leaves.size(), 3U);
  expect_leaf(leaves[0], {0, -32768, -32768}, 3.5F);
  expect_leaf(leaves[1], {-32768, 0, -32768}, -2.0F);
  expect_leaf(leaves[2], {-32768, -32768, 0}, -2.0F);
  leaves.clear();
  const std::string full = full_record(0.5F, 0x21) + full_record(1.25F, 0) + full_record(-0.75F, 0);
  parse_octomap(ot("id OcTree\nsize 3\nres 1\n", full), "map", take);
  ASSERT_EQ(leaves.size(), 2U);
  expect_leaf(leaves[0], {-32768, -32768, -32768}, 1.25F);
  expect_leaf(leaves[1], {0, -32768, 0}, -0.75F);
}

TEST(OctomapLeaf, IsOccupiedFromEvenOddsOn) {
  EXPECT_TRUE(OctomapLeaf{.log_odds = 0.0F}.occupied());
  EXPECT_FALSE(OctomapLeaf{.log_odds = -1e-6F}.occupied());
}

TEST(OctomapFormat, BlanksAndCarriageReturnsAroundHeaderLinesDoNotMatter) {
  const OctomapHeader header = check_octomap(
      "# Octomap OcTree file\r\n  id OcTree \t\r\n\r\nsize 0 \r\n\tres 0.5\t \r\ndata \r\n",
      "map.ot");
  EXPECT_EQ(header.resolution_m, 0.5);
  EXPECT_EQ(header.nodes, 0U);
}

TEST(CellBlock, IsJoinedWithAndCutByOthers) {
  const auto expect_block = [](const CellBlock& block, const Eigen::Array3i& begin,
                               const Eigen::Array3i& end) {
    EXPECT_TRUE((block.begin == begin).all()) << block.begin.transpose();
    EXPECT_TRUE((block.end == end).all()) << block.end.transpose();
  };
  const CellBlock block{{-2, 1, 3}, {1, 4, 5}};
  const CellBlock other{{0, 3, -4}, {6, 4, 4}};
  EXPECT_EQ(block.count(), 18.0);
  expect_block(block.joined(other), {-2, 1, -4}, {6, 4, 5});
  expect_block(block.cut(other), {0, 3, 3}, {1, 4, 4});
  const CellBlock none{};
  expect_block(block.joined(none), block.begin, block.end);
  expect_block(none.joined(block), block.begin, block.end);
  const CellBlock beside{{1, 1, 3}, {2, 4, 5}};
  EXPECT_TRUE(block.cut(beside).empty());
  const CellBlock apart{{5, 7, 3}, {6, 9, 5}};
  EXPECT_TRUE(block.cut(apart).empty());
  EXPECT_EQ(block.cut(apart).count(), 0.0);
}

TEST(OctomapFormat, ALineIsACommentByItsBeginningAlone) {
  EXPECT_THAT(error_of(ot("id OcTree\nsize 0\nres 1#\n", "")), HasSubstr("'res' has value '1#'"));
  EXPECT_EQ(error_of(ot("id OcTree\nsize 0\n# res 2x\nres 1\n", "")), "accepted");
}

}  // namespace
}  // namespace vantage
