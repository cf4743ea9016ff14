/// What replay needs: every control tick's state, and the commands whenever they change.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vantage/core/atomic_file.hpp"

namespace vantage {

class World;

std::vector<std::string> actuator_names(const World& world);

/// Writes states.bin and actions.csv as the episode goes and keeps the running hash of both.
class StateLog {
 public:
  /// Without a run folder it only hashes.
  StateLog(const std::filesystem::path& run_dir, std::span<const std::string> actuator_names,
           std::span<const double> initial_state);

  /// `controls` were held during the tick that led to `state`.
  void add(std::span<const double> controls, std::span<const double> state);
  void commit();
  [[nodiscard]] std::uint64_t hash() const { return hash_; }
  [[nodiscard]] std::uint64_t ticks() const { return ticks_; }

 private:
  std::optional<GrowingFile> states_;
  std::optional<GrowingFile> actions_;
  std::vector<double> last_controls_;
  std::uint64_t hash_;
  std::uint64_t ticks_ = 0;
};

/// states.bin as read back. Record 0 is the state before the first tick, under no command.
struct RecordedStates {
  std::size_t state_size = 0;
  std::size_t actuators = 0;
  std::vector<double> values;
  std::string file = {};
  [[nodiscard]] std::size_t record_size() const { return state_size + actuators; }
  [[nodiscard]] std::size_t count() const { return values.size() / record_size(); }
  [[nodiscard]] std::span<const double> state(std::size_t i) const {
    return {values.data() + i * record_size(), state_size};
  }
  /// As state(i). @throws InputError if it holds a number that is not finite
  [[nodiscard]] std::span<const double> finite_state(std::size_t i) const;
  /// Held during the tick that led to state(i).
  [[nodiscard]] std::span<const double> controls(std::size_t i) const {
    return {values.data() + i * record_size() + state_size, actuators};
  }
};
/// @throws InputError if the file is missing, cut short or not ours.
RecordedStates read_states(const std::filesystem::path& path);

/// A row of actions.csv: from `tick` on, these controls are held.
struct RecordedAction {
  std::uint64_t tick = 0;
  std::vector<double> controls;
  bool canonical = true;  ///< the text is exactly what a recorder writes for these numbers
};
/// Rows that cannot be read, and a header with other names than `actuator_names`, are kept as rows
/// that are not canonical, so that replay can name their step.
/// @throws InputError if the file is missing, or its header has other columns or line ends.
std::vector<RecordedAction> read_actions(const std::filesystem::path& path,
                                         std::span<const std::string> actuator_names);

}  // namespace vantage
