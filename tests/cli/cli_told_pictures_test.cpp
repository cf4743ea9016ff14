// What imports and checks of a user's own pictures tell in words: units, and holes in percent.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string>

#include "tests/cli/command_line.hpp"
#include "tests/support/room_pictures.hpp"

namespace vantage {
namespace {

using support::DepthFormat;

/// Two objects in seven views each, with holes in their depth.
class ToldPictures : public CommandLine {
 protected:
  void put(const std::string& to, DepthFormat format) {
    support::put_room(folder_ / to, 2, {.seed = 3, .holes = 0.2}, format, false);
  }
  Result take_in(const std::string& from, const std::string& more) {
    return vantage("dataset import " + from + " --focal-px 285 -q --out " + from + "_taken " +
                   more);
  }
};

TEST_F(ToldPictures, UnitsOfDepthAreKnownByName) {
  put("small/lab", DepthFormat::png_mm);
  EXPECT_THAT(take_in("small", "--depth-unit mm").output,
              HasSubstr("depth: 1 is a millimetre of 14 pictures\n"));
  put("large/lab", DepthFormat::npy_m);
  EXPECT_THAT(take_in("large", "--depth-unit m").output,
              HasSubstr("depth: 1 is a metre of 14 pictures\n"));
}

TEST_F(ToldPictures, HolesAreInPercent) {
  put("mine/lab", DepthFormat::png_mm);
  ASSERT_EQ(take_in("mine", "").exit_code, 0);
  const auto check = nlohmann::json::parse(
      vantage("dataset check mine_taken --json -q 2>/dev/null").output, nullptr, false);
  ASSERT_TRUE(check.is_object());
  const auto percent = [&](const char* which) {
    return 100.0 * check["holes"][which].get<double>();
  };
  ASSERT_GT(percent("median"), 1.0);
  const std::string words = vantage("dataset check mine_taken -q 2>/dev/null").output;
  EXPECT_THAT(
      words, HasSubstr(fmt::format("\nwithout depth on the object: {:.0f} % ({:.0f} to {:.0f} %); ",
                                   percent("median"), percent("least"), percent("most"))));
  const auto& object = check["objects"].at(0);
  EXPECT_THAT(words,
              HasSubstr(fmt::format(" {:>6.0f} % {:>8.3f}\n", 100.0 * object["holes"].get<double>(),
                                    object["size_m"].get<double>())));
}

}  // namespace
}  // namespace vantage
