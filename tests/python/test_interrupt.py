"""Ctrl-C ends calls that would take long, soon, and changes nothing of those that are let run."""

import os
import signal
import threading
import time
import unittest

import numpy as np
import vantage
from support import InFolder

#: Sees far to all sides: a view takes long.
WIDE = {"half_width_rad": 3.1, "tilt_min_rad": -1.5, "tilt_max_rad": 1.5, "range_min_m": 0.1, "range_max_m": 30.0}
PRESSED_S = 0.4
MOST_S = 4.0  # from the key to the exception; on a machine that does nothing else 0.1


class Interrupted(InFolder):
    def assert_ends_soon(self, call):
        pressed = []

        def press():
            pressed.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

        timer = threading.Timer(PRESSED_S, press)
        timer.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                call()
                self.fail("it took less time than it was given")
        finally:
            timer.cancel()
            timer.join()
        self.assertLess(time.monotonic() - pressed[0], MOST_S)

    def unknown(self):
        return vantage.Grid(np.zeros((200, 200, 60)), (0, 0, 0), 0.05)

    def views(self, count):
        rng = np.random.default_rng(1)
        return np.column_stack([rng.uniform(0.5, 9.5, (count, 2)), rng.uniform(0.5, 2.5, count),
                                rng.uniform(-3, 3, count)])

    def problem(self, count):
        """Views spread over a hall, each of which shows a block of its own and some of others'."""
        rng = np.random.default_rng(2)
        places = rng.uniform(0, 100, (count, 2))
        ways = np.hypot(*(places[:, None] - places[None]).transpose(2, 0, 1))
        travel = np.vstack([ways, np.hypot(*places.T)])
        return vantage.ViewProblem(np.ones(count), np.eye(count), places, travel, scan_s=1.0)

    def test_exact_gains(self):
        grid = self.unknown()
        self.assert_ends_soon(lambda: vantage.gains(grid, self.views(400), WIDE, method="exact"))
        # Of several threads each ends the view that it is at.
        self.assert_ends_soon(lambda: vantage.gains(grid, self.views(8000), {**WIDE, "half_width_rad": 0.4},
                                                    method="exact", threads=2))

    def test_gains_that_cannot_be_swept(self):
        self.assert_ends_soon(lambda: vantage.gains(self.unknown(), self.views(400), WIDE, "average_entropy"))

    def test_swept_gains(self):
        self.assert_ends_soon(lambda: vantage.gains(self.unknown(), self.views(500), WIDE))

    def test_own_gains(self):
        every = np.ones((200, 200, 60))
        self.assert_ends_soon(lambda: vantage.own_gains(self.unknown(), self.views(400), every, every, WIDE))

    def test_gains_on_a_file(self):
        grid = self.unknown()
        grid.log_odds[::4, ::4, ::4] = -1.0
        grid.write(self.folder / "map.ot")
        octomap = vantage.OctoMap(self.folder / "map.ot")
        self.assert_ends_soon(lambda: vantage.map_gains(octomap, self.views(500), WIDE))

    def test_ways_between_places(self):
        ways = vantage.Ways(np.zeros((600, 600), np.uint8), (15, 15, 0))
        places = np.random.default_rng(3).uniform(1, 29, (1000, 2))
        self.assert_ends_soon(lambda: ways.lengths_between_m(places))

    def test_ways_over_a_large_floor(self):
        floor = np.zeros((3000, 3000), np.uint8, order="F")
        self.assert_ends_soon(lambda: vantage.Ways(floor, (75, 75, 0)))

    def test_plans(self):
        problem = self.problem(900)
        self.assert_ends_soon(lambda: vantage.plan_views(problem, "tour", worth_s=1e4))

    def test_shortest_routes(self):
        costs = np.random.default_rng(4).uniform(1, 9, (701, 700))
        self.assert_ends_soon(lambda: vantage.shortest_route(costs))

    def test_problems_on_maps(self):
        ways = vantage.Ways(np.zeros((200, 200), np.uint8), (5, 5, 0))
        views = self.views(1000)
        self.assert_ends_soon(
            lambda: vantage.ViewProblem.on_map(self.unknown(), views, ways, sensor=WIDE))


class Unchanged(unittest.TestCase):
    """What is asked in one call is what it is in many."""

    def test_gains_of_many_views_are_those_of_each(self):
        grid = vantage.Grid(np.zeros((40, 40, 20)), (0, 0, 0), 0.1)
        places = np.random.default_rng(5).uniform(0.5, 3.5, (300, 3)) * [1, 1, 0.4]
        # The views of a place are not next to each other.
        views = np.vstack([np.column_stack([places, np.full(300, yaw)]) for yaw in (0.0, 0.7, 1.4)])
        sensor = {"range_max_m": 1.5}
        for gain in ("beer_lambert", "average_entropy"):
            all_at_once = vantage.gains(grid, views, sensor, gain)
            by_place = np.array([vantage.gains(grid, views[i::300], sensor, gain) for i in range(300)])
            np.testing.assert_array_equal(all_at_once, by_place.T.ravel())


if __name__ == "__main__":
    unittest.main()
