"""Mapping episodes as environments with the semantics of Gymnasium 1.x."""

from __future__ import annotations

import json
import tempfile
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _checks, _core, episodes, spaces

try:
    from gymnasium import Env as _Base  # type: ignore[import]
except ImportError:
    _Base = object

Observation = dict[str, NDArray[Any]]

#: Columns of the table of candidates.
COLUMNS = ("gain", "interval_low", "interval_high", "travel_s", "path_length_m", "x_m", "y_m", "z_m", "yaw_rad",
           "pitch_rad", "open")


class Env(_Base):  # type: ignore[misc]
    """A robot that maps; an action is the view that it scans from next.

    Observation, a dict of float32 arrays:

    - `map` (3, bx, by, bz): shares of free, unobserved and occupied cells in coarse blocks of the map;
    - `candidates` (n, 11): a row a view, columns as in COLUMNS: gain (one in bits or cells as a share of the map's
      cells, others as they are), the interval that the robot holds the truth of it to be in (low and high end as the
      gain; both -1 where the gain has none), travel time (s) and way (m; both -1 where out of reach), sensor pose
      (m, rad, world), open (1: may be taken; where none may, all are: the robot goes as near as it can); rows beyond
      the candidates that there are hold 0;
    - `state` (7,): x, y (m), yaw (rad) as believed, scans taken, scans left, time (s), time left (s; -1: no limit).

    Action: Discrete(n), the row of a view. An action whose row is not open changes nothing: reward 0,
    info["invalid_action"] is True; after `max_invalid` of them in a row the episode is truncated.
    info["action_mask"] (n,) int8 is 1 for open rows, for action_space.sample(mask).

    Reward: share of the map's cells that the scan newly shows the robot, less `time_cost_per_s` times the
    simulated time it took. Terminated: there is no more to be seen, or the robot failed. Truncated: scans or
    budget are used up, or `max_invalid` rows in a row were not open.

    All of an observation is what the robot believes. When an episode has ended info["metrics"] has what it came
    to, measured by ground truth; one that `max_invalid` truncates has come to nothing, and has none.

    Parameters
    ----------
    name, overrides
        As in vantage.run(). The choice of the episode is not asked; one that knows ground truth is refused.
    blocks : (bx, by, bz)
        Of `map`; at most the cells of the map.
    max_candidates : int
        Rows of `candidates`; default: the views of the ring on a table top, else the key max_candidates. Where
        there are more views than rows, those that are not open are left out first.
    time_cost_per_s : float
    max_invalid : int
    render_mode : None or "rgb_array"
        The map from above as an image (h, w, 3) uint8.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 1}
    spec = None

    def __init__(self, name: str | PathLike[str] = "tabletop", *, blocks: tuple[int, int, int] = (16, 16, 8),
                 max_candidates: int | None = None, time_cost_per_s: float = 0.0, max_invalid: int = 20,
                 render_mode: str | None = None, **overrides: Any) -> None:
        modes = self.metadata["render_modes"]
        if render_mode is not None and not (isinstance(render_mode, str) and render_mode in modes):
            _checks.refuse("render_mode", render_mode, f"is none of {modes}")
        self._name, self._overrides = _checks.path("name", name), overrides
        _, options = _mapping(self._name, overrides)
        self.blocks = _checks.blocks("blocks", blocks, options["map"]["cells"])
        self.render_mode = render_mode
        self.time_cost_per_s = _checks.finite("time_cost_per_s", time_cost_per_s)
        self.max_invalid = _checks.whole("max_invalid", max_invalid, 1)
        n = _most_candidates(options) if max_candidates is None else _checks.whole("max_candidates", max_candidates, 1)
        self.max_candidates = n
        self.action_space = spaces.Discrete(n)
        self.observation_space = spaces.Dict({
            "map": spaces.Box(0.0, 1.0, (3, *self.blocks), np.float32),
            "candidates": spaces.Box(-np.inf, np.inf, (n, len(COLUMNS)), np.float32),
            "state": spaces.Box(-np.inf, np.inf, (7,), np.float32),
        })
        self._cells = int(np.prod(options["map"]["cells"]))
        self._next_seed = int(options["seed"])
        self._np_random: np.random.Generator | None = None
        self._np_random_seed: int | None = None
        self._folder: tempfile.TemporaryDirectory[str] | None = None
        self._stepped: _core.SteppedEpisode | None = None
        self._last: Observation | None = None
        self._shown: NDArray[np.intp] = np.zeros(0, np.intp)  # of the request's views, those with a row
        self._unobserved = 1.0
        self._time_s = 0.0
        self._invalid = 0
        self._done = True

    @property
    def unwrapped(self) -> Env:
        return self

    @property
    def np_random(self) -> np.random.Generator:
        """Of the environment's own; the episode draws from its seed alone. One that is set has the seed -1."""
        if self._np_random is None:
            self._seed_own()
        assert self._np_random is not None
        return self._np_random

    @np_random.setter
    def np_random(self, value: np.random.Generator) -> None:
        self._np_random, self._np_random_seed = value, -1

    @property
    def np_random_seed(self) -> int:
        """That np_random began from."""
        if self._np_random_seed is None:
            self._seed_own()
        assert self._np_random_seed is not None
        return self._np_random_seed

    def _seed_own(self) -> None:
        self._np_random, self._np_random_seed = np.random.default_rng(self._next_seed), self._next_seed

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None
              ) -> tuple[Observation, dict[str, Any]]:
        """Begins an episode of that seed; without one, of the seed after the last. `options` are keys of it.

        The same seed gives the same observations, step by step.
        """
        keys = _checks.keys("options", options)
        if "seed" in keys:
            _checks.refuse("options", keys, "has a seed: it is an argument of its own")
        if seed is not None:
            self._next_seed = _checks.whole("seed", seed, 0)
            self._seed_own()
        self._stop()
        episode, now = _mapping(self._name, {**_with(self._overrides, keys), "seed": self._next_seed})
        _checks.blocks("blocks", self.blocks, now["map"]["cells"])
        self._cells = int(np.prod(now["map"]["cells"]))
        self._next_seed += 1
        self._folder = tempfile.TemporaryDirectory(prefix="vantage-env-")
        self._stepped = _core.SteppedEpisode(episode, "env", self._folder.name)
        self._invalid, self._unobserved, self._time_s, self._last = 0, 1.0, 0.0, None
        observation, _, terminated, truncated, info = self._arrive()
        self._done = terminated or truncated
        return observation, info

    def step(self, action: Any) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Drives to the view and scans from there. Call reset() first, and after an episode's end."""
        if self._done or self._stepped is None:
            raise _core.Error("step() without an episode: call reset() first")
        if not self.action_space.contains(action):
            raise _core.BadDecision(f"action {action!r} is not in {self.action_space}")
        assert self._last is not None
        if not self._last["candidates"][int(action), COLUMNS.index("open")]:
            self._invalid += 1
            self._done = self._invalid >= self.max_invalid
            return self._last, 0.0, False, self._done, {**self._info(), "invalid_action": True}
        self._invalid = 0
        self._stepped.answer(int(self._shown[int(action)]))
        observation, reward, terminated, truncated, info = self._arrive()
        self._done = terminated or truncated
        return observation, reward, terminated, truncated, info

    def render(self) -> NDArray[np.uint8] | None:
        """The map from above: bright where free, grey where unobserved, dark where occupied."""
        if self.render_mode is None or self._last is None:
            return None
        free, unobserved, occupied = self._last["map"]
        share = np.stack([free.mean(axis=2), unobserved.mean(axis=2), occupied.max(axis=2)], axis=-1)
        colours = np.array([[245, 245, 240], [150, 150, 155], [200, 60, 30]], dtype=np.float32)
        image = (share @ colours) / np.maximum(share.sum(axis=-1, keepdims=True), 1e-6)
        image = np.kron(np.swapaxes(image, 0, 1)[::-1], np.ones((16, 16, 1), np.float32))
        picture: NDArray[np.uint8] = np.clip(image, 0, 255).astype(np.uint8)
        return picture

    def close(self) -> None:
        """Ends what is under way. The environment may be reset again."""
        self._stop()

    def __enter__(self) -> Env:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _stop(self) -> None:
        self._stepped = None
        self._done = True
        if self._folder is not None:
            self._folder.cleanup()
            self._folder = None

    def _arrive(self) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Waits for the next decision, or the end."""
        assert self._stepped is not None
        try:
            state = self._stepped.wait()
        except KeyboardInterrupt:
            self._stop()
            raise
        if state == "asks":
            self._observe(self._stepped.request)
            return self._result(False, False)
        at_limit = False
        if state == "ended":
            at_limit = self._stepped.at_limit
            self._observe(self._stepped.situation)
            self._stepped.let_go()
            self._stepped.wait()
        metrics = json.loads(self._stepped.outcome[0])  # raises what kept the episode from beginning
        if self._last is None:
            raise _core.Error(f"the episode ended before its first decision: {metrics['reason']}")
        truncated = at_limit and metrics["status"] == "completed"
        observation, reward, _, _, info = self._result(not truncated, truncated)
        return observation, reward, not truncated, truncated, {**info, "metrics": metrics}

    def _observe(self, now: _core.Request | _core.Situation) -> None:
        rows = np.zeros((self.max_candidates, len(COLUMNS)), np.float32)
        if isinstance(now, _core.Request):
            self._fill(rows, now)
        limit_s = now.time_left_s if np.isfinite(now.time_left_s) else -1.0
        self._last = {
            "map": np.ascontiguousarray(now.coarse(self.blocks)),
            "candidates": rows,
            "state": np.array([*now.pose, now.scans, now.scans_left, now.time_s, limit_s], np.float32),
        }
        self._before = self._unobserved, self._time_s
        self._unobserved, self._time_s = now.unobserved_share, now.time_s

    def _fill(self, rows: NDArray[np.float32], request: _core.Request) -> None:
        open_views = ~request.exhausted
        if not open_views.any():
            open_views = np.ones_like(open_views)
        self._shown = np.sort(np.argsort(~open_views, kind="stable")[:self.max_candidates])
        shown, n = self._shown, len(self._shown)
        unit = float(self._cells) if request.gain_unit in ("bits", "cells") and self._cells else 1.0
        rows[:n, 0] = request.gain[shown] / unit
        low, high = request.interval.T / unit
        for column, values in enumerate((low, high, request.travel_s, request.path_length_m), 1):
            rows[:n, column] = np.where(np.isfinite(values), values, -1.0)[shown]
        rows[:n, 5:10] = request.views[shown]
        rows[:n, 10] = open_views[shown]

    def _result(self, terminated: bool, truncated: bool) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        assert self._last is not None
        unobserved, time_s = self._before
        reward = (unobserved - self._unobserved) - self.time_cost_per_s * (self._time_s - time_s)
        self._before = self._unobserved, self._time_s
        return self._last, float(reward), terminated, truncated, self._info()

    def _info(self) -> dict[str, Any]:
        assert self._last is not None
        return {
            "action_mask": self._last["candidates"][:, COLUMNS.index("open")].astype(np.int8),
            "time_s": self._time_s,
            "unobserved_share": self._unobserved,
            "invalid_action": False,
        }


def _mapping(name: str, keys: dict[str, Any]) -> tuple[_core.Episode, dict[str, Any]]:
    """The episode, and every key of it; refused unless it chooses among views by what the robot believes."""
    episode = episodes.episode(name, **keys)
    options = episode.options
    if "choice" not in options:
        raise _core.ConfigError(f"{name}: the task {options['task']} does not choose among views")
    if episode.knows_truth:
        raise _core.ConfigError(f"choice: {options['choice']['name']} asks ground truth, which an environment must "
                                "not learn of")
    return episode, options


def _with(keys: dict[str, Any], more: dict[str, Any]) -> dict[str, Any]:
    """Keys with more of them; of nested ones each by itself, but for strategies, which have a name."""
    both = dict(keys)
    for key, value in more.items():
        before = both.get(key)
        nested = isinstance(before, dict) and isinstance(value, dict) and "name" not in value
        both[key] = _with(before, value) if nested and before is not None else value
    return both


def _most_candidates(options: dict[str, Any]) -> int:
    if "candidates" in options:
        ring = options["candidates"]
        return int(ring["positions"]) * len(ring["yaw_offsets_rad"])
    return int(options["max_candidates"])


def register() -> bool:
    """Makes the environments known to Gymnasium as vantage/tabletop-v0, ...; False where it is not installed."""
    try:
        import gymnasium
    except ImportError:
        return False
    for name in ("tabletop", "office_small", "office_large"):
        gymnasium.register(id=f"vantage/{name}-v0", entry_point="vantage:Env", kwargs={"name": name})
    return True


register()
