#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <csignal>
#include <filesystem>

#include "python/bindings.hpp"
#include "python/episodes/situations.hpp"
#include "python/kit/arrays.hpp"
#include "python/kit/calls.hpp"
#include "python/kit/options.hpp"
#include "vantage/core/data_root.hpp"
#include "vantage/core/log.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/tasks/stepped_episode.hpp"

namespace vantage::python {
namespace {

namespace fs = std::filesystem;

/// Keys with their values; of nested dicts each key alone, but for strategies, which have a name.
void add_values(const py::dict& given, const std::string& before, std::vector<KeyValue>& values) {
  for (const auto& [name, value] : given) {
    const std::string key = before + py::str(name).cast<std::string>();
    if (py::isinstance<py::dict>(value) && !value.contains("name")) {
      add_values(py::reinterpret_borrow<py::dict>(value), key + ".", values);
    } else {
      values.emplace_back(key, node_of(value, key));
    }
  }
}

std::shared_ptr<ResolvedEpisode> load(const std::string& name, const py::dict& overrides) {
  const fs::path path = find_input(name, {}, "episode");
  std::error_code error;
  if (fs::is_directory(path, error))
    throw InputError(path.string() + ": a folder, no episode file");
  ConfigNode root = read_yaml(path);
  std::vector<KeyValue> values;
  add_values(overrides, "", values);
  set_values(root, std::move(values));
  return std::make_shared<ResolvedEpisode>(resolve_episode(root, path));
}

bool knows_truth(const ResolvedEpisode& episode) {
  return std::visit(
      [](const auto& task) {
        if constexpr (std::derived_from<std::decay_t<decltype(task)>, MappingOptions>) {
          return vantage::knows_truth(task.choice);
        } else {
          return false;
        }
      },
      episode.task);
}

/// An index below 0.
struct NoSuchView : BadDecision {
  using BadDecision::BadDecision;
};

/// Of all arrays numpy says that they can be an index.
bool is_index(const py::object& answer) {
  if (PyIndex_Check(answer.ptr()) == 0) return false;
  return !py::isinstance<py::array>(answer) ||
         py::reinterpret_borrow<py::array>(answer).ndim() == 0;
}

OutsideDecision decision_of(const py::object& answer) {
  if (is_index(answer)) {
    const Py_ssize_t index = PyNumber_AsSsize_t(answer.ptr(), nullptr);  // cut, if too large
    if (PyErr_Occurred() != nullptr) throw py::error_already_set();
    if (index < 0) throw NoSuchView(fmt::format("view {} was chosen", index));
    return static_cast<std::size_t>(index);
  }
  const auto pose = Doubles::ensure(answer);
  if (!pose || pose.ndim() != 1 || pose.shape(0) != 3) {
    PyErr_Clear();
    throw BadDecision("the answer is neither an index nor a pose (x, y, yaw)");
  }
  return Pose2{pose.at(0), pose.at(1), pose.at(2)};
}

/// What Python raised inside an episode, raised again when the episode has been written.
struct Raised {
  std::exception_ptr error;
  /// "ValueError: why", without the way there.
  [[nodiscard]] std::string text() const {
    std::string text = "what is no exception";
    try {
      std::rethrow_exception(error);
    } catch (const std::exception& raised) {  // with the lock held
      text = raised.what();
    }
    return text.substr(0, text.find('\n'));
  }
};

/// The planner, asked with the lock held. What it is asked ends with the call.
OutsideDecision ask(const py::function& planner, const std::string& name,
                    const DecisionRequest& request, Raised& raised) {
  const py::gil_scoped_acquire locked;
  const auto lent = std::make_shared<LentRequest>(LentRequest{&request});
  const struct TakeBack {
    LentRequest& lent;
    ~TakeBack() { lent.value = nullptr; }
  } at_end{*lent};
  try {
    return decision_of(planner(lent));
  } catch (const NoSuchView& error) {  // as an index above all: a result, not raised again
    throw EpisodeFailed(
        fmt::format("{}: {}, there are {}", name, error.what(), request.candidates.size()));
  } catch (const py::error_already_set& error) {
    raised.error = std::current_exception();
    if (error.matches(PyExc_KeyboardInterrupt)) throw Interrupted(SIGINT);
  } catch (...) {
    raised.error = std::current_exception();
  }
  throw EpisodeFailed("the planner raised: " + raised.text());
}

py::tuple run_episode(const ResolvedEpisode& episode, const std::optional<fs::path>& directory,
                      bool overwrite, bool video, bool lean, const py::object& planner,
                      const std::string& name) {
  RunOptions options;
  options.directory = directory.value_or(fs::path());
  options.overwrite = overwrite;
  options.video = video;
  options.lean = lean;
  options.command = {"python", "vantage.run"};
  Raised raised;
  auto end_if_signalled = [&, poll = SignalPoll()]() mutable {
    try {
      poll();
    } catch (...) {
      raised.error = std::current_exception();
      throw Interrupted(SIGINT);
    }
  };
  options.spectator.on_tick = [&](const World&) { end_if_signalled(); };
  const StopPoll while_it_thinks{end_if_signalled};
  py::function function;
  if (!planner.is_none()) {
    function = py::cast<py::function>(planner);
    options.outside = {
        .name = name,
        .decide = [&](const DecisionRequest& r) { return ask(function, name, r, raised); },
        .ended = {}};
  }
  const RunOutcome outcome = without_lock([&] { return run(episode, options); });
  if (raised.error) std::rethrow_exception(raised.error);
  return py::make_tuple(outcome.metrics, outcome.directory, static_cast<int>(outcome.code));
}

/// A stepped episode, with what it has lent to Python.
class Stepped {
 public:
  Stepped(const ResolvedEpisode& episode, std::string name,
          const std::optional<fs::path>& directory, bool lean)
      : episode_(episode, std::move(name), options_of(directory, lean)) {}
  Stepped(const Stepped&) = delete;
  Stepped& operator=(const Stepped&) = delete;
  ~Stepped() { take_back(); }

  /// "asks", "ended" or "over"; "runs" if that took longer.
  std::string wait(std::optional<double> at_most_s) {
    using State = SteppedEpisode::State;
    constexpr std::chrono::milliseconds kBetweenSignals(50);
    const double until_s = wall_s() + at_most_s.value_or(1e12);
    State state = State::runs;
    do {
      state = without_lock([&] { return episode_.wait(kBetweenSignals); });
      throw_if_signalled();
    } while (state == State::runs && wall_s() < until_s);
    if (state == State::asks) return "asks";
    if (state == State::ended) return "ended";
    return state == State::over ? "over" : "runs";
  }
  std::shared_ptr<LentRequest> request() {
    require(SteppedEpisode::State::asks, "a request");
    if (!request_) request_ = std::make_shared<LentRequest>(LentRequest{&episode_.request()});
    return request_;
  }
  void answer(const py::object& answer) {
    require(SteppedEpisode::State::asks, "a request to answer");
    episode_.answer(decision_of(answer));
    take_back();
  }
  std::shared_ptr<LentSituation> situation() {
    require(SteppedEpisode::State::ended, "a last situation");
    if (!situation_)
      situation_ = std::make_shared<LentSituation>(LentSituation{&episode_.last_situation()});
    return situation_;
  }
  bool at_limit() {
    require(SteppedEpisode::State::ended, "a last situation");
    return episode_.at_limit();
  }
  void let_go() {
    require(SteppedEpisode::State::ended, "a last situation");
    take_back();
    episode_.let_go();
  }
  void interrupt() {
    take_back();
    episode_.interrupt();
  }
  py::tuple outcome() {
    require(SteppedEpisode::State::over, "an outcome");
    const RunOutcome& outcome = episode_.outcome();
    return py::make_tuple(outcome.metrics, outcome.directory, static_cast<int>(outcome.code));
  }

 private:
  static RunOptions options_of(const std::optional<fs::path>& directory, bool lean) {
    RunOptions options;
    options.directory = directory.value_or(fs::path());
    options.lean = lean;
    options.overwrite = true;
    options.command = {"python", "vantage.Env"};
    return options;
  }
  void require(SteppedEpisode::State state, const char* what) {
    if (episode_.wait(std::chrono::milliseconds(0)) != state) {
      throw Error(ExitCode::usage, fmt::format("the episode has not {} now", what));
    }
  }
  void take_back() {
    if (request_) request_->value = nullptr;
    if (situation_) situation_->value = nullptr;
    request_.reset();
    situation_.reset();
  }

  std::shared_ptr<LentRequest> request_;
  std::shared_ptr<LentSituation> situation_;
  SteppedEpisode episode_;
};

/// Its thread may want the lock while it ends.
struct DeleteWithoutLock {
  void operator()(Stepped* episode) const {
    const py::gil_scoped_release released;
    delete episode;
  }
};

}  // namespace

void bind_episodes(py::module_& module) {
  py::class_<ResolvedEpisode, std::shared_ptr<ResolvedEpisode>>(
      module, "Episode",
      "An episode file with every option that it has. Raises ConfigError, InputError.")
      .def(py::init(&load), py::arg("name"), py::arg("overrides") = py::dict())
      .def_property_readonly(
          "options", [](const ResolvedEpisode& e) { return object_of(episode_node(e)); },
          "Every key with its value, defaults included, as nested dicts.")
      .def_property_readonly("knows_truth", &knows_truth,
                             "Whether its own choice asks ground truth: then no planner may take "
                             "its place.")
      .def_property_readonly(
          "name", [](const ResolvedEpisode& e) { return e.setup.name; }, "Of the file.");
  module.def("run_episode", &run_episode, py::arg("episode"), py::arg("directory"),
             py::arg("overwrite"), py::arg("video"), py::arg("lean"), py::arg("planner"),
             py::arg("name"), "(metrics as JSON, run folder, exit code); see vantage.run().");
  py::class_<Stepped, std::unique_ptr<Stepped, DeleteWithoutLock>>(
      module, "SteppedEpisode", "An episode that stops at each of its decisions; see vantage.Env.")
      .def(py::init<const ResolvedEpisode&, std::string, const std::optional<fs::path>&, bool>(),
           py::arg("episode"), py::arg("name"), py::arg("directory"), py::arg("lean") = true)
      .def("wait", &Stepped::wait, py::arg("at_most_s") = py::none(),
           "Until it stops: 'asks', 'ended' or 'over'; 'runs' if that takes longer.")
      .def_property_readonly("request", &Stepped::request, "While it asks.")
      .def("answer", &Stepped::answer, py::arg("answer"),
           "An index or a pose (3,). Raises BadDecision.")
      .def_property_readonly("situation", &Stepped::situation, "When it has ended, until let_go().")
      .def_property_readonly("at_limit", &Stepped::at_limit,
                             "When it has ended: whether scans or budget were used up.")
      .def("let_go", &Stepped::let_go, "Goes on from 'ended': writes what it came to.")
      .def("interrupt", &Stepped::interrupt, "Ends it at its next tick.")
      .def_property_readonly(
          "outcome", &Stepped::outcome,
          "(metrics as JSON, run folder, exit code) when it is over; raises what ended it.");
}

}  // namespace vantage::python
