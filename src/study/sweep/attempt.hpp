/// One try at an episode: claimed by one worker, run in a folder of its own, published whole.
///
///   DIR/attempts/<episode>/N.json   the claims on it, one after the other
///   DIR/attempts/<episode>/N/       where attempt N runs; becomes DIR/episodes/<episode>
#pragma once

#include <filesystem>
#include <optional>

#include "vantage/study/cluster/claims.hpp"
#include "vantage/study/results.hpp"

namespace vantage {

/// Where the claims on an episode are.
std::filesystem::path claims_folder(const std::filesystem::path& study_dir,
                                    const PlannedEpisode& episode);

class Attempt {
 public:
  /// Claims the episode. @param number one more than that of the claim in force
  /// @returns nothing if another worker was faster. @throws OutputError
  static std::optional<Attempt> begin(const std::filesystem::path& study_dir,
                                      const PlannedEpisode& episode, int number,
                                      const Worker& worker);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] const HeldClaim& claim() const { return claim_; }

  /// Puts the folder in place of what the episode's folder held, in one step, unless that is a
  /// result or another worker has taken the claim over. Either way the claim is released.
  /// @returns what the episode's folder says now. @throws OutputError
  EpisodeState publish(ResultCheck& check) const;
  /// Removes the folder and releases the claim.
  void drop() const;

 private:
  Attempt(std::filesystem::path study_dir, const PlannedEpisode& episode, HeldClaim claim);
  void replace(const std::filesystem::path& published) const;

  std::filesystem::path study_dir_;
  const PlannedEpisode* episode_;
  HeldClaim claim_;
  std::filesystem::path folder_;
};

}  // namespace vantage
