/// Features of views, kept in files from one command to the next.
///
/// What an extractor gives for a view is settled by the bytes of both, so those are the key: an
/// extractor's folder is named by its hash, a record by that of the view's files. Nothing is ever
/// out of date, but for changes of the program, which raise kFeatureCacheVersion.
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "vantage/perception/dataset_index.hpp"
#include "vantage/perception/features/feature.hpp"

namespace vantage {

/// To be raised by whoever changes what a feature extracts without changing its trained state.
inline constexpr int kFeatureCacheVersion = 1;

/// Of the files that the features of a view are extracted from, and of its video.
/// @throws InputError if one of them cannot be read.
std::uint64_t view_hash(const ViewEntry& view);

class FeatureCache {
 public:
  /// Reads what there is of these extractors. Files that are damaged are left out, with a warning.
  /// @param folder empty: nothing is kept and nothing found
  FeatureCache(std::filesystem::path folder, std::span<const TrainedFeature> extractors);
  FeatureCache(const FeatureCache&) = delete;
  FeatureCache& operator=(const FeatureCache&) = delete;
  /// Writes what is left, so that work that was broken off is not lost.
  ~FeatureCache();

  [[nodiscard]] bool active() const { return !folder_.empty(); }
  /// @param extractor index into those given
  [[nodiscard]] std::optional<FeatureResult> find(std::size_t extractor, std::uint64_t view) const;
  /// By any thread; files are written as enough has come together.
  /// @throws OutputError if the folder cannot be written.
  void keep(std::size_t extractor, std::uint64_t view, const FeatureResult& result);

 private:
  struct Shelf {
    std::filesystem::path folder;
    int dimension = 0;
    std::unordered_map<std::uint64_t, FeatureResult> known;
    std::string unwritten;  ///< records
    int records = 0;        ///< of `unwritten`
  };
  static void read_shelf(Shelf& shelf);
  static void write_shelf(Shelf& shelf);

  std::filesystem::path folder_;
  std::vector<Shelf> shelves_;  ///< of each extractor
  std::mutex mutex_;            ///< of what is unwritten
};

}  // namespace vantage
