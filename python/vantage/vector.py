"""Several environments at once, each in a process of its own."""

from __future__ import annotations

import multiprocessing
import signal
import traceback
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core, spaces
from .env import Env, Observation


def _serve(pipe: Any, make: Callable[[], Env]) -> None:
    """Answers to (method, arguments) until told to close, or the other end is gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent is told, and closes
    env = None
    try:
        env = make()
        pipe.send((True, (env.action_space, env.observation_space)))
        while True:
            method, arguments = pipe.recv()
            if method == "close":
                return
            pipe.send((True, getattr(env, method)(**arguments)))
    except (EOFError, BrokenPipeError):
        pass
    except BaseException as error:  # told to the parent, whatever it is
        pipe.send((False, (f"{type(error).__name__}: {error}", traceback.format_exc())))
    finally:
        if env is not None:
            env.close()


class VectorEnv:
    """Environments side by side, as Gymnasium's vector environments in autoreset mode NEXT_STEP.

    `makers` make an Env each, in its own process. Observations, rewards and flags are stacked, the first axis
    the environment. After an environment's end, the next step() resets it, whatever its action: its reward is 0.
    info is a dict of lists, an entry an environment, None where it says nothing.
    """

    metadata: dict[str, Any] = {"autoreset_mode": "next_step"}

    def __init__(self, makers: Sequence[Callable[[], Env]], context: str = "spawn") -> None:
        if not makers:
            raise _core.ConfigError("makers: none")
        processes: Any = multiprocessing.get_context(context)
        self.num_envs = len(makers)
        self._pipes: list[Any] = []
        self._processes: list[Any] = []
        self._ended = np.zeros(self.num_envs, bool)
        try:
            for make in makers:
                ours, theirs = processes.Pipe()
                process = processes.Process(target=_serve, args=(theirs, make), daemon=True)
                process.start()
                theirs.close()
                self._pipes.append(ours)
                self._processes.append(process)
            found = [self._receive(i) for i in range(self.num_envs)]
        except BaseException:
            self.close()
            raise
        self.single_action_space, self.single_observation_space = found[0]
        self.action_space = spaces.MultiDiscrete([self.single_action_space.n] * self.num_envs)
        self.observation_space = spaces.Dict({
            name: spaces.Box(np.stack([box.low] * self.num_envs), np.stack([box.high] * self.num_envs),
                             dtype=box.dtype)
            for name, box in self.single_observation_space.spaces.items()})

    def reset(self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
              ) -> tuple[Observation, dict[str, list[Any]]]:
        """Begins an episode in each: with one seed given, environment i has seed + i."""
        seeds: list[int | None] = [None] * self.num_envs
        if isinstance(seed, (int, np.integer)):
            seeds = [int(seed) + i for i in range(self.num_envs)]
        elif seed is not None:
            seeds = list(seed)
        if len(seeds) != self.num_envs:
            raise _core.ConfigError(f"seed: {len(seeds)} of {self.num_envs} environments")
        for pipe, one in zip(self._pipes, seeds):
            pipe.send(("reset", {"seed": one, "options": options}))
        found = [self._receive(i) for i in range(self.num_envs)]
        self._ended[:] = False
        return _stacked([observation for observation, _ in found]), _listed([info for _, info in found])

    def step(self, actions: Any) -> tuple[Observation, NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_],
                                          dict[str, list[Any]]]:
        """One action each, (num_envs,)."""
        chosen = np.asarray(actions)
        if chosen.shape != (self.num_envs,):
            raise _core.BadDecision(f"actions: shape {chosen.shape} is not ({self.num_envs},)")
        for i, pipe in enumerate(self._pipes):
            pipe.send(("reset", {}) if self._ended[i] else ("step", {"action": int(chosen[i])}))
        found = []
        for i in range(self.num_envs):
            answer = self._receive(i)
            found.append((answer[0], 0.0, False, False, answer[1]) if self._ended[i] else answer)
        observations, rewards, terminated, truncated, infos = zip(*found)
        ends = np.array(terminated), np.array(truncated)
        self._ended = ends[0] | ends[1]
        return _stacked(observations), np.array(rewards), *ends, _listed(infos)

    def close(self) -> None:
        """Ends the processes."""
        for pipe in self._pipes:
            try:
                pipe.send(("close", {}))
            except (OSError, ValueError):
                pass
            pipe.close()
        for process in self._processes:
            process.join(timeout=10)
            if process.is_alive():
                process.kill()
                process.join()
        self._pipes, self._processes = [], []

    def __enter__(self) -> VectorEnv:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _receive(self, i: int) -> Any:
        try:
            good, answer = self._pipes[i].recv()
        except (EOFError, ConnectionResetError):
            raise _core.Error(f"environment {i} died") from None
        if not good:
            raise _core.Error(f"environment {i}: {answer[0]}\n{answer[1]}")
        return answer


def _stacked(observations: Sequence[Observation]) -> Observation:
    return {name: np.stack([one[name] for one in observations]) for name in observations[0]}


def _listed(infos: Sequence[dict[str, Any]]) -> dict[str, list[Any]]:
    names = dict.fromkeys(name for info in infos for name in info)
    return {name: [info.get(name) for info in infos] for name in names}
