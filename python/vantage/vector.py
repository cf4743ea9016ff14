"""Several environments at once, each in a process of its own."""

from __future__ import annotations

import multiprocessing
import pickle
import signal
import traceback
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _checks, _core, spaces
from .env import Env, Observation

#: Of one call: (True, what it returned) or (False, (type of the error, its text, where it was raised)).
_Answer = tuple[bool, Any]


def _tried(work: Callable[..., Any], **arguments: Any) -> _Answer:
    """What `work` answers. Errors of types that the other end need not know are told as Error."""
    try:
        return True, work(**arguments)
    except BaseException as error:  # told to the parent, whatever it is
        kind = type(error)
        if issubclass(kind, _core.Error) or (kind.__module__ == "builtins" and issubclass(kind, Exception)):
            return False, (kind, str(error), traceback.format_exc())
        return False, (_core.Error, f"{kind.__name__}: {error}", traceback.format_exc())


def _serve(pipe: Any, make: Callable[[], Env]) -> None:
    """Answers to (method, arguments) until told to close, or the other end is gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent is told, and closes
    good, env = _tried(make)
    try:
        pipe.send((True, (env.action_space, env.observation_space)) if good else (False, env))
        while good:
            method, arguments = pipe.recv()
            if method == "close":
                return
            pipe.send(_tried(getattr(env, method), **arguments))
    except (EOFError, ConnectionError):
        pass
    finally:
        if good:
            env.close()


def _error(i: int, kind: type[Exception], text: str, trace: str) -> Exception:
    """That of environment i, of the same type; its cause is where it was raised."""
    try:
        error = kind(f"environment {i}: {text}")
    except Exception:  # a type that is not made from a text
        error = _core.Error(f"environment {i}: {kind.__name__}: {text}")
    error.__cause__ = _core.Error(trace) if trace else None
    return error


class VectorEnv:
    """Environments side by side, stepped as Gymnasium's vector environments in autoreset mode NEXT_STEP.

    `makers` make an Env each, in its own process. Observations, rewards and flags are stacked, the first axis
    the environment. After an environment's end, the next step() resets it, whatever its action: its reward is 0.
    infos are not Gymnasium's arrays with `_key` masks: a dict of lists, an entry an environment, None where it says
    nothing.

    An error in an environment is raised here when all have answered, as of the same type and with the number of
    the environment; the others have gone on, and all may be stepped or reset again. Ctrl-C closes it.
    """

    metadata: dict[str, Any] = {"autoreset_mode": "next_step"}

    def __init__(self, makers: Sequence[Callable[[], Env]], context: str = "spawn") -> None:
        if not makers:
            raise _core.ConfigError("makers: none")
        self.num_envs = len(makers)
        self.closed = False
        self._pipes: list[Any] = []
        self._processes: list[Any] = []
        self._ended = np.zeros(self.num_envs, bool)
        try:
            self._start(makers, multiprocessing.get_context(context))
            found = self._good(self._answers())
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
        keys = _checks.keys("options", options)
        answers = self._call([("reset", {"seed": one, "options": keys}) for one in self._seeds(seed)])
        self._ended &= [not good for good, _ in answers]
        found = self._good(answers)
        return _stacked([observation for observation, _ in found]), _listed([info for _, info in found])

    def step(self, actions: Any) -> tuple[Observation, NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_],
                                          dict[str, list[Any]]]:
        """One action each, (num_envs,). Raises BadDecision before any has moved."""
        chosen = self._checked(actions)
        was_ended = self._ended.copy()
        answers = self._call([("reset", {}) if was_ended[i] else ("step", {"action": int(chosen[i])})
                              for i in range(self.num_envs)])
        for i, (good, answer) in enumerate(answers):
            if good and was_ended[i]:
                answers[i] = True, (answer[0], 0.0, False, False, answer[1])
            if good:
                self._ended[i] = answers[i][1][2] or answers[i][1][3]
        observations, rewards, terminated, truncated, infos = zip(*self._good(answers))
        return _stacked(observations), np.array(rewards), np.array(terminated), np.array(truncated), _listed(infos)

    def close(self) -> None:
        """Ends the processes. It cannot be used again."""
        self.closed = True
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

    def _start(self, makers: Sequence[Callable[[], Env]], processes: Any) -> None:
        for make in makers:
            ours, theirs = processes.Pipe()
            self._pipes.append(ours)
            process = processes.Process(target=_serve, args=(theirs, make), daemon=True)
            process.start()
            theirs.close()
            self._processes.append(process)

    def _seeds(self, seed: int | Sequence[int | None] | None) -> list[int | None]:
        if seed is None:
            return [None] * self.num_envs
        if np.ndim(seed) == 0:
            first = _checks.whole("seed", seed, 0)
            return [first + i for i in range(self.num_envs)]
        seeds = list(seed)  # type: ignore[arg-type]
        if len(seeds) != self.num_envs:
            raise _core.ConfigError(f"seed: {len(seeds)} of {self.num_envs} environments")
        return [None if one is None else _checks.whole(f"seed[{i}]", one, 0) for i, one in enumerate(seeds)]

    def _checked(self, actions: Any) -> NDArray[Any]:
        """Actions that the environments can be sent. Of those that are reset any number will do."""
        try:
            chosen = np.asarray(actions)
        except ValueError as error:
            raise _core.BadDecision(f"actions: {error}") from None
        if chosen.shape != (self.num_envs,):
            raise _core.BadDecision(f"actions: shape {chosen.shape} is not ({self.num_envs},)")
        if not np.issubdtype(chosen.dtype, np.integer):
            raise _core.BadDecision(f"actions: {_checks.short(actions)} are not whole numbers")
        for i, action in enumerate(chosen):
            if not self._ended[i] and action not in self.single_action_space:
                raise _core.BadDecision(f"environment {i}: action {action} is not in {self.single_action_space}")
        return chosen

    def _call(self, calls: Sequence[tuple[str, dict[str, Any]]]) -> list[_Answer]:
        """A call to each environment, and its answer."""
        if self.closed:
            raise _core.Error("the VectorEnv is closed: make another")
        try:
            messages = [pickle.dumps(call) for call in calls]
        except Exception as error:
            raise _core.ConfigError(f"options: cannot be sent to another process: {error}") from None
        try:
            for pipe, message in zip(self._pipes, messages):
                try:
                    pipe.send_bytes(message)
                except OSError:
                    pass  # it died, as its answer says
            return self._answers()
        except BaseException:  # Ctrl-C: what is still to be answered would be taken for answers to the next call
            self.close()
            raise

    def _answers(self) -> list[_Answer]:
        """Of all environments, so that none is left for the next call."""
        answers: list[_Answer] = []
        for pipe in self._pipes:
            try:
                answers.append(pipe.recv())
            except (EOFError, OSError):
                answers.append((False, (_core.Error, "its process died", "")))
        return answers

    def _good(self, answers: Sequence[_Answer]) -> list[Any]:
        """What they are, or the first error among them, raised."""
        for i, (good, answer) in enumerate(answers):
            if not good:
                raise _error(i, *answer)
        return [answer for _, answer in answers]


def _stacked(observations: Sequence[Observation]) -> Observation:
    return {name: np.stack([one[name] for one in observations]) for name in observations[0]}


def _listed(infos: Sequence[dict[str, Any]]) -> dict[str, list[Any]]:
    names = dict.fromkeys(name for info in infos for name in info)
    return {name: [info.get(name) for info in infos] for name in names}
