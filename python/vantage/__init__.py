"""Information-theoretic action selection for robots: maps, views, what they are worth, and what to look at next.

Lengths are in metres, angles in radians, times in seconds. World frame: z up; sensor frame: x forward, z up.
A pose on the floor is (x, y, yaw); a sensor pose is (x, y, z, yaw, pitch), pitch looks down. Cells of a grid
are indexed [x, y, z].
"""

from pathlib import Path as _Path

from . import _core as _core
from ._core import (
    FREE,
    OCCUPIED,
    UNOBSERVED,
    BadDecision,
    ConfigError,
    DistanceField,
    DistributionError,
    DivergedError,
    Episode,
    Error,
    FlightCost,
    ForecastInterval,
    Grid,
    InputError,
    OctoMap,
    OutputError,
    Recogniser,
    RendererError,
    Request,
    Situation,
    ViewProblem,
    Ways,
    binary_entropy_bits,
    conditional_entropy_bits,
    data_root,
    entropy_bits,
    find_frontiers,
    gains,
    gaussian_bhattacharyya_distance_bits,
    gaussian_jeffreys_divergence_bits,
    gaussian_kl_divergence_bits,
    jeffreys_divergence_bits,
    joint_entropy_bits,
    kl_divergence_bits,
    map_gains,
    mutual_information_bits,
    optimise_trajectory,
    own_gains,
    pairwise_information_bits,
    plan_views,
    ring_of_views,
    sample_views,
    set_verbosity,
    shortest_route,
    strategies,
    train,
    version,
)
# The data of the package: beside it as pip installs it, in <prefix>/share/vantage otherwise.
_here = _Path(__file__).resolve().parent
for _folder in [_here / "share", *(parent / "share/vantage" for parent in _here.parents[3:4])]:
    if (_folder / "models").is_dir():
        _core._set_data_root(str(_folder))

from .env import Env  # noqa: E402
from .episodes import Run, load, run
from .ranking import rank_views
from .vector import VectorEnv

__version__ = version().split()[0]
__all__ = sorted(name for name in globals() if not name.startswith("_") and name not in ("env", "episodes", "ranking", "vector", "spaces"))
