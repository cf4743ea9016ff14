/// What is wrong with a dataset, and what may be, before it is trained on.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "vantage/perception/dataset_index.hpp"

namespace vantage {

/// Of a number over views.
struct Spread {
  double least = 0.0;
  double median = 0.0;
  double most = 0.0;
};

struct CheckedObject {
  std::string object;
  int views = 0;
  int recordings = 0;
  int bins = 0;         ///< directions with a view
  int thin_bins = 0;    ///< of these, with a single one
  double holes = 0.0;   ///< median share of the mask without depth
  double size_m = 0.0;  ///< median of the greatest extent that a view shows
};

struct CheckedDataset {
  std::filesystem::path root;
  ObjectCut cut = ObjectCut::mask;
  int bins = 8;
  double focal_px = 570.3;
  std::vector<CheckedObject> objects;
  int views = 0;
  Spread holes;                                             ///< share of the mask without depth
  Spread mask;                                              ///< share of the picture that is object
  Spread distance_m;                                        ///< median depth of the object
  std::map<std::uint64_t, std::filesystem::path> pictures;  ///< by what they hold
  std::vector<std::string> problems;                        ///< must be mended
  std::vector<std::string> advice;                          ///< should be known
};

/// Opens every view. @param bins of the model to be trained; 0: those of the dataset's notes
/// @param poll ends the work by throwing
/// @throws InputError if the folder holds no views at all.
CheckedDataset check_dataset(const std::filesystem::path& root, int bins,
                             const std::function<void()>& poll);

}  // namespace vantage
