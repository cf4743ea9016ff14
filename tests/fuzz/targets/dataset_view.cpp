// A view of a dataset: colour, depth and mask as PNG, pose and place as text.
#include "tests/fuzz/fuzz_target.hpp"
#include "vantage/perception/dataset_reader.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder& folder) {
  const auto parts = parts_of(bytes, 5);
  const std::string stem = "cup/cup_1/cup_1_1_1_";
  folder.put(stem + "pose.txt", parts[0]);
  folder.put(stem + "loc.txt", parts[1]);
  folder.put(stem + "maskcrop.png", parts[2]);
  folder.put(stem + "depthcrop.png", parts[3]);
  const auto colour = folder.put(stem + "crop.png", parts[4]);
  const DatasetIndex dataset = index_dataset(folder.path(), OnBadView::skip);
  for (const ViewEntry& entry : dataset.views) load_view(entry);
  load_image_pair(colour, folder.path() / (stem + "depthcrop.png"), {});
}

}  // namespace vantage::fuzz
