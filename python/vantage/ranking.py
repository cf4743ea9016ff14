"""Views ranked by what they are worth."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._core import Grid, OctoMap, gains, map_gains


def rank_views(map: Grid | OctoMap, views: ArrayLike, **options: Any) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Indices of the views, best first, and what each is worth, (n,) both; of equal ones the first comes first.

    `map` is a Grid or an OctoMap; options are those of gains() and map_gains().
    """
    worth = map_gains(map, views, **options) if isinstance(map, OctoMap) else gains(map, views, **options)
    return np.argsort(-worth, kind="stable"), worth
