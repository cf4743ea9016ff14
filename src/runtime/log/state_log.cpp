#include "vantage/runtime/log/state_log.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "vantage/core/bytes.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/sim/world/world.hpp"

namespace vantage {
namespace {

constexpr std::string_view kMagic = "VANTAGE STATES 1\n";

std::string_view bytes_of(std::span<const double> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

std::string action_header(std::span<const std::string> actuator_names) {
  return fmt::format("tick,{}", fmt::join(actuator_names, ","));
}

std::string action_row(std::uint64_t tick, std::span<const double> controls) {
  return fmt::format("{},{}\n", tick, fmt::join(controls, ","));
}

template <class T>
bool parse_field(std::string_view& line, T& value) {
  const auto comma = std::min(line.find(','), line.size());
  const auto* end = line.data() + comma;
  const auto [stopped, error] = std::from_chars(line.data(), end, value);
  const bool good = error == std::errc{} && stopped == end;
  line.remove_prefix(std::min(comma + 1, line.size()));
  return good;
}

RecordedAction parse_action(std::string_view line, std::size_t actuators,
                            std::uint64_t after_tick) {
  RecordedAction action;
  std::string_view rest = line;
  action.canonical = parse_field(rest, action.tick);
  action.controls.resize(actuators);
  for (double& control : action.controls) {
    action.canonical = parse_field(rest, control) && action.canonical;
  }
  action.canonical =
      action.canonical && action_row(action.tick, action.controls) == std::string(line) + "\n";
  if (!action.canonical) action.tick = after_tick;
  return action;
}

}  // namespace

std::vector<std::string> actuator_names(const World& world) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < world.controls().size(); ++i) {
    names.push_back(model_name(world.model(), ModelObject::actuator, static_cast<int>(i)));
  }
  return names;
}

StateLog::StateLog(const std::filesystem::path& run_dir,
                   std::span<const std::string> actuator_names,
                   std::span<const double> initial_state)
    : hash_(hash_doubles(initial_state)) {
  if (run_dir.empty()) return;
  states_.emplace(run_dir / "states.bin");
  actions_.emplace(run_dir / "actions.csv");
  const std::array<std::uint64_t, 2> sizes{initial_state.size(), actuator_names.size()};
  states_->write(kMagic);
  states_->write({reinterpret_cast<const char*>(sizes.data()), sizeof sizes});
  states_->write(bytes_of(initial_state));
  states_->write(bytes_of(std::vector<double>(actuator_names.size(), 0.0)));
  actions_->write(action_header(actuator_names) + "\n");
}

void StateLog::add(std::span<const double> controls, std::span<const double> state) {
  // By its bytes: the hash tells -0 from 0.
  if (actions_ && bytes_of(controls) != bytes_of(last_controls_)) {
    actions_->write(action_row(ticks_, controls));
    last_controls_.assign(controls.begin(), controls.end());
  }
  ++ticks_;
  if (states_) {
    states_->write(bytes_of(state));
    states_->write(bytes_of(controls));
  }
  hash_ = hash_doubles(state, hash_doubles(controls, hash_));
}

void StateLog::commit() {
  if (states_) states_->commit();
  if (actions_) actions_->commit();
}

RecordedStates read_states(const std::filesystem::path& path) {
  const std::string content = read_file(path);
  ByteReader reader(content, path.string());
  reader.require(content.starts_with(kMagic), "not a state log of this program");
  reader.block(kMagic.size(), "the header");
  std::array<std::uint64_t, 2> sizes{};
  reader.numbers(std::span<std::uint64_t>(sizes), "the header");
  const std::size_t numbers = reader.left() / sizeof(double);
  const bool plausible = sizes[0] > 0 && sizes[0] <= numbers && sizes[1] <= numbers;
  const bool whole = plausible && reader.left() % ((sizes[0] + sizes[1]) * sizeof(double)) == 0;
  reader.require(whole, fmt::format("cut short: {} bytes are not whole records of {} numbers",
                                    reader.left(), sizes[0] + sizes[1]));
  RecordedStates states{sizes[0], sizes[1], std::vector<double>(numbers), path.string()};
  reader.numbers(std::span(states.values), "the states");
  return states;
}

std::span<const double> RecordedStates::finite_state(std::size_t i) const {
  const auto is_finite = [](double number) { return std::isfinite(number); };
  if (std::ranges::all_of(state(i), is_finite)) return state(i);
  throw InputError(fmt::format("{}: state {} holds a number that is not finite", file, i));
}

std::vector<RecordedAction> read_actions(const std::filesystem::path& path,
                                         std::span<const std::string> actuator_names) {
  const std::string content = read_file(path);
  std::vector<RecordedAction> actions;
  std::string_view rest = content;
  const auto next_line = [&rest] {
    const auto end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    return line;
  };
  const std::string_view header = next_line();
  const bool as_written = header == action_header(actuator_names);
  const auto columns = static_cast<std::size_t>(std::ranges::count(header, ',')) + 1;
  if (!as_written && (columns != actuator_names.size() + 1 || header.ends_with('\r'))) {
    throw InputError(fmt::format("{}:1: expected the header '{}' and lines that end in \\n",
                                 path.string(), action_header(actuator_names)));
  }
  if (!as_written) actions.push_back({0, {}, false});
  while (!rest.empty()) {
    const std::uint64_t after_tick = actions.empty() ? 0 : actions.back().tick + 1;
    actions.push_back(parse_action(next_line(), actuator_names.size(), after_tick));
  }
  return actions;
}

}  // namespace vantage
