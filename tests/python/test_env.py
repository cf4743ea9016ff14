"""Environments: what Gymnasium documents of them, seeds, endings."""

import functools
import subprocess
import sys
import tempfile
import unittest
from copy import deepcopy

import numpy as np
import vantage
from support import SMALL

make = functools.partial(vantage.Env, "tabletop", **SMALL)
COLUMN = {name: i for i, name in enumerate(vantage.env.COLUMNS)}

#: With a stand-in for Gymnasium 1.x: that it is used, and what check_env asserts of the seeds.
AS_GYMNASIUM = """
import sys, types

class Base:
    metadata, render_mode, spec = {"render_modes": []}, None, None
    _np_random = _np_random_seed = None

gymnasium = types.ModuleType("gymnasium")
gymnasium.Env, gymnasium.made = Base, {}
gymnasium.register = lambda id, **how: gymnasium.made.update({id: how})
sys.modules["gymnasium"] = gymnasium
import vantage
assert "vantage/tabletop-v0" in gymnasium.made and issubclass(vantage.Env, Base)
with vantage.Env("tabletop", scans=2, map={"cells": [33, 33, 17]}, laser={"scan_duration_s": 1}) as env:
    env.reset(seed=123)
    assert env.unwrapped._np_random is not None
"""


def assert_equal(case, one, other):
    case.assertEqual(one.keys(), other.keys())
    for name in one:
        np.testing.assert_array_equal(one[name], other[name], err_msg=name)


def play(env, seed, choose):
    """All steps of an episode: (observation, reward, terminated, truncated, info)."""
    steps = [(*env.reset(seed=seed),)]
    while len(steps) == 1 or not (steps[-1][2] or steps[-1][3]):
        steps.append(env.step(choose(steps[-1])))
    return steps


class Environments(unittest.TestCase):
    def test_have_what_gymnasium_asks_for(self):
        with make(render_mode="rgb_array") as env:
            self.assertIn("rgb_array", env.metadata["render_modes"])
            self.assertIs(env.unwrapped, env)
            observation, info = env.reset(seed=5)
            self.assertIsInstance(info, dict)
            self.assertTrue(env.observation_space.contains(observation))
            env.action_space.seed(1)
            action = env.action_space.sample(info["action_mask"])
            self.assertTrue(env.action_space.contains(action))
            answer = env.step(action)
            self.assertEqual(len(answer), 5)
            observation, reward, terminated, truncated, info = answer
            self.assertTrue(env.observation_space.contains(observation))
            self.assertIsInstance(reward, float)
            self.assertIs(type(terminated), bool)
            self.assertIs(type(truncated), bool)
            picture = env.render()
            self.assertEqual((picture.dtype, picture.ndim, picture.shape[2]), (np.uint8, 3, 3))
            self.assertGreater(picture.std(), 5)
            self.assertFalse(hasattr(env, "reward_range"))  # of Gymnasium before 1.0
            for wrong in (-1, 30, 1.5, "x", None):
                with self.assertRaises(vantage.BadDecision):
                    env.step(wrong)

    def test_seed_their_generator_as_gymnasium_checks(self):
        with make() as env:
            env.reset(seed=123)
            self.assertEqual(env.unwrapped._np_random_seed, 123)
            before = deepcopy(env.unwrapped._np_random)
            self.assertIsNotNone(before)
            env.reset(seed=123)
            self.assertEqual(env.unwrapped._np_random.bit_generator.state, before.bit_generator.state)
            env.reset(seed=456)
            self.assertNotEqual(env.unwrapped._np_random.bit_generator.state, before.bit_generator.state)
            self.assertEqual(env.np_random_seed, 456)
            own = np.random.default_rng(7)
            env.np_random = own
            env.reset()  # draws on
            self.assertIs(env.np_random, own)
            self.assertEqual(env.np_random_seed, -1)
        self.assertEqual(make(seed=5).np_random_seed, 5)

    def test_are_of_gymnasium_where_it_is(self):
        subprocess.run([sys.executable, "-W", "error", "-c", AS_GYMNASIUM], check=True)

    def test_one_seed_gives_one_episode_step_by_step(self):
        rng = np.random.default_rng(0)
        actions = [int(rng.integers(30)) for _ in range(3)]
        runs = []
        with make() as one, make() as other:
            for env in (one, other):
                env.reset(seed=9)  # of another episode before
                runs.append(play(env, 4, lambda step, left=iter(actions): next(left)))
            third = play(one, 6, lambda step, left=iter(actions): next(left))
        self.assertEqual(len(runs[0]), 4)
        for a, b in zip(*runs):
            assert_equal(self, a[0], b[0])
            self.assertEqual(a[1:4] if len(a) > 2 else (), b[1:4] if len(b) > 2 else ())
        self.assertEqual(runs[0][-1][4]["metrics"]["state_hash"], runs[1][-1][4]["metrics"]["state_hash"])
        self.assertFalse(np.array_equal(runs[0][1][0]["map"], third[1][0]["map"]))

    def test_rewards_add_up_to_what_is_seen(self):
        with make(time_cost_per_s=0.001) as env:
            first, begun = env.reset(seed=1)
            steps = play(env, 1, lambda step: int(np.argmax(step[0]["candidates"][:, COLUMN["gain"]])))
        seen = begun["unobserved_share"] - steps[-1][4]["unobserved_share"]
        took_s = steps[-1][4]["time_s"] - begun["time_s"]
        self.assertAlmostEqual(sum(step[1] for step in steps[1:]), seen - 0.001 * took_s, places=9)
        self.assertGreater(seen, 0.2)

    def test_limits_truncate(self):
        with make() as env:
            *_, terminated, truncated, info = play(env, 2, lambda step: 7)[-1]
            self.assertEqual((terminated, truncated), (False, True))
            self.assertEqual(info["metrics"]["reason"], "limit of 4 scans")
            with self.assertRaisesRegex(vantage.Error, "reset"):
                env.step(0)
            env.reset(options={"budget": {"time_s": 40}, "scans": 30})
            *_, terminated, truncated, info = play(env, 2, lambda step: int(
                np.argmax(np.prod(step[0]["candidates"][:, [COLUMN["gain"], COLUMN["open"]]], axis=1))))[-1]
            self.assertTrue(truncated)

    def test_seeds_count_up_without_one(self):
        with make() as env:
            env.reset(seed=7)
            again, _ = env.reset()
            eighth, _ = env.reset(seed=8)
        assert_equal(self, again, eighth)

    def test_rows_that_are_not_open_change_nothing(self):
        with make(max_candidates=32, max_invalid=3) as env:
            before, info = env.reset(seed=1)
            self.assertEqual(info["action_mask"].sum(), 30)
            for i in range(3):
                after, reward, terminated, truncated, info = env.step(31)
                self.assertEqual((reward, terminated, truncated), (0.0, False, i == 2))
                self.assertTrue(info["invalid_action"])
                assert_equal(self, before, after)

    def test_open_views_are_kept_where_there_are_more_than_rows(self):
        class Request:
            gain, interval = np.arange(5.0), np.zeros((5, 2))
            gain_unit, views = "bits", np.zeros((5, 5))
            travel_s = path_length_m = np.full(5, np.inf)

            def __init__(self, *open_views):
                self.exhausted = ~np.isin(np.arange(5), open_views)

            def __len__(self):
                return 5

        env = make(max_candidates=2)
        for open_views, gains, mask in (((1, 4), (1, 4), (1, 1)), ((3,), (0, 3), (0, 1)), ((), (0, 1), (1, 1)),
                                        (range(5), (0, 1), (1, 1))):
            rows = np.zeros((2, len(COLUMN)), np.float32)
            request = Request(*open_views)
            env._fill(rows, request)
            np.testing.assert_array_equal(env._shown, gains)
            np.testing.assert_array_equal(rows[:, COLUMN["open"]], mask)
            shares = rows[:, COLUMN["gain"]]
            np.testing.assert_allclose(shares / shares.max(), np.divide(gains, max(gains)))

    def test_an_action_is_the_view_of_its_row(self):
        class Stepped:
            def answer(self, view):
                self.view = view
                raise InterruptedError

        with make(max_candidates=2) as env:
            env.reset(seed=1)
            env._shown, env._stepped = np.array([3, 9]), Stepped()
            with self.assertRaises(InterruptedError):
                env.step(1)
            self.assertEqual(env._stepped.view, 9)

    def test_candidates_carry_the_interval_of_their_gain(self):
        asked = []

        def look(request):
            asked.append((request.gain, request.interval, request.travel_s))
            return 3

        cells = np.prod(SMALL["map"]["cells"])
        with tempfile.TemporaryDirectory() as folder:
            vantage.run("tabletop", planner=look, out=folder, overwrite=True, lean=True, seed=3, **SMALL)
        with make() as env:
            for (observation, *_), (gain, interval, travel_s) in zip(play(env, 3, lambda step: 3), asked):
                table = observation["candidates"]
                np.testing.assert_allclose(table[:, COLUMN["gain"]], gain / cells, rtol=1e-6)
                np.testing.assert_allclose(table[:, COLUMN["interval_low"]], interval[:, 0] / cells, rtol=1e-6)
                np.testing.assert_allclose(table[:, COLUMN["interval_high"]], interval[:, 1] / cells, rtol=1e-6)
                np.testing.assert_allclose(table[:, COLUMN["travel_s"]],
                                           np.where(np.isfinite(travel_s), travel_s, -1), rtol=1e-6)
        with make(gain="simple", scans=2) as env:  # forecasts nothing
            table = env.reset(seed=3)[0]["candidates"]
            self.assertTrue((table[:, [COLUMN["interval_low"], COLUMN["interval_high"]]] == -1).all())
            self.assertTrue((table[:, COLUMN["gain"]] > 0).any())

    def test_a_wrong_argument_is_named_with_its_value(self):
        for message, keys in {
            "render_mode: 'human'": {"render_mode": "human"},
            "max_candidates: 0 is below 1": {"max_candidates": 0},
            "max_candidates: 'x' is not a whole": {"max_candidates": "x"},
            "max_invalid: 0 is below 1": {"max_invalid": 0},
            "max_invalid: 1.5 is not a whole": {"max_invalid": 1.5},
            r"blocks: \(2, 2\) is not three": {"blocks": (2, 2)},
            "blocks: 3 is not three": {"blocks": 3},
            r"blocks: \(4, 0, 4\) is not three whole numbers, each at least 1": {"blocks": (4, 0, 4)},
            r"blocks: \(34, 4, 4\) is more than the map's \(33, 33, 17\)": {"blocks": (34, 4, 4)},
            "time_cost_per_s: nan is not a finite": {"time_cost_per_s": np.nan},
            "time_cost_per_s: 'x' is not a finite": {"time_cost_per_s": "x"},
            "choice: oracle asks ground truth": {"choice": "oracle"},
            "scans: 0": {"scans": 0},
            "unknown key 'scanz'": {"scanz": 1},
        }.items():
            with self.assertRaisesRegex(vantage.ConfigError, message):
                make(**keys)
        with self.assertRaisesRegex(vantage.ConfigError, "name: 3 is not a name"):
            vantage.Env(3)
        with make() as env:
            for message, keys in {
                "seed: 1.5 is not a whole": {"seed": 1.5},
                "seed: 'x' is not a whole": {"seed": "x"},
                "seed: -1 is below 0": {"seed": -1},
                r"options: \[1\] is not a dict": {"options": [1]},
                "choice: oracle asks ground truth": {"options": {"choice": "oracle"}},
                r"blocks: \(16, 16, 8\) is more than the map's \(9, 9, 9\)": {"options": {"map": {"cells": [9, 9, 9]}}},
            }.items():
                with self.assertRaisesRegex(vantage.ConfigError, message):
                    env.reset(**keys)

    def test_gains_are_shares_of_the_map_that_is_reset(self):
        with make() as env:
            small, _ = env.reset(seed=1)
            large, _ = env.reset(seed=1, options={"map": {"cells": [66, 66, 34]}})
        ratio = large["candidates"][:, COLUMN["gain"]].max() / small["candidates"][:, COLUMN["gain"]].max()
        self.assertLess(abs(np.log(ratio)), np.log(2))  # and not 8

    def test_keys_of_a_reset_leave_the_others_beside_them(self):
        with make() as env:
            before, _ = env.reset(seed=1)
            after, _ = env.reset(seed=1, options={"laser": {"noise_sigma_m": 0.02}})
            self.assertEqual(after["state"][5], before["state"][5], "as long a scan")
            with self.assertRaisesRegex(vantage.ConfigError, "seed"):
                env.reset(options={"seed": 5})

    def test_a_reset_that_fails_shows_nothing_of_the_episode_before(self):
        with make() as env:
            env.reset(seed=1)
            with self.assertRaisesRegex(vantage.Error, "before its first decision: scan 1 shows nothing"):
                env.reset(seed=2, options={"faults": {"dropped_frames": 1}})
            with self.assertRaisesRegex(vantage.Error, "reset"):
                env.step(0)

    def test_what_cannot_be_is_told(self):
        with self.assertRaisesRegex(vantage.ConfigError, "does not choose among views"):
            vantage.Env("trajectory")
        with make() as env:
            with self.assertRaisesRegex(vantage.Error, "reset"):
                env.step(0)
            with self.assertRaises(vantage.ConfigError):
                env.reset(options={"scans": 0})
            env.reset(seed=1)  # and goes on

    def test_exploration_ends_when_there_is_no_more(self):
        with vantage.Env("office_small", blocks=(8, 8, 4), map={"cells": [60, 60, 12]}, scans=2) as env:
            observation, info = env.reset(seed=1)
            self.assertTrue(env.observation_space.contains(observation))
            *_, terminated, truncated, info = env.step(env.action_space.sample(info["action_mask"]))
            self.assertTrue(truncated)


if __name__ == "__main__":
    unittest.main()
