// A picture of a user's camera, taken for each kind.
#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/core/error.hpp"
#include "vantage/perception/images/image_files.hpp"

namespace vantage::fuzz {

namespace {

template <class Read>
void try_to(Read&& read) {
  try {
    read();
  } catch (const Error&) {
  }
}

}  // namespace

void read_input(std::string_view bytes, const InputFolder& folder) {
  const auto file = folder.put("picture.png", bytes);
  try_to([&] { read_colour_image(file); });
  try_to([&] { read_depth_image(file); });
  try_to([&] { read_mask_image(file); });
  image_kind(file);
}

}  // namespace vantage::fuzz
