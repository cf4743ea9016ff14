"""How fast environments step, and what Python costs a sweep: one line of JSON, as every benchmark prints.

The small map is the table top at 49 x 49 x 25 cells with a sweep of 3 s; one environment on one core, then as many
side by side as VECTOR says.
"""

import csv
import functools
import hashlib
import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import vantage

SMALL = {"scans": 10, "threads": 1, "map": {"cells": [49, 49, 25]}, "laser": {"scan_duration_s": 3}}
VECTOR = 2  # environments, each in its process


def median_ms(work, repeats):
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        times.append(1e3 * (time.perf_counter() - start))
    return statistics.median(times)


def env_figures():
    rng = np.random.default_rng(1)
    decisions, stepping_s, simulated_s, resets_ms = 0, 0.0, 0.0, []
    with vantage.Env("tabletop", **SMALL) as env:
        for seed in range(1, 4):
            start = time.perf_counter()
            observation, info = env.reset(seed=seed)
            resets_ms.append(1e3 * (time.perf_counter() - start))
            begun_s, done = info["time_s"], False
            start = time.perf_counter()
            while not done:
                view = int(rng.choice(np.flatnonzero(info["action_mask"])))
                observation, _, terminated, truncated, info = env.step(view)
                decisions += 1
                done = terminated or truncated
            stepping_s += time.perf_counter() - start
            simulated_s += info["time_s"] - begun_s
    return {"decisions_per_s": decisions / stepping_s, "reset_ms": statistics.median(resets_ms),
            "simulated_s_per_decision": simulated_s / decisions, "real_time_factor": simulated_s / stepping_s}


def vector_figures():
    """Decisions of all environments over the time of the steps in which none is reset."""
    rng = np.random.default_rng(2)
    decisions, stepping_s = 0, 0.0
    with vantage.VectorEnv([functools.partial(vantage.Env, "tabletop", **SMALL)] * VECTOR) as environments:
        _, infos = environments.reset(seed=11)
        ended = np.zeros(VECTOR, bool)
        while decisions < 27 * VECTOR:
            views = [0 if over else int(rng.choice(np.flatnonzero(mask)))
                     for mask, over in zip(infos["action_mask"], ended)]
            start = time.perf_counter()
            *_, terminated, truncated, infos = environments.step(views)
            if not ended.any():
                decisions += VECTOR
                stepping_s += time.perf_counter() - start
            ended = terminated | truncated
    return {"vector_processes": VECTOR, "vector_decisions_per_s": decisions / stepping_s}


def profile(programs):
    """Shares of the time of such an episode, by part."""
    told = json.loads(subprocess.run([programs / "bench_episode", "small"], check=True, capture_output=True).stdout)
    return {name.removeprefix("small_"): value for name, value in told["figures"].items() if name.endswith("_share")}


def sweep_figures(programs):
    """The same sweep from numpy, grid made anew each time, and in C++."""
    with tempfile.TemporaryDirectory() as work:
        run = vantage.run("tabletop", out=Path(work) / "run", scans=2)
        run.map.write(Path(work) / "map.ot")
        grid = vantage.Grid.read(Path(work) / "map.ot")
        views = vantage.ring_of_views(grid.min_corner_m + 0.5 * np.array(grid.shape) * grid.cell_size_m)
        with open(Path(work) / "views.csv", "w", newline="", encoding="ascii") as file:
            rows = csv.writer(file)
            rows.writerow(["x_m", "y_m", "z_m", "yaw_rad", "pitch_rad"])
            rows.writerows([[repr(float(v)) for v in row] for row in views])
        odds = np.array(grid.log_odds)
        program = [programs / "bench_swept", Path(work) / "map.ot", Path(work) / "views.csv", "15"]

        def from_numpy():
            made = vantage.Grid(odds, grid.min_corner_m, grid.cell_size_m)
            vantage.gains(made, views, FIELD, "beer_lambert")

        numpy_ms, cpp_ms = [], []
        for _ in range(3):  # by turns, the least of each: other work on the machine slows both
            cpp_ms.append(float(subprocess.run(program, check=True, capture_output=True, text=True).stdout))
            numpy_ms.append(median_ms(from_numpy, 15))
        return {"swept_numpy_ms": min(numpy_ms), "swept_cpp_ms": min(cpp_ms),
                "swept_numpy_over_cpp": min(numpy_ms) / min(cpp_ms)}


#: FieldOfView's defaults, a tilting laser.
FIELD = {"half_width_rad": 0.1309, "tilt_min_rad": -0.3, "tilt_max_rad": 0.75, "range_min_m": 0.08,
         "range_max_m": 10.0}


def main(programs):
    figures = {**env_figures(), **vector_figures(), **profile(programs), **sweep_figures(programs)}
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        cpu = next((line.split(":", 1)[1].strip() for line in file if line.startswith("model name")), "unknown")
    commit = vantage.version().split("(")[-1].rstrip(")")
    configuration = json.dumps([SMALL, VECTOR, FIELD], sort_keys=True)
    config_hash = hashlib.sha256(configuration.encode()).hexdigest()[:16]
    print(json.dumps({"name": "env", "commit": commit, "config_hash": config_hash, "cpu": cpu, "threads": 1,
                      "figures": figures}, separators=(",", ":")))


if __name__ == "__main__":  # processes of the vector environment import this file
    main(Path(sys.argv[1]))
