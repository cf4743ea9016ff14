"""Random calls of what takes longer than a call of the library: environments, whole episodes of seconds, recognition
and training. An answer or an error of ours, no crash, no hang; threads end, and memory does not grow.
VANTAGE_FUZZ_EPISODES asks for more, VANTAGE_FUZZ_SEED for others."""

import ctypes
import faulthandler
import gc
import os
import subprocess
import unittest
import warnings

import numpy as np
import vantage
from support import BINARY, InFolder
from test_fuzz import KNOWN, SEED, Arguments, resident_kb

CALLS = int(os.environ.get("VANTAGE_FUZZ_EPISODES", "120"))
TINY = {"scans": 2, "map": {"cells": [17, 17, 9]}, "laser": {"scan_duration_s": 0.5}}


def held_kb():
    """Without what is free already, which each thread keeps some of."""
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    return resident_kb()


class PlannerFault(Exception):
    """What a planner of the test raises."""


class Draws(Arguments):
    """Random arguments of environments and episodes that end soon, whatever is drawn."""

    def keys(self):
        keys = dict(TINY)
        if self.rng.random() < 0.6:
            key, draw = self.rng.choice([
                ("scans", lambda: self.rng.choice([1, 2, 3, 0, -1, 1.5, "x", None, [1]])),
                ("map", lambda: {"cells": self.any(1)}), ("map", lambda: self.any(1)), ("gain", self.any),
                ("gain", lambda: self.rng.choice(list(vantage.strategies("gains")))),
                ("choice", lambda: self.rng.choice(list(vantage.strategies("choices")))), ("choice", self.any),
                ("budget", lambda: {"time_s": self.number()}), ("robot", self.any), ("candidates", self.any),
                ("intervals", lambda: {"confidence": self.any(1)}), ("faults", self.any), ("x" * 40, self.any),
                ("max_candidates", self.any), ("seed", self.any), ("blocks", self.any)])
            keys[key] = draw()
        return keys

    def name(self):
        return "tabletop" if self.rng.random() < 0.9 else self.any()

    def action(self):
        return self.rng.randrange(30) if self.rng.random() < 0.8 else self.any()

    def planner(self):
        def planner(request):
            if self.rng.random() < 0.2:
                raise PlannerFault
            if self.rng.random() < 0.3:
                return (*request.pose[:2], self.number())
            return self.action()

        return planner if self.rng.random() < 0.9 else self.any()


def threads():
    return len(os.listdir("/proc/self/task"))


class Fuzz(InFolder):
    def setUp(self):
        super().setUp()
        faulthandler.dump_traceback_later(800 + 3 * CALLS, exit=True)
        self.addCleanup(faulthandler.cancel_dump_traceback_later)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)  # what is written without a path is written here
        self.made = Draws(SEED, self.folder)
        self.answered = 0
        self.made_envs = []
        self.addCleanup(self.close_all)

    def call(self, function, *given, known=(vantage.Error, PlannerFault), **named):
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                answer = function(*given, **named)
        except known:
            return None
        self.answered += 1
        return answer

    def make(self):
        keys = self.made.keys()
        for name in ("blocks", "max_candidates", "max_invalid", "time_cost_per_s", "render_mode"):
            if self.made.rng.random() < 0.1:
                keys[name] = self.made.any()
        keys.setdefault("blocks", (4, 4, 4))
        env = self.call(vantage.Env, self.made.name(), **keys)
        if env is not None:
            self.made_envs.append(env)
        return env

    def close_all(self):
        for env in self.made_envs:
            env.close()

    def use(self, env):
        rng = self.made.rng
        kind = rng.random()
        if env._done and kind < 0.5:
            self.call(env.reset, seed=rng.randrange(9))
        elif kind < 0.2:
            seed = rng.randrange(9) if rng.random() < 0.8 else self.made.any()
            options = None if rng.random() < 0.6 else self.made.keys() if rng.random() < 0.7 else self.made.any()
            self.call(env.reset, seed=seed, options=options)
        elif kind < 0.9:
            self.call(env.step, self.made.action())
        else:
            self.call(env.render if kind < 0.96 else env.close)

    def run_one(self):
        wrong = self.made.rng.choice([3, [], object(), "/dev/null/x"])
        out = self.folder / "run" if self.made.rng.random() < 0.8 else wrong
        named = {"planner": self.made.planner(), "out": out, "overwrite": self.made.rng.random() < 0.8,
                 "lean": self.made.rng.random() < 0.8, **self.made.keys()}
        named.pop("blocks", None)
        run = self.call(vantage.run, self.made.name(), **named)
        if run is not None:
            self.assertIn(run.metrics["status"], ("completed", "failed", "diverged"))

    def test_environments_and_runs(self):
        with vantage.Env("tabletop", blocks=(4, 4, 4), **TINY) as env:  # begins the pools of the libraries
            env.reset()
        begun, env, early_kb = threads(), None, 0
        for i in range(CALLS):
            kind = self.made.rng.random()
            if env is None or kind < 0.1:
                env = self.make() or env
            elif kind < 0.2:
                self.run_one()
            else:
                self.use(env)
            if i == CALLS // 3:
                early_kb = held_kb()
        self.close_all()
        self.assertGreater(self.answered, CALLS // 4)  # it got past the checks
        self.assertLessEqual(threads(), begun)
        self.assertLess(held_kb() - early_kb, 80_000)


class Recognition(Fuzz):
    @classmethod
    def setUpClass(cls):
        import tempfile
        from pathlib import Path
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        dataset = Path(holder.name) / "objects"
        subprocess.run([BINARY, "dataset", "render", str(dataset), "-q", "--set", "objects=2", "--set", "step_deg=40",
                        "--set", "supersampling=1"], check=True, stdout=subprocess.DEVNULL)
        cls.model = Path(holder.name) / "small.model"
        vantage.train(dataset, cls.model, features=["soft_colour", "standing_box"], transition_prior_moves=0)

    test_environments_and_runs = None

    def picture(self):
        made = self.made
        h, w = made.rng.choice([(40, 30), (40, 30), (1, 1), (0, 0), (7, 90)])
        rgb = made.numbers.integers(0, 256, (h, w, 3)).astype(np.uint8)
        depth = made.numbers.uniform(0.5, 1.5, (h, w))
        mask = made.numbers.random((h, w)) < made.rng.choice([0, 0.5, 1])
        given = [rgb, depth, mask]
        if made.rng.random() < 0.5:
            given[made.rng.randrange(3)] = made.any()
        return given

    def test_recognisers(self):
        known = (*KNOWN, vantage.Error)
        made, recogniser = self.made, vantage.Recogniser(self.model)
        for _ in range(3 * CALLS):
            kind = made.rng.random()
            if kind < 0.1:
                model = self.model if made.rng.random() < 0.5 else made.any()
                recogniser = self.call(vantage.Recogniser, model, known=known, seed=made.number(),
                                       recogniser=made.options() if made.rng.random() < 0.3 else None) or recogniser
            elif kind < 0.6:
                named = {name: made.any() for name in ("turned_rad", "elevation_rad", "focal_px", "centre_px")
                         if made.rng.random() < 0.15}
                self.call(recogniser.update, *self.picture(), known=known, **named)
            elif kind < 0.9:
                ask = made.rng.choice([recogniser.next_feature, recogniser.next_view])
                self.call(ask, *([made.any()] if made.rng.random() < 0.7 else []), known=known)
            else:
                recogniser.reset()
            self.assertAlmostEqual(recogniser.posterior.sum() + recogniser.p_unknown, 1.0)
        self.assertGreater(self.answered, CALLS // 4)

    def test_training_on_what_is_no_dataset(self):
        for _ in range(CALLS):
            dataset = self.folder if self.made.rng.random() < 0.3 else self.made.any()
            self.call(vantage.train, dataset, self.folder / "made.model", known=(*KNOWN, vantage.Error),
                      **{name: self.made.any() for name in ("threads", "progress", "feature_cache", "bins", "features")
                         if self.made.rng.random() < 0.2})
        self.assertEqual(self.answered, 0)
        self.assertFalse((self.folder / "made.model").exists())


if __name__ == "__main__":
    unittest.main()
