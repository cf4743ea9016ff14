"""Episodes run, and run folders read back."""

from __future__ import annotations

import csv
import json
import re
from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _checks, _core

Planner = Callable[[_core.Request], "int | ArrayLike"]


def episode(name: str | PathLike[str], **overrides: Any) -> _core.Episode:
    """The episode of that name ("tabletop", "office_small") or file, with keys set as in run()."""
    text = _checks.path("name", name)
    if not text.endswith((".yaml", ".yml")) and "/" not in text:
        text = f"assets/episodes/{text}.yaml"
    return _core.Episode(text, overrides)


class Run:
    """A run folder: what an episode came to. Everything is read when it is asked for."""

    def __init__(self, directory: str | PathLike[str]) -> None:
        self.directory = Path(directory)
        if not (self.directory / "metrics.json").is_file():
            raise _core.InputError(f"{self.directory}: no run folder: metrics.json is missing")

    def __repr__(self) -> str:
        return f"<vantage.Run {self.directory}>"

    @property
    def metrics(self) -> dict[str, Any]:
        """metrics.json as a dict."""
        return self._json("metrics.json")

    @property
    def manifest(self) -> dict[str, Any]:
        """Versions, hashes and times of the run, manifest.json."""
        return self._json("manifest.json")

    @property
    def steps(self) -> dict[str, NDArray[Any]]:
        """steps.csv, a row a decision, as a dict of columns: what pandas.DataFrame takes."""
        return read_table(self.directory / "steps.csv")

    @property
    def candidates(self) -> dict[str, NDArray[Any]]:
        """candidates.csv, a row a view of every decision, as `steps`; of runs that are not lean. Raises InputError."""
        return read_table(self.directory / "candidates.csv")

    @property
    def trajectory(self) -> NDArray[np.float64]:
        """True poses of the body, (n, 8): time (s), x, y, z (m), quaternion x, y, z, w."""
        return np.atleast_2d(np.loadtxt(self.directory / "trajectory.tum"))

    @property
    def trajectory_estimated(self) -> NDArray[np.float64]:
        """Poses that the robot believed, (n, 8) as in `trajectory`."""
        return np.atleast_2d(np.loadtxt(self.directory / "trajectory_estimated.tum"))

    @property
    def map(self) -> _core.Grid:
        """The map that was made, with its log odds; of runs that are not lean. Raises InputError.

        Of the box of cells that were measured, not of all of the episode's map; OctoMap(directory / "map.ot")
        gives any other box of it.
        """
        return _core.Grid.read(self.directory / "map.ot")

    @property
    def frames(self) -> list[Path]:
        """The still pictures of a run with video, in order: paths of PNG files, not arrays."""
        return sorted((self.directory / "frames").glob("*.png"), key=_place_in_order)

    def _json(self, name: str) -> dict[str, Any]:
        try:
            content: dict[str, Any] = json.loads((self.directory / name).read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            raise _core.InputError(f"{self.directory / name}: {error}") from None
        return content


def _place_in_order(picture: Path) -> tuple[int, str]:
    """By the number in its name: scan_100 comes after scan_99."""
    number = re.search(r"\d+", picture.name)
    return (int(number[0]) if number else 0, picture.name)


def read_table(path: str | PathLike[str]) -> dict[str, NDArray[Any]]:
    """A CSV file of a run folder as a dict of columns: numbers, truth values or text."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise _core.InputError(f"{path}: {error}") from None
    if not rows or any(len(row) != len(rows[0]) for row in rows):
        raise _core.InputError(f"{path}: not a table with a header and as many values in each row")
    return {name: _column([row[i] for row in rows[1:]]) for i, name in enumerate(rows[0])}


def _column(values: list[str]) -> NDArray[Any]:
    if values and all(value in ("true", "false") for value in values):
        return np.array([value == "true" for value in values])
    try:
        return np.array([float(value) if value else np.nan for value in values])
    except ValueError:
        return np.array(values)


def load(directory: str | PathLike[str]) -> Run:
    """A run folder, as `vantage run` or run() wrote it. Raises InputError."""
    return Run(directory)


def run(
    name: str | PathLike[str] = "tabletop",
    *,
    planner: Planner | None = None,
    out: str | PathLike[str] | None = None,
    overwrite: bool = False,
    video: bool = False,
    lean: bool = False,
    **overrides: Any,
) -> Run:
    """Runs an episode and writes its run folder, as `vantage run` does.

    `name` is an episode of `vantage list episodes` or a file; other keywords are keys of it, nested ones as
    dicts: run("tabletop", seed=2, scans=5, map={"cells": [49, 49, 25]}).

    `planner(request)` is asked at each decision of a mapping episode in place of its own choice. It returns the
    index of a view, or a pose (x, y, yaw) on known free floor to look from. It is told what the robot believes,
    no ground truth: see Request. An index that no view has, or a pose that cannot be stood at, ends the episode as
    `failed` with the reason. An exception of the planner does too, and is raised again here once the folder is
    written; what is neither index nor pose is a BadDecision, raised as one. So is KeyboardInterrupt, with status
    `interrupted`.

    A failed or diverged episode is a result: look at run(...).metrics["status"]. Raises ConfigError, InputError,
    OutputError if it cannot begin or be written.
    """
    if planner is not None and not callable(planner):
        _checks.refuse("planner", planner, "is not a function of a request")
    label = getattr(planner, "__name__", type(planner).__name__) if planner is not None else ""
    resolved = episode(name, **overrides)
    directory = None if out is None else Path(_checks.path("out", out))
    try:
        _, folder, _ = _core.run_episode(resolved, directory, overwrite, video, lean, planner, label)
    except _core.ConfigError as error:  # as the command line says it
        if "; --overwrite replaces it" not in str(error):
            raise
        raise _core.ConfigError(str(error).replace("--overwrite", "overwrite=True")) from None
    return Run(folder)
