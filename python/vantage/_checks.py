"""Arguments checked before they are used: an error names argument and value."""

from __future__ import annotations

import numbers
import operator
from collections.abc import Mapping, Sequence
from os import PathLike, fspath
from reprlib import repr as short
from typing import Any, NoReturn

import numpy as np

from . import _core


def refuse(name: str, value: Any, why: str) -> NoReturn:
    raise _core.ConfigError(f"{name}: {short(value)} {why}") from None


def whole(name: str, value: Any, least: int) -> int:
    """A whole number, at least `least`."""
    try:
        number = operator.index(value)
    except TypeError:
        refuse(name, value, "is not a whole number")
    if number < least:
        refuse(name, number, f"is below {least}")
    return number


def finite(name: str, value: Any) -> float:
    """A number that is neither infinite nor NaN."""
    if not isinstance(value, numbers.Real) or not np.isfinite(float(value)):
        refuse(name, value, "is not a finite number")
    return float(value)


def blocks(name: str, value: Any, cells: Sequence[int]) -> tuple[int, int, int]:
    """Three whole numbers, each from 1 to as many as there are cells along that axis."""
    try:
        x, y, z = (whole(name, n, 1) for n in value)
    except (TypeError, ValueError):
        refuse(name, value, "is not three whole numbers, each at least 1")
    if any(n > limit for n, limit in zip((x, y, z), cells)):
        refuse(name, (x, y, z), f"is more than the map's {tuple(cells)} cells")
    return x, y, z


def keys(name: str, value: Any) -> dict[str, Any]:
    """A dict by names; None: an empty one."""
    if value is None:
        return {}
    if not isinstance(value, Mapping) or not all(isinstance(key, str) for key in value):
        refuse(name, value, "is not a dict of keys and values")
    return dict(value)


def path(name: str, value: Any) -> str:
    """The name of a file or folder."""
    written = fspath(value) if isinstance(value, (str, PathLike)) else None
    if not isinstance(written, str):
        refuse(name, value, "is not a name or path")
    return written
