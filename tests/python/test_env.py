"""Environments: what Gymnasium documents of them, seeds, endings, several at once."""

import functools
import unittest

import numpy as np
import vantage
from support import SMALL

make = functools.partial(vantage.Env, "tabletop", **SMALL)


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
            for wrong in (-1, 30, 1.5, "x", None):
                with self.assertRaises(vantage.BadDecision):
                    env.step(wrong)

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
            steps = play(env, 1, lambda step: int(np.argmax(step[0]["candidates"][:, 0])))
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
                np.argmax(step[0]["candidates"][:, 0] * step[0]["candidates"][:, 8])))[-1]
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

    def test_what_cannot_be_is_told(self):
        for keys in ({"render_mode": "human"}, {"max_candidates": 0}, {"scans": 0}):
            with self.assertRaises(vantage.ConfigError):
                make(**keys)
        with self.assertRaisesRegex(vantage.ConfigError, "does not choose among views"):
            vantage.Env("trajectory")
        with make() as env:
            with self.assertRaisesRegex(vantage.Error, "reset"):
                env.step(0)
            with self.assertRaises(vantage.ConfigError):
                env.reset(seed=-1)
            with self.assertRaisesRegex(vantage.ConfigError, "ground truth"):
                env.reset(options={"choice": "oracle"})
            env.reset(seed=1)  # and goes on

    def test_exploration_ends_when_there_is_no_more(self):
        with vantage.Env("office_small", blocks=(8, 8, 4), map={"cells": [60, 60, 12]}, scans=2) as env:
            observation, info = env.reset(seed=1)
            self.assertTrue(env.observation_space.contains(observation))
            *_, terminated, truncated, info = env.step(env.action_space.sample(info["action_mask"]))
            self.assertTrue(truncated)


class Vectors(unittest.TestCase):
    def test_are_the_environments_side_by_side(self):
        with vantage.VectorEnv([make, make]) as both, make() as alone:
            observations, infos = both.reset(seed=3)
            self.assertTrue(both.observation_space.contains(observations))
            first, _ = alone.reset(seed=4)
            for name, values in first.items():
                np.testing.assert_array_equal(observations[name][1], values)
            for _ in range(3):
                observations, rewards, terminated, truncated, infos = both.step([1, 2])
                self.assertEqual(rewards.shape, (2,))
                first, reward, *_ = alone.step(2)
                np.testing.assert_array_equal(observations["map"][1], first["map"])
                self.assertEqual(rewards[1], reward)
            self.assertTrue(truncated.all())
            observations, rewards, terminated, truncated, infos = both.step([0, 0])  # the next episodes begin
            self.assertFalse(truncated.any() or rewards.any())
            self.assertTrue((observations["state"][:, 3] == 1).all())

    def test_tell_what_goes_wrong_in_one(self):
        with self.assertRaisesRegex(vantage.Error, "unknown key"):
            vantage.VectorEnv([functools.partial(vantage.Env, "tabletop", scanz=1)])
        with self.assertRaises(vantage.ConfigError):
            vantage.VectorEnv([])


if __name__ == "__main__":
    unittest.main()
