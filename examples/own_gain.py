"""A gain of your own as two arrays: what seeing a cell is worth, and how much of a beam passes it."""

import matplotlib.pyplot as plt
import numpy as np
import vantage
from common import folder, save

out = folder(__doc__)

# A table top: two boxes, seen from one side only.
p = np.full((50, 50, 25), 0.5)
p[:25] = 0.02
p[:, :, 0] = 0.97
p[22:26, 10:20, 1:12] = 0.97
p[22:30, 32:40, 1:18] = 0.97
grid = vantage.Grid.from_probabilities(p, min_corner_m=(-0.5, -0.5, 0.8), cell_size_m=0.02)
views = vantage.ring_of_views((0, 0, 0), positions=72, radius_m=1.4, height_m=1.25, yaw_offsets_rad=[0.0])
sensor = {"half_width_rad": 0.4, "tilt_min_rad": -0.2, "tilt_max_rad": 0.7, "range_min_m": 0.3, "range_max_m": 3.0}

# Objects are worth completing: only unseen cells beside a known surface count.
state = grid.states()
occupied = state == vantage.OCCUPIED
occupied[:, :, 0] = False  # the table itself is no object
beside = np.zeros_like(occupied)
for axis in range(3):
    for step in (-1, 1):
        beside |= np.roll(occupied, step, axis)
utility = ((state == vantage.UNOBSERVED) & beside).astype(float)
transmission = np.choose(state, [1.0, 0.97, 0.0])  # free, unobserved, occupied

own = vantage.own_gains(grid, views, utility, transmission, sensor, threads=2)
built_in = vantage.gains(grid, views, sensor, {"name": "beer_lambert", "a": 0.97}, threads=2)
bearing = np.arctan2(views[:, 1], views[:, 0])
print(f"best by rims: {np.degrees(bearing[own.argmax()]):.0f} deg, "
      f"by all that is unseen: {np.degrees(bearing[built_in.argmax()]):.0f} deg")

figure, axes = plt.subplots(subplot_kw={"projection": "polar"}, figsize=(6, 6))
for worth, name in ((own, "unseen cells beside a surface"), (built_in, "all unseen cells (beer_lambert)")):
    closed = np.append(worth, worth[0]) / worth.max()
    axes.plot(np.append(bearing, bearing[0]), closed, label=name)
axes.set_title("What a view from each bearing is worth, of the best")
axes.legend(loc="lower center", bbox_to_anchor=(0.5, -0.2))
save(figure, out / "own_gain.png")
