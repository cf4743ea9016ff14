/// Claims of workers on pieces of work in a folder that several machines share.
///
/// A claim is a file FOLDER/N.json that says who holds it. The highest N is in force. Whoever wants
/// the work when that claim is released, or its holder gone, makes the file N + 1: a hard link to a
/// file that is whole already, which exactly one can make, on NFS too. Claims are never removed, so
/// N only rises, and nobody takes what another took over meanwhile.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "vantage/study/cluster/slurm.hpp"
#include "vantage/study/cluster/worker.hpp"

namespace vantage {

struct Claim {
  int number = 0;
  Worker worker;
  bool released = false;
  double age_s = 0.0;  ///< since the last heartbeat, by the clock of the file system
};

/// The claim in force; nothing if there never was one. One that cannot be read has an empty worker.
std::optional<Claim> claim_in_force(const std::filesystem::path& folder);

/// A holder gives a sign this often; without one for so long it is gone, if nothing better is
/// known.
constexpr double kHeartbeat_s = 15.0;
constexpr double kSilence_s = 300.0;

/// Whether the holder is at work still. The better witness decides: its release, its process on
/// this machine, its earlier run as this very task, Slurm, its heartbeat.
/// @param queue asked for the job of the claim, or for others
bool holder_lives(const Claim& claim, const Worker& self, const SlurmQueue& queue);

class HeldClaim {
 public:
  [[nodiscard]] int number() const { return number_; }
  /// Whether nobody has taken it over.
  [[nodiscard]] bool in_force() const;
  void heartbeat() const;
  /// The work may be taken by anybody from now on.
  void release() const;

 private:
  friend std::optional<HeldClaim> take_claim(const std::filesystem::path&, int, const Worker&);
  HeldClaim(std::filesystem::path folder, int number, Worker worker)
      : folder_(std::move(folder)), number_(number), worker_(std::move(worker)) {}

  std::filesystem::path folder_;
  int number_;
  Worker worker_;
};

/// Takes claim `number`, one more than that in force, 1 if there is none; nothing if another was
/// faster. @throws OutputError if the folder cannot be written
std::optional<HeldClaim> take_claim(const std::filesystem::path& folder, int number,
                                    const Worker& worker);

}  // namespace vantage
