#include "vantage/study/sweep/attempt.hpp"

#include <fmt/format.h>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

/// What is left over may stay: its attempt is over.
void remove_if_possible(const fs::path& folder) {
  std::error_code ignored;
  fs::remove_all(folder, ignored);
}

}  // namespace

fs::path claims_folder(const fs::path& study_dir, const PlannedEpisode& episode) {
  return study_dir / "attempts" / episode.name;
}

Attempt::Attempt(fs::path study_dir, const PlannedEpisode& episode, HeldClaim claim)
    : study_dir_(std::move(study_dir)),
      episode_(&episode),
      claim_(std::move(claim)),
      folder_(claims_folder(study_dir_, episode) / std::to_string(claim_.number())) {}

std::optional<Attempt> Attempt::begin(const fs::path& study_dir, const PlannedEpisode& episode,
                                      int number, const Worker& worker) {
  const fs::path claims = claims_folder(study_dir, episode);
  auto claim = take_claim(claims, number, worker);
  if (!claim) return std::nullopt;
  for (int former = 1; former < number; ++former) {
    remove_if_possible(claims / std::to_string(former));
  }
  Attempt attempt(study_dir, episode, std::move(*claim));
  make_writable_directory(attempt.folder_);
  return attempt;
}

EpisodeState Attempt::publish(ResultCheck& check) const {
  const fs::path published = episode_folder(study_dir_, *episode_);
  const bool wanted = claim_.in_force() && !is_result(check(study_dir_, *episode_));
  if (wanted) replace(published);
  drop();
  return check(study_dir_, *episode_);
}

void Attempt::replace(const fs::path& published) const {
  const fs::path former = folder_.string() + ".former";
  std::error_code error;
  fs::create_directories(published.parent_path(), error);
  fs::rename(published, former, error);
  fs::rename(folder_, published, error);
  // Not empty: a worker that took the claim over meanwhile has published the same result.
  const bool there = error == std::errc::directory_not_empty || error == std::errc::file_exists;
  remove_if_possible(former);
  if (error && !there) {
    throw OutputError(fmt::format("{}: cannot write: {}", published.string(), error.message()));
  }
}

void Attempt::drop() const {
  remove_if_possible(folder_);
  if (claim_.in_force()) claim_.release();
}

}  // namespace vantage
