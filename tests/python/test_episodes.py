"""Episodes from Python: the same as from the command line, with planners of one's own, and read back."""

import os
import signal
import subprocess
import threading
import time
import unittest

import numpy as np
import vantage
from support import BINARY, SMALL, SMALL_FLAGS, SOURCE, InFolder


class Runs(InFolder):
    def run_small(self, name, **more):
        return vantage.run("tabletop", out=self.folder / name, **{**SMALL, **more})

    def test_are_those_of_the_command_line(self):
        for choice in ("greedy", "tour"):
            subprocess.run([BINARY, "run", str(SOURCE / "assets/episodes/tabletop.yaml"), "-q", *SMALL_FLAGS,
                            "--set", f"choice={choice}", "--out", str(self.folder / "cli"), "--lean", "--overwrite"],
                           check=True, stdout=subprocess.DEVNULL)
            wanted = vantage.load(self.folder / "cli").metrics["state_hash"]
            own = self.run_small("own", choice=choice, lean=True, overwrite=True)
            self.assertEqual(own.metrics["state_hash"], wanted)
            asked = self.run_small("asked", choice=choice, planner=lambda request: request.own_choice(), lean=True,
                                   overwrite=True)
            self.assertEqual(asked.metrics["state_hash"], wanted)

    def test_options_are_what_was_set(self):
        for seed in (0, 7, 2**63 - 1, 2**63, 2**64 - 1):
            read = vantage.episodes.episode("tabletop", seed=seed).options["seed"]
            self.assertEqual((read, type(read)), (seed, int))

    def test_a_copy_of_greedy_is_greedy(self):
        def greedy(request):
            open_views = np.flatnonzero(~request.exhausted)
            order = np.lexsort((open_views, request.path_length_m[open_views], -request.gain[open_views]))
            return open_views[order[0]]

        mine = self.run_small("mine", planner=greedy, lean=True)
        self.assertEqual(mine.metrics["state_hash"], self.run_small("own", lean=True).metrics["state_hash"])
        self.assertEqual(mine.metrics["method"], "greedy")

    def test_planners_see_what_the_robot_believes(self):
        seen = []

        def look(request):
            grid = request.grid
            worth = vantage.gains(grid, request.views, request.sensor, "adaptive", request.transmission)
            np.testing.assert_array_equal(worth, request.gain)
            self.assertEqual(len(request), 30)
            self.assertTrue(request.ways.reachable.any())
            lengths = request.ways.lengths_m(np.column_stack([request.pose[None]]))
            self.assertAlmostEqual(lengths[0], 0.0, delta=0.05)
            seen.append((request.scans, request.scans_left, request.time_s))
            self.kept = request
            return 5

        run = self.run_small("look", planner=look)
        self.assertEqual([step[:2] for step in seen], [(1, 3), (2, 2), (3, 1)])
        self.assertEqual(list(run.steps["chosen_view"][1:]), [5, 5, 5])
        with self.assertRaisesRegex(vantage.Error, "has gone on"):
            self.kept.views

    def test_planners_are_told_how_sure_the_gains_are(self):
        seen = []

        def look(request):
            seen.append((request.gain, request.interval, request.gain_unit))
            return 5

        run = self.run_small("sure", planner=look)
        first = vantage.ForecastInterval("tables")  # the options' defaults are those of the episode's key `intervals`
        first.start(run.steps["actual_new_cells"][0])
        gain, interval, unit = seen[0]
        self.assertEqual((interval.shape, unit), ((30, 2), "bits"))
        np.testing.assert_allclose(interval, first.of(gain), rtol=1e-9)
        self.assertTrue((interval[:, 1] > interval[:, 0]).all())
        seen.clear()
        self.run_small("unsure", planner=look, gain="simple", scans=2, lean=True)
        self.assertEqual(seen[0][1].shape, (30, 2))
        self.assertTrue(np.isnan(seen[0][1]).all())

    def test_planners_may_name_a_pose(self):
        def aside(request):
            return request.pose + np.array([0.2, 0.0, 0.0])

        run = self.run_small("pose", scans=2, planner=aside, lean=True)
        self.assertEqual(run.metrics["status"], "completed")
        self.assertAlmostEqual(run.metrics["scans"][1]["leg_length_m"], 0.2, delta=0.05)

    def test_planners_that_err_leave_a_failed_run_and_raise(self):
        with self.assertRaisesRegex(KeyError, "why"):
            self.run_small("raises", planner=lambda request: {}["why"])
        metrics = vantage.load(self.folder / "raises").metrics
        self.assertEqual((metrics["status"], metrics["reason"]), ("failed", "the planner raised: KeyError: 'why'"))
        for name, answer, reason in (("far", 99, "view 99 was chosen"), ("below", -1, "view -1 was chosen, there are 30"),
                                     ("huge", 2**70, "was chosen"), ("nowhere", (0, 0, 0), "free floor")):
            metrics = self.run_small(name, planner=lambda request: answer).metrics
            self.assertEqual(metrics["status"], "failed")
            self.assertIn(reason, metrics["reason"])
        for answer in (None, "x", (1, 2), [[1, 2, 3]]):
            with self.assertRaises(vantage.BadDecision):
                self.run_small("odd", planner=lambda request: answer, overwrite=True)

    def test_the_truth_is_not_to_be_had(self):
        with self.assertRaisesRegex(vantage.ConfigError, "ground truth"):
            self.run_small("oracle", choice="oracle", planner=lambda request: 0)
        with self.assertRaisesRegex(vantage.ConfigError, "does not choose among views"):
            vantage.run("trajectory", out=self.folder / "flight", planner=lambda request: 0)

    def test_ctrl_c_writes_what_there_is(self):
        timer = threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            vantage.run("tabletop", out=self.folder / "stopped")
        self.assertEqual(vantage.load(self.folder / "stopped").metrics["status"], "interrupted")

    def test_ctrl_c_while_a_planner_thinks_is_no_failure(self):
        def interrupted(request):
            raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            self.run_small("thinking", planner=interrupted, lean=True)
        self.assertEqual(vantage.load(self.folder / "thinking").metrics["status"], "interrupted")

    def test_ctrl_c_is_heard_while_another_program_thinks(self):
        choice = {"name": "external", "command": ["sleep", "100"], "startup_timeout_s": 100}
        start = time.monotonic()
        timer = threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            self.run_small("asleep", choice=choice, lean=True)
        self.assertLess(time.monotonic() - start, 50)

    def test_are_read_back(self):
        run = self.run_small("whole", video=True)
        back = vantage.load(run.directory)
        self.assertEqual(back.metrics["status"], "completed")
        self.assertEqual(back.manifest["seed"], 1)
        steps = back.steps
        self.assertEqual(len(steps["time_s"]), 4)
        self.assertEqual(steps["registered"].dtype, bool)
        self.assertEqual(steps["unobserved_cells"][-1], back.metrics["scans"][-1]["unobserved_cells"])
        table = back.candidates
        self.assertEqual(len(table["decision"]), 3 * 30)
        first = table["decision"] == 1
        self.assertEqual(table["candidate"][first][table["chosen"][first] == 1], steps["chosen_view"][1])
        self.assertEqual(back.trajectory.shape[1], 8)
        self.assertGreater(back.map.count(vantage.OCCUPIED), 10)
        for number in (100, 99):
            (run.directory / f"frames/scan_{number}.png").touch()
        self.assertEqual([picture.name for picture in back.frames],
                         [f"scan_{number}.png" for number in ("01", "02", "03", "04", "99", "100")])
        with self.assertRaisesRegex(vantage.InputError, "no run folder"):
            vantage.load(self.folder)
        with self.assertRaisesRegex(vantage.ConfigError, "holds.*; overwrite=True replaces it"):
            self.run_small("whole")
        self.run_small("whole", lean=True, overwrite=True)
        with self.assertRaisesRegex(vantage.InputError, "candidates.csv"):
            back.candidates

    def test_files_are_named_by_any_path(self):
        (self.folder / "mine.yaml").write_text("task: tabletop\nscans: 3\n")
        with os.scandir(self.folder) as entries:
            self.assertEqual(vantage.episode(next(entries)).options["scans"], 3)
        with self.assertRaisesRegex(vantage.ConfigError, "is not a name or path"):
            vantage.episode(b"tabletop")

    def test_keys_that_are_wrong_are_told(self):
        for message, keys in {"unknown key 'scanz'": {"scanz": 1}, "map.cells": {"map": {"cells": [1, 2]}},
                              "gain": {"gain": {"name": "simple", "b": 1}}, "scans: 0": {"scans": 0}}.items():
            with self.assertRaisesRegex(vantage.ConfigError, message):
                vantage.run("tabletop", out=self.folder / "bad", **keys)
        for message, arguments in {"planner: 3 is not": {"planner": 3}, "name: 3 is not": {"name": 3},
                                   "out: 3 is not": {"out": 3}}.items():
            with self.assertRaisesRegex(vantage.ConfigError, message):
                vantage.run(**{"out": self.folder / "bad", **arguments})
        with self.assertRaisesRegex(vantage.InputError, "no_such"):
            vantage.run("no_such")
        self.assertFalse((self.folder / "bad").exists())


if __name__ == "__main__":
    unittest.main()
