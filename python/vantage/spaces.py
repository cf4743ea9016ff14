"""Spaces of observations and actions with the members that Gymnasium's have, for where it is not installed."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["Box", "Dict", "Discrete", "MultiDiscrete"]

try:  # the real ones where there are any, so that other tools know them
    from gymnasium.spaces import Box, Dict, Discrete, MultiDiscrete  # type: ignore[import]
except ImportError:

    class Space:
        """What all spaces have."""

        def __init__(self, shape: tuple[int, ...] | None, dtype: Any, seed: int | None = None) -> None:
            self.shape = shape
            self.dtype = None if dtype is None else np.dtype(dtype)
            self._np_random: np.random.Generator | None = None
            if seed is not None:
                self.seed(seed)

        @property
        def np_random(self) -> np.random.Generator:
            if self._np_random is None:
                self.seed()
            assert self._np_random is not None
            return self._np_random

        def seed(self, seed: int | None = None) -> Any:
            self._np_random = np.random.default_rng(seed)
            return seed

        def contains(self, x: Any) -> bool:
            raise NotImplementedError

        def __contains__(self, x: Any) -> bool:
            return self.contains(x)

    class Discrete(Space):  # type: ignore[no-redef]
        """start, start + 1, ... start + n - 1."""

        def __init__(self, n: int, seed: int | None = None, start: int = 0) -> None:
            super().__init__((), np.int64, seed)
            self.n, self.start = np.int64(n), np.int64(start)

        def sample(self, mask: NDArray[np.int8] | None = None) -> np.int64:
            """One of them; with a mask, of those where it is 1."""
            choices = np.arange(self.n) if mask is None else np.flatnonzero(np.asarray(mask) == 1)
            return np.int64(self.start + (self.np_random.choice(choices) if len(choices) else 0))

        def contains(self, x: Any) -> bool:
            whole = isinstance(x, (int, np.integer)) or (
                isinstance(x, np.ndarray) and x.shape == () and np.issubdtype(x.dtype, np.integer))
            return bool(whole and self.start <= x < self.start + self.n)

        def __eq__(self, other: object) -> bool:
            return isinstance(other, Discrete) and (self.n, self.start) == (other.n, other.start)

        def __repr__(self) -> str:
            return f"Discrete({self.n})"

    class MultiDiscrete(Space):  # type: ignore[no-redef]
        """A Discrete for each of several places."""

        def __init__(self, nvec: Any, dtype: Any = np.int64, seed: int | None = None) -> None:
            self.nvec = np.asarray(nvec, dtype=dtype)
            super().__init__(self.nvec.shape, dtype, seed)

        def sample(self, mask: Any = None) -> NDArray[Any]:
            drawn: NDArray[Any] = (self.np_random.random(self.nvec.shape) * self.nvec).astype(self.dtype)
            return drawn

        def contains(self, x: Any) -> bool:
            x = np.asarray(x)
            return bool(x.shape == self.shape and np.issubdtype(x.dtype, np.integer)
                        and np.all(x >= 0) and np.all(x < self.nvec))

        def __eq__(self, other: object) -> bool:
            return isinstance(other, MultiDiscrete) and np.array_equal(self.nvec, other.nvec)

    class Box(Space):  # type: ignore[no-redef]
        """Arrays of one shape between bounds."""

        def __init__(self, low: Any, high: Any, shape: Sequence[int] | None = None, dtype: Any = np.float32,
                     seed: int | None = None) -> None:
            shape = tuple(shape) if shape is not None else np.shape(low)
            super().__init__(shape, dtype, seed)
            self.low = np.broadcast_to(np.asarray(low, dtype), shape)
            self.high = np.broadcast_to(np.asarray(high, dtype), shape)

        def sample(self, mask: Any = None) -> NDArray[Any]:
            low = np.where(np.isfinite(self.low), self.low, -1e3)
            high = np.where(np.isfinite(self.high), self.high, 1e3)
            return self.np_random.uniform(low, high).astype(self.dtype)

        def contains(self, x: Any) -> bool:
            return bool(isinstance(x, np.ndarray) and np.can_cast(x.dtype, self.dtype) and x.shape == self.shape
                        and np.all(x >= self.low) and np.all(x <= self.high))

        def __eq__(self, other: object) -> bool:
            return (isinstance(other, Box) and self.shape == other.shape and self.dtype == other.dtype
                    and np.array_equal(self.low, other.low) and np.array_equal(self.high, other.high))

        def __repr__(self) -> str:
            return f"Box{self.shape}"

    class Dict(Space):  # type: ignore[no-redef]
        """Spaces by name."""

        def __init__(self, spaces: Mapping[str, Any], seed: int | None = None) -> None:
            self.spaces: OrderedDict[str, Any] = OrderedDict(sorted(spaces.items()))
            super().__init__(None, None, seed)

        def seed(self, seed: int | None = None) -> Any:
            super().seed(seed)
            for space in self.spaces.values():
                space.seed(int(self.np_random.integers(2**31)))
            return seed

        def sample(self, mask: Any = None) -> dict[str, Any]:
            return {name: space.sample() for name, space in self.spaces.items()}

        def contains(self, x: Any) -> bool:
            return (isinstance(x, dict) and x.keys() == self.spaces.keys()
                    and all(x[name] in space for name, space in self.spaces.items()))

        def __getitem__(self, name: str) -> Any:
            return self.spaces[name]

        def __iter__(self) -> Any:
            return iter(self.spaces)

        def __len__(self) -> int:
            return len(self.spaces)

        def __eq__(self, other: object) -> bool:
            return isinstance(other, Dict) and self.spaces == other.spaces
