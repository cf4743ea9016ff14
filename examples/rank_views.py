"""Views of a map of your own, ranked: a room that was half seen, and where to look next."""

import matplotlib.pyplot as plt
import numpy as np
import vantage
from common import folder, save

out = folder(__doc__)

# A room of 6 x 6 x 2.4 m with a wall across it; the near half has been seen.
states = np.full((60, 60, 24), 0.5)  # p(occupied); 0.5: never seen
states[:, :32, :] = 0.02
states[:, :, 0] = 0.98
states[[0, -1], :32, :] = 0.98
states[:, 0, :] = 0.98
states[:24, 32, :] = 0.98
states[40:, 32, :] = 0.98
grid = vantage.Grid.from_probabilities(states, min_corner_m=(0, 0, 0), cell_size_m=0.1)

# Candidates: every 1 m on the free side, in eight directions, 1.2 m above the floor.
x, y, yaw = np.meshgrid(np.arange(1, 6), np.arange(1, 3.5), np.arange(8) * np.pi / 4, indexing="ij")
views = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, 1.2), yaw.ravel()])
order, worth = vantage.rank_views(grid, views, gain={"name": "beer_lambert", "a": 0.95}, threads=2)
for rank in order[:3]:
    print(f"{worth[rank]:8.0f} bits from ({views[rank, 0]:.1f}, {views[rank, 1]:.1f}) m, "
          f"{np.degrees(views[rank, 3]):4.0f} deg")

figure, axes = plt.subplots(figsize=(6, 6))
seen = grid.states()[:, :, 12]
axes.imshow(seen.T, origin="lower", extent=(0, 6, 0, 6), cmap="Greys", vmin=-0.5, vmax=3)
share = worth / worth.max()
arrows = axes.quiver(views[:, 0], views[:, 1], share * np.cos(views[:, 3]), share * np.sin(views[:, 3]), worth,
                     cmap="viridis", scale=14, width=0.006)
axes.plot(*views[order[0], :2], "o", color="crimson", markersize=12, fillstyle="none", label="best view")
figure.colorbar(arrows, label="expected information, bits", shrink=0.8)
axes.set(xlabel="x, m", ylabel="y, m", title="Where to look next (free white, unseen grey, walls dark)")
axes.legend(loc="upper right")
save(figure, out / "rank_views.png")
