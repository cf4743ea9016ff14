#include "vantage/recognition/dataset/feature_cache.hpp"

#include <fmt/format.h>

#include <array>
#include <exception>
#include <span>
#include <string_view>
#include <utility>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/bytes.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/core/log.hpp"
#include "vantage/perception/features/kit/state_bytes.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kMagic = "vantage features\n";
constexpr auto kExtension = ".features";
constexpr std::size_t kHashBytes = sizeof(std::uint64_t);
constexpr int kRecordsOfFile = 256;

std::string shelf_name(const TrainedFeature& extractor) {
  const std::string version = fmt::format("version {}", kFeatureCacheVersion);
  return fmt::format("{}-{}", extractor.name(),
                     hash_text(hash_bytes(version, extractor.state_hash())));
}

/// The view's hash, why it was skipped, and if it was not, its numbers.
void put_record(std::string& bytes, std::uint64_t view, const FeatureResult& result) {
  put(bytes, view);
  put_text(bytes, result.skipped);
  bytes.append(reinterpret_cast<const char*>(result.vector.data()),
               static_cast<std::size_t>(result.vector.size()) * sizeof(float));
}

/// @throws InputError if the file is not whole.
std::string_view checked_records(std::string_view bytes, const fs::path& path) {
  ByteReader reader(bytes, path.string());
  const bool ours = bytes.starts_with(kMagic) && bytes.size() >= kMagic.size() + kHashBytes;
  reader.require(ours, "no file of features");
  const std::string_view content = reader.block(bytes.size() - kHashBytes, "the views");
  const auto expected = reader.number<std::uint64_t>("the hash");
  reader.require(hash_bytes(content) == expected, "is damaged");
  return content.substr(kMagic.size());
}

}  // namespace

std::uint64_t view_hash(const ViewEntry& view) {
  constexpr std::array kFiles{"crop.png", "depthcrop.png", "maskcrop.png", "loc.txt"};
  std::uint64_t hash = hash_bytes(fmt::format("video {}", view.name.video));
  for (const char* file : kFiles) hash = hash_bytes(read_file(view.file(file)), hash);
  if (view.notes) hash = hash_bytes(to_text(*view.notes), hash);
  if (view.cut) hash = hash_bytes(to_string(*view.cut), hash);
  if (view.given_elevation_rad) {
    hash = hash_bytes(fmt::format("elevation {}", *view.given_elevation_rad), hash);
  }
  return hash;
}

FeatureCache::FeatureCache(fs::path folder, std::span<const TrainedFeature> extractors)
    : folder_(std::move(folder)) {
  if (!active()) return;
  for (const TrainedFeature& extractor : extractors) {
    Shelf& shelf = shelves_.emplace_back();
    shelf.folder = folder_ / shelf_name(extractor);
    shelf.dimension = extractor.dimension();
    read_shelf(shelf);
  }
}

FeatureCache::~FeatureCache() {
  for (Shelf& shelf : shelves_) {
    try {
      write_shelf(shelf);
    } catch (const std::exception& error) {
      log_warning(error.what());
    }
  }
}

std::optional<FeatureResult> FeatureCache::find(std::size_t extractor, std::uint64_t view) const {
  if (!active()) return std::nullopt;
  const auto& known = shelves_[extractor].known;
  const auto found = known.find(view);
  if (found == known.end()) return std::nullopt;
  return found->second;
}

void FeatureCache::keep(std::size_t extractor, std::uint64_t view, const FeatureResult& result) {
  if (!active()) return;
  const std::lock_guard lock(mutex_);
  Shelf& shelf = shelves_[extractor];
  put_record(shelf.unwritten, view, result);
  if (++shelf.records >= kRecordsOfFile) write_shelf(shelf);
}

void FeatureCache::read_shelf(Shelf& shelf) {
  if (!fs::is_directory(shelf.folder)) return;
  for (const auto& entry : fs::directory_iterator(shelf.folder)) {
    if (entry.path().extension() != kExtension) continue;
    try {
      const std::string bytes = read_file(entry.path());
      ByteReader reader(checked_records(bytes, entry.path()), entry.path().string());
      const int records = reader.number<std::int32_t>("the number of views");
      for (int i = 0; i < records; ++i) {
        const auto view = reader.number<std::uint64_t>("a view");
        FeatureResult result{{}, reader.text("a view")};
        if (result.extracted()) {
          result.vector.resize(shelf.dimension);
          reader.numbers(std::span(result.vector.data(), static_cast<std::size_t>(shelf.dimension)),
                         "a view");
        }
        shelf.known.insert_or_assign(view, std::move(result));
      }
      reader.finish();
    } catch (const InputError& error) {
      log_warning(error.what());
    }
  }
}

void FeatureCache::write_shelf(Shelf& shelf) {
  if (shelf.records == 0) return;
  std::string bytes(kMagic);
  put(bytes, static_cast<std::int32_t>(shelf.records));
  bytes += shelf.unwritten;
  const std::uint64_t hash = hash_bytes(bytes);
  put(bytes, hash);
  shelf.unwritten.clear();
  shelf.records = 0;
  make_writable_directory(shelf.folder);
  write_file(shelf.folder / (hash_text(hash) + kExtension), bytes);
}

}  // namespace vantage
