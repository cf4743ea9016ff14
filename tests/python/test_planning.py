"""The planning library from Python: known answers, arrays without copies, errors."""

import threading
import time
import unittest

import numpy as np
import vantage
from support import SOURCE, InFolder, room

SENSOR = {"half_width_rad": 0.5, "tilt_min_rad": -0.4, "tilt_max_rad": 0.6, "range_min_m": 0.1, "range_max_m": 5.0}


class Grids(InFolder):
    def test_arrays_are_the_grids_own_memory(self):
        grid = room()
        odds = grid.log_odds
        self.assertEqual(odds.shape, (40, 40, 20))
        self.assertTrue(odds.flags.f_contiguous)
        before = grid.count(vantage.OCCUPIED)
        odds[0, 0, 19] = 5.0
        self.assertEqual(grid.count(vantage.OCCUPIED), before + 1)
        self.assertEqual(grid.states()[0, 0, 19], vantage.OCCUPIED)
        del grid
        self.assertEqual(odds[0, 0, 19], 5.0)  # kept alive by its view

    def test_cells_are_indexed_x_y_z(self):
        p = np.full((3, 4, 5), 0.5)
        p[2, 1, 4] = 0.9
        for order in "CF":
            grid = vantage.Grid.from_probabilities(np.array(p, order=order))
            np.testing.assert_allclose(grid.probabilities(), p, atol=1e-6)
            self.assertEqual(grid.shape, (3, 4, 5))

    def test_files_are_read_back(self):
        grid = room()
        for name in ("map.bt", "map.ot"):
            grid.write(self.folder / name)
            back = vantage.OctoMap(self.folder / name)
            self.assertAlmostEqual(back.resolution_m, 0.1)
            self.assertEqual(back.occupied, grid.count(vantage.OCCUPIED))
            np.testing.assert_allclose(back.known_m, [[-2, -2, 0], [2, 2, 1]], atol=1e-9)
        np.testing.assert_array_equal(back.grid().states(), grid.states()[:, :, :10])
        self.assertEqual(back.grid(coarsen=2).shape, (20, 20, 5))

    def test_shares_sum_to_one(self):
        shares = room().shares((5, 4, 3))
        self.assertEqual(shares.shape, (3, 5, 4, 3))
        np.testing.assert_allclose(shares.sum(axis=0), 1.0, atol=1e-6)
        whole = room().shares((1, 1, 1)).ravel() * 32000
        with self.assertRaisesRegex(vantage.ConfigError, r"blocks: \(41, 1, 1\) is not from 1 to the \(40, 40, 20\)"):
            room().shares((41, 1, 1))
        np.testing.assert_allclose(whole, [room().count(i) for i in range(3)], rtol=1e-5)

    def test_as_many_blocks_as_a_long_grid_has_cells(self):
        shares = vantage.Grid(np.zeros((65536, 1, 1))).shares((65536, 1, 1))
        np.testing.assert_allclose(shares.sum(axis=0), 1.0, atol=1e-6)

    def test_edges_of_cells_are_one_number_or_three(self):
        for edge in (0.5, np.float32(0.5), np.array(0.5), (0.5, 0.5, 0.5)):
            np.testing.assert_array_equal(vantage.Grid(np.zeros((2, 2, 2)), (0, 0, 0), edge).cell_size_m, 0.5)

    def test_bad_grids_are_refused(self):
        for bad in (np.zeros((0, 1, 1)), np.zeros((2, 2)), np.full((2, 2, 2), np.nan)):
            with self.assertRaises(vantage.ConfigError):
                vantage.Grid(bad)
        for edge in (0.0, -1.0, np.nan, np.inf):
            with self.assertRaisesRegex(vantage.ConfigError, "cell_size_m"):
                vantage.Grid(np.zeros((2, 2, 2)), (0, 0, 0), edge)
        for edge in ((0.1, 0.1), "wide"):
            with self.assertRaisesRegex(vantage.ConfigError, "cell_size_m: neither a number nor three"):
                vantage.Grid(np.zeros((2, 2, 2)), (0, 0, 0), edge)
        with self.assertRaisesRegex(vantage.ConfigError, "no probability"):
            vantage.Grid.from_probabilities(np.full((2, 2, 2), 1.5))
        with self.assertRaisesRegex(vantage.InputError, "missing.ot"):
            vantage.Grid.read(self.folder / "missing.ot")


class Gains(unittest.TestCase):
    def setUp(self):
        self.grid = room()
        self.views = vantage.ring_of_views((0, 0, 0), radius_m=2.5, positions=5, height_m=1.0)

    def test_swept_is_near_exact_for_each_gain(self):
        for name in vantage.strategies("gains"):
            transmission = 0.97 if name == "adaptive" else None
            worth = vantage.gains(self.grid, self.views, SENSOR, name, transmission)
            self.assertEqual(worth.shape, (15,))
            exact = vantage.gains(self.grid, self.views, SENSOR, name, transmission, "exact")
            np.testing.assert_allclose(worth, exact, rtol=0.05, err_msg=name)

    def test_an_open_cell_in_sight_counts_one_bit(self):
        odds = np.full((3, 3, 3), -3.0)
        odds[1, 1, 1] = 0.0
        grid = vantage.Grid(odds, (0, 0, 0), 1.0)
        view = [[-2.0, 1.5, 1.5, 0.0]]
        self.assertAlmostEqual(vantage.gains(grid, view, SENSOR, "simple", method="exact")[0], 1.0)
        away = [[-2.0, 1.5, 1.5, np.pi]]
        self.assertEqual(vantage.gains(grid, away, SENSOR, "simple", method="exact")[0], 0.0)

    def test_poses_and_matrices_are_the_same_views(self):
        x, y, z, yaw, pitch = self.views[4]
        c, s, d, e = np.cos(yaw), np.sin(yaw), np.cos(pitch), np.sin(pitch)
        T = np.array([[c * d, -s, c * e, x], [s * d, c, s * e, y], [-e, 0, d, z], [0, 0, 0, 1.0]])
        np.testing.assert_allclose(vantage.gains(self.grid, T[None], SENSOR)[0],
                                   vantage.gains(self.grid, self.views[4:5], SENSOR)[0], rtol=1e-4)
        with self.assertRaisesRegex(vantage.ConfigError, "no rigid transform"):
            vantage.gains(self.grid, 2 * T[None], SENSOR)

    def test_threads_change_nothing(self):
        one = vantage.gains(self.grid, self.views, SENSOR, threads=1)
        np.testing.assert_array_equal(one, vantage.gains(self.grid, self.views, SENSOR, threads=3))

    def test_own_gain_is_beer_lambert_where_its_cells_are(self):
        states = self.grid.states()
        utility = (states == vantage.UNOBSERVED).astype(float)
        transmission = np.choose(states, [1.0, 0.98, 0.0])
        own = vantage.own_gains(self.grid, self.views, utility, transmission, SENSOR)
        built_in = vantage.gains(self.grid, self.views, SENSOR, {"name": "beer_lambert", "a": 0.98}, method="exact")
        np.testing.assert_allclose(own, built_in, rtol=1e-5)

    def test_ranks_best_first(self):
        order, worth = vantage.rank_views(self.grid, self.views, sensor=SENSOR)
        self.assertTrue(np.all(np.diff(worth[order]) <= 0))

    def test_errors_name_argument_key_and_value(self):
        for message, call in {
            "gain.a: -1": lambda: vantage.gains(self.grid, self.views, SENSOR, {"name": "beer_lambert", "a": -1}),
            "unknown gain 'simpel'": lambda: vantage.gains(self.grid, self.views, SENSOR, "simpel"),
            "unknown key 'range'": lambda: vantage.gains(self.grid, self.views, {"range": 1}),
            "views: shape": lambda: vantage.gains(self.grid, self.views[:, :3]),
            "views: nan": lambda: vantage.gains(self.grid, [[np.nan, 0, 0, 0]]),
            "threads: 0": lambda: vantage.gains(self.grid, self.views, threads=0),
            "transmission": lambda: vantage.gains(self.grid, self.views, gain="adaptive"),
            "gain.a: expected a number, got a list": lambda: vantage.gains(
                self.grid, self.views, gain={"name": "beer_lambert", "a": np.ones(3)}),
            "gain.a: a complex is no option": lambda: vantage.gains(
                self.grid, self.views, gain={"name": "beer_lambert", "a": 1j}),
            "cannot be swept": lambda: vantage.gains(self.grid, self.views, gain="average_entropy", method="swept"),
        }.items():
            with self.assertRaisesRegex(vantage.ConfigError, message):
                call()
        self.assertTrue(issubclass(vantage.ConfigError, ValueError))
        self.assertTrue(issubclass(vantage.ConfigError, vantage.Error))

    def test_other_threads_run_meanwhile(self):
        grid = vantage.Grid(np.zeros((150, 150, 100)), (-3, -3, 0), 0.04)
        views = vantage.ring_of_views((0, 0, 0), radius_m=4.0, positions=10, yaw_offsets_rad=[0.0])
        spans = []

        def score():
            start = time.monotonic()
            vantage.gains(grid, views, SENSOR, method="exact")
            spans.append((start, time.monotonic()))

        worker = threading.Thread(target=score)
        worker.start()
        ticks = 0
        while worker.is_alive():
            ticks += 1
            time.sleep(0.001)
        start, end = spans[0]
        self.assertGreater(ticks, 5, f"in {end - start} s")


class Views(InFolder):
    def test_frontiers_are_where_free_meets_unobserved(self):
        frontiers = vantage.find_frontiers(room(), min_cells=5, height_m=0.55)
        states = room().states()
        self.assertTrue(frontiers)
        for x, y, z in frontiers[0]["cells"]:
            self.assertEqual(states[x, y, z], vantage.FREE)

    def test_sampled_views_stand_free(self):
        room().write(self.folder / "map.ot")
        octomap = vantage.OctoMap(self.folder / "map.ot")
        views = vantage.sample_views(octomap, seed=2, positions=5, headings=3)
        self.assertEqual(views.shape, (15, 5))
        np.testing.assert_array_equal(views, vantage.sample_views(octomap, seed=2, positions=5, headings=3))
        order, worth = vantage.rank_views(octomap, views, gain="simple")
        self.assertEqual(sorted(order), list(range(15)))


class Distances(unittest.TestCase):
    def test_a_block_is_as_far_as_it_is(self):
        field = vantage.DistanceField(room(), reach_m=3.0)
        self.assertAlmostEqual(field.distance_m([[0.0, 0.0, 1.35]])[0], 0.55, delta=0.08)
        self.assertLess(field.distance_m([0.0, 0.0, 0.4])[0], 0.0)
        np.testing.assert_allclose(field.gradient([[0.0, 0.0, 1.2]])[0], [0, 0, 1], atol=0.1)
        self.assertFalse(field.at_centres_m.flags.writeable)

    def test_ways_go_round_walls(self):
        floor = np.zeros((80, 80), np.uint8)
        floor[40, 10:] = vantage.OCCUPIED
        ways = vantage.Ways(floor, (1.0, 3.0, 0.0), cell_m=0.05, footprint_radius_m=0.1)
        waypoints, length_m, reached = ways.path((3.0, 3.0, 0.0))
        self.assertTrue(reached)
        self.assertGreater(length_m, 5.0)
        self.assertLess(waypoints[:, 1].min(), 0.5)
        np.testing.assert_allclose(waypoints[-1], [3.0, 3.0, 0.0])
        self.assertAlmostEqual(ways.lengths_m([[3.0, 3.0, 0.0]])[0], length_m)
        between = ways.lengths_between_m([[1.0, 3.0], [3.0, 3.0]])
        np.testing.assert_allclose(between, between.T)
        self.assertFalse(ways.reachable[40, 40])


class Tours(unittest.TestCase):
    def test_the_tour_takes_what_is_near_first(self):
        travel = np.abs(np.subtract.outer([1.0, 2.0, 30.0, 0.0], [1.0, 2.0, 30.0]))
        problem = vantage.ViewProblem([5, 5, 5], np.eye(3), [[1, 0], [2, 0], [30, 0]], travel, scan_s=1.0)
        np.testing.assert_allclose(problem.gains, 5.0)
        for choice in ("tour", "information_rate", "receding_horizon", "two_level_tour"):
            self.assertEqual(vantage.plan_views(problem, choice)[0], 0, choice)
        self.assertEqual(vantage.plan_views(problem, "tour"), [0, 1, 2])
        short = vantage.ViewProblem([5, 5, 5], np.eye(3), [[1, 0], [2, 0], [30, 0]], travel, 1.0, time_left_s=5.0)
        self.assertEqual(vantage.plan_views(short, "tour"), [0, 1])

    def test_shortest_route_by_brute_force(self):
        import itertools
        costs = np.random.default_rng(3).uniform(1, 9, (7, 6))

        def length(order):
            return costs[6, order[0]] + sum(costs[a, b] for a, b in zip(order, order[1:]))

        best = min(itertools.permutations(range(6)), key=length)
        self.assertEqual(vantage.shortest_route(costs), list(best))

    def test_intervals_of_forecasts(self):
        # At 0.0517 of the first view ln(actual / forecast) has mean 0.106 and spread 0.190; of the 20 errors in
        # training the ceil(0.9 * 21) = 19th is 2.21 spreads. A few cells (0.001 of the first view) are as good as none.
        interval = vantage.ForecastInterval(confidence=0.9, rate=0.03)
        interval.start(100_000)
        wanted = 5270 * np.exp([0.106 - 2.21 * 0.190, 0.106 + 2.21 * 0.190]) - 100
        np.testing.assert_allclose(interval.of(5170), wanted, rtol=1e-12)
        several = interval.of([[0, 5170, 1e5], [1, 2, 3]])
        self.assertEqual(several.shape, (2, 3, 2))
        np.testing.assert_allclose(several[0, 1], wanted, rtol=1e-12)
        self.assertTrue((several[..., 0] <= several[..., 1]).all())
        # Far outside: the level moves to 0.927, the 21st of 21 errors is that one itself, and its truth the end.
        interval.observe(5170, 90_000)
        np.testing.assert_allclose(interval.of(5170)[1], 90_000, rtol=1e-9)
        np.testing.assert_allclose(interval.of(5170)[0], 5270 * np.exp(2 * 0.106) * 5270 / 90_100 - 100, rtol=1e-9)

    def test_intervals_refuse_what_cannot_be(self):
        with self.assertRaisesRegex(vantage.Error, "start"):
            vantage.ForecastInterval().of(1)
        with self.assertRaisesRegex(vantage.Error, "start"):
            vantage.ForecastInterval().observe(1, 1)
        interval = vantage.ForecastInterval()
        interval.start(1000)
        for message, call in {"confidence": lambda: vantage.ForecastInterval(confidence=2),
                              "unknown key 'x'": lambda: vantage.ForecastInterval(x=2),
                              "trained: 'hall' is neither": lambda: vantage.ForecastInterval("hall"),
                              "first_view_cells: 0": lambda: interval.start(0),
                              "first_view_cells: nan": lambda: interval.start(np.nan),
                              "forecast_cells: -1": lambda: interval.of([1, -1]),
                              "forecast_cells: inf": lambda: interval.observe(np.inf, 1),
                              "actual_cells: nan": lambda: interval.observe(1, np.nan)}.items():
            with self.assertRaisesRegex(vantage.ConfigError, message):
                call()

    def test_problems_on_maps(self):
        ways = vantage.Ways(np.zeros((120, 120), np.uint8), (-2.2, -2.2, 0), (-3, -3), footprint_radius_m=0.2)
        views = vantage.ring_of_views((0, 0, 0), radius_m=2.5, positions=5)
        problem = vantage.ViewProblem.on_map(room(), views, ways, sensor=SENSOR)
        self.assertEqual(problem.views, 15)
        self.assertEqual(problem.travel_s.shape, (16, 15))
        self.assertGreater(len(vantage.plan_views(problem)), 1)
        camera = {"half_width_rad": 0.5044, "tilt_min_rad": -0.3927, "tilt_max_rad": 0.3927,
                  "range_min_m": 0.8, "range_max_m": 3.5}
        np.testing.assert_array_equal(vantage.ViewProblem.on_map(room(), views, ways).gains,
                                      vantage.ViewProblem.on_map(room(), views, ways, sensor=camera).gains)
        for choice in ("rollout", "greedy", "no_such"):
            with self.assertRaises(vantage.ConfigError):
                vantage.plan_views(problem, choice)


class Trajectories(unittest.TestCase):
    path = np.column_stack([np.linspace(0, 5, 8), np.zeros(8), np.ones(8), np.zeros(8)])

    def test_every_method_goes_where_it_is_cheap(self):
        for method in vantage.strategies("optimisers"):
            found = vantage.optimise_trajectory(self.path, lambda q: 3 * (q[:, 1] - 1) ** 2, method, seed=2)
            self.assertLess(found["cost"], 0.8 * found["initial_cost"], method)
            np.testing.assert_array_equal(found["path"][[0, -1]], self.path[[0, -1]])
            self.assertGreater(found["path"][4, 1], 0.5, method)

    def test_the_built_in_cost_keeps_off_obstacles(self):
        path = np.column_stack([np.linspace(-1.9, 1.9, 9), np.full(9, 0.3), np.full(9, 0.6), np.zeros(9)])
        field = vantage.DistanceField(room())
        found = vantage.optimise_trajectory(path, vantage.FlightCost(field, body_radius_m=0.2), seed=1)
        self.assertGreater(field.distance_m(found["path"][:, :3])[1:-1].min(), 0.1)

    def test_bad_costs_are_told(self):
        for cost in (lambda q: 1.0, lambda q: np.full(8, np.nan), lambda q: "x", lambda q: np.zeros(3)):
            with self.assertRaisesRegex(vantage.ConfigError, "cost"):
                vantage.optimise_trajectory(self.path, cost)
        with self.assertRaisesRegex(vantage.ConfigError, "no finite cost"):
            vantage.optimise_trajectory(self.path, lambda q: np.zeros(8), sigma_m=[1e160] * 3)
        with self.assertRaises(ZeroDivisionError):
            vantage.optimise_trajectory(self.path, lambda q: 1 / 0)
        with self.assertRaises(TypeError):
            vantage.optimise_trajectory(self.path, 3)
        with self.assertRaisesRegex(vantage.ConfigError, "stomp has no key 'rollout'; did you mean rollouts"):
            vantage.optimise_trajectory(self.path, lambda q: np.zeros(8), rollout=3)


class Information(unittest.TestCase):
    def test_known_answers(self):
        self.assertEqual(vantage.entropy_bits([0.25] * 4), 2.0)
        self.assertEqual(vantage.mutual_information_bits(np.eye(2) / 2), 1.0)
        self.assertEqual(vantage.joint_entropy_bits(np.full((2, 2), 0.25)), 2.0)
        self.assertEqual(vantage.conditional_entropy_bits(np.full((2, 2), 0.25)), 1.0)
        self.assertEqual(vantage.kl_divergence_bits([1.0, 0.0], [0.5, 0.5]), 1.0)
        self.assertEqual(vantage.jeffreys_divergence_bits([0.5, 0.5], [0.5, 0.5]), 0.0)
        np.testing.assert_allclose(vantage.binary_entropy_bits([0.5, 0.0]), [1.0, 0.0])
        self.assertAlmostEqual(vantage.gaussian_kl_divergence_bits([1.0], [1.0], [0.0], [1.0]), 0.5 / np.log(2))
        apart = np.array([[0, np.inf], [np.inf, 0]])
        self.assertAlmostEqual(vantage.pairwise_information_bits([0.5, 0.5], apart), 1.0)

    def test_what_is_no_distribution_is_told(self):
        with self.assertRaisesRegex(vantage.DistributionError, "sums to"):
            vantage.entropy_bits([0.5, 0.6])


class Listing(unittest.TestCase):
    def test_says_what_there_is(self):
        self.assertIn("adaptive", vantage.strategies("gains"))
        self.assertEqual(vantage.strategies("choices")["tour"]["options"]["first_moves"], 8)
        self.assertTrue((SOURCE / "assets").samefile(vantage.data_root() + "/assets"))
        with self.assertRaises(vantage.ConfigError):
            vantage.strategies("x")


if __name__ == "__main__":
    unittest.main()
