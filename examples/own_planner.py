"""A planner of your own drives the robot of an episode: gain per second, against two choices that are built in."""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import vantage
from common import folder, save

out = folder(__doc__)
episode = {"scans": 7, "map": {"cells": [65, 65, 33]}, "laser": {"scan_duration_s": 3}, "seed": 4}


def gain_per_second(request):
    """Index of the view that promises most for the time it takes."""
    rate = request.gain / (request.travel_s + request.scan_s)
    rate[request.exhausted] = -np.inf
    return int(np.argmax(rate))


figure, axes = plt.subplots(figsize=(7, 4.5))
with tempfile.TemporaryDirectory() as runs:
    for label, line, options in (("gain_per_second (ours)", {"marker": "o", "lw": 4, "ms": 10, "alpha": 0.5},
                                  {"planner": gain_per_second}),
                                 ("greedy", {"marker": "s", "ls": "--", "ms": 5}, {}),
                                 ("random", {"marker": "^", "ls": ":"}, {"choice": "random"})):
        run = vantage.run("tabletop", out=Path(runs) / label.split()[0], lean=True, **episode, **options)
        steps = run.steps
        observable = run.metrics["observable_cells"]
        seen = 1 - steps["observable_unobserved_cells"] / observable
        axes.plot(steps["time_s"], 100 * seen, label=label, **line)
        print(f"{label:24} {100 * seen[-1]:5.1f} % seen after {steps['time_s'][-1]:5.1f} s, "
              f"{run.metrics['collisions']} collisions")
axes.set(xlabel="simulated time, s", ylabel="observable cells seen, %", title="One table, three planners")
axes.grid(alpha=0.3)
axes.legend()
save(figure, out / "own_planner.png")
