"""Several environments at once: the same as one alone, and what goes wrong in one leaves the others be."""

import functools
import os
import signal
import unittest

import numpy as np
import vantage
from support import SMALL

make = functools.partial(vantage.Env, "tabletop", **SMALL)


class Fails(vantage.Env):
    """An environment with a fault in its step(), as another's may have."""

    def step(self, action):
        if action == 7:
            return {}["why"]
        if action == 8:
            os._exit(3)
        return super().step(action)


class Interrupts(vantage.Env):
    """Ctrl-C comes while its step is waited for."""

    def __init__(self, parent):
        super().__init__("tabletop", **SMALL)
        self.parent = parent

    def step(self, action):
        os.kill(self.parent, signal.SIGINT)
        return super().step(action)


fails = functools.partial(Fails, "tabletop", **SMALL)


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

    def test_a_wrong_call_moves_none_and_ends_none(self):
        with vantage.VectorEnv([make, make]) as both:
            with self.assertRaisesRegex(vantage.ConfigError, "environment 0: .*unknown key 'scanz'"):
                both.reset(options={"scanz": 1})
            both.reset(seed=3)
            for actions, message in (([3, 99], "environment 1: action 99 is not in"), ([3, -1], "environment 1"),
                                     ([0.5, 1], "not whole"), ([1, 2, 3], "shape"), ("ab", "shape"),
                                     ([[1], [1, 2]], "actions")):
                with self.assertRaisesRegex(vantage.BadDecision, message):
                    both.step(actions)
            for keys, message in (({"seed": 1.5}, "seed: 1.5"), ({"seed": [1, -2]}, r"seed\[1\]: -2"),
                                  ({"seed": [1]}, "seed: 1 of 2"), ({"options": [1]}, r"options: \[1\]"),
                                  ({"options": {"x": lambda: 1}}, "options: cannot be sent")):
                with self.assertRaisesRegex(vantage.ConfigError, message):
                    both.reset(**keys)
            observations, *_ = both.step([3, 4])
            np.testing.assert_array_equal(observations["state"][:, 3], [2, 2])  # scans: none was taken before

    def test_an_error_in_one_leaves_the_others_be(self):
        with vantage.VectorEnv([make, fails]) as both:
            both.reset(seed=3)
            with self.assertRaisesRegex(KeyError, "environment 1: 'why'") as raised:
                both.step([3, 7])
            self.assertIn('return {}["why"]', str(raised.exception.__cause__))
            observations, *_ = both.step([3, 4])
            np.testing.assert_array_equal(observations["state"][:, 3], [3, 2])
            for _ in range(2):  # a process that is gone is told of, each time
                with self.assertRaisesRegex(vantage.Error, "environment 1: its process died"):
                    both.step([3, 8])
        for call in (lambda: both.step([3, 4]), both.reset):
            with self.assertRaisesRegex(vantage.Error, "closed"):
                call()
        both.close()

    def test_ctrl_c_closes_them(self):
        with vantage.VectorEnv([make, functools.partial(Interrupts, os.getpid())]) as both:
            both.reset(seed=1)
            with self.assertRaises(KeyboardInterrupt):
                both.step([3, 4])
            self.assertTrue(both.closed)
            with self.assertRaisesRegex(vantage.Error, "closed"):
                both.reset()

    def test_tell_what_goes_wrong_in_one(self):
        with self.assertRaisesRegex(vantage.ConfigError, "environment 0: .*unknown key"):
            vantage.VectorEnv([functools.partial(vantage.Env, "tabletop", scanz=1)])
        with self.assertRaisesRegex(vantage.ConfigError, "makers"):
            vantage.VectorEnv([])


if __name__ == "__main__":
    unittest.main()
