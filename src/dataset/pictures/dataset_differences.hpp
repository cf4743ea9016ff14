/// What differs between a dataset that is trained on and one that is tested on.
#pragma once

#include <string>
#include <vector>

#include "vantage/dataset/pictures/check_dataset.hpp"

namespace vantage {

struct DatasetDifference {
  std::string text;
  bool problem = false;  ///< must be mended; else it should be known
};

/// Empty: none.
std::vector<DatasetDifference> differences(const CheckedDataset& training,
                                           const CheckedDataset& test);

}  // namespace vantage
