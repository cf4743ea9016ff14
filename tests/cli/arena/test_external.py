"""Episodes whose views a program chooses: the same bits as ours where it chooses the same, and an honest end otherwise."""

import json
import os
import shutil
import signal
import subprocess
import time
import unittest

from support import BINARY, HERE, OFFICE, SOURCE, TABLETOP, InFolder, external, processes_with

HELLO = "read hello; echo '{\"protocol\": \"vantage-planner\", \"version\": 1}'; "


class External(InFolder):
    def test_a_copy_of_greedy_gives_the_same_bits(self):
        greedy = external("python3", HERE / "greedy.py")
        for episode, settings in ("tabletop", TABLETOP), ("office_small", OFFICE):
            with self.subTest(episode):
                own = self.run_episode(f"{episode}-own", episode, settings, more=["--lean"])
                theirs = self.run_episode(f"{episode}-theirs", episode, settings + greedy, more=["--lean"])
                self.assertEqual(theirs["status"], "completed")
                self.assertEqual(theirs["state_hash"], own["state_hash"])
                self.assertEqual(theirs["method"], "external of adaptive")

    def test_requests_are_the_same_each_time(self):
        recorder = self.script("recorder.py", """
import json, pathlib, sys
told = open(sys.argv[1], "w")
told.write(sys.stdin.readline())
print(json.dumps({"protocol": "vantage-planner", "version": 1}), flush=True)
for line in sys.stdin:
    told.write(line)
    if json.loads(line)["type"] == "decide":
        print(json.dumps({"view": 3}), flush=True)
""")
        texts = []
        for name in "first", "second":
            told = self.folder / f"{name}.jsonl"
            self.run_episode(name, "tabletop", TABLETOP + external("python3", recorder, told), more=["--lean"])
            texts.append(told.read_text())
        self.assertEqual(texts[0], texts[1])
        self.assertEqual(len(texts[0].splitlines()), 5)
        for secret in "truth", "observable", "actual", str(self.folder), "/tmp":
            self.assertNotIn(secret, texts[0])

    def test_what_fails_is_recorded_and_replays_without_the_planner(self):
        planner = self.script("planner.sh", HELLO + "read request; echo '{\"view\": 5}'; echo oops >&2; read request; exit 7")
        metrics = self.run_episode("run", "tabletop", TABLETOP + external("sh", planner), code=1)
        self.assertEqual(metrics["status"], "failed")
        self.assertTrue(metrics["reason"].endswith("decision 2: it ended: exit code 7, after it said: oops"), metrics["reason"])
        self.assertEqual(len(metrics["scans"]), 2)
        self.assertIn("planner: oops", (self.folder / "run/log.txt").read_text())
        manifest = json.loads((self.folder / "run/manifest.json").read_text())
        self.assertIn("sh", manifest["planner"]["command"])
        self.assertIn("isolation", manifest["planner"])
        self.assertIn("choice.command[1]", manifest["assets"])
        self.assertIn("planner.sh", (self.folder / "run/config.yaml").read_text())
        planner.unlink()
        self.vantage("replay", "run", "-q")
        self.vantage("branch", "run", "--scan", "1", "--view", "2", "--then", "1", code=2)
        self.vantage("branch", "run", "--scan", "1", "--view", "2", code=2)
        told = self.vantage("branch", "run", "--scan", "1", "--view", "2", "--then", "0", "-q")
        self.assertIn("decision after scan 1", told)

    def test_a_program_that_is_not_there_is_told_before_anything_runs(self):
        for command in ["choice=external"], external("no_such_program_zz"):
            told = self.vantage("run", "--out", "none", *[w for s in command for w in ("--set", s)], code=2)
            self.assertIn("choice.command", told)
            self.assertFalse((self.folder / "none").exists())

    def started(self, script):
        """Vantage, at the moment its planner waits."""
        arguments = [word for setting in TABLETOP + external("sh", self.script("planner.sh", script))
                     for word in ("--set", setting)]
        process = subprocess.Popen([str(BINARY), "run", "--out", "run", "-q", *arguments], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(process.kill)
        return process

    def wait_until(self, condition):
        for _ in range(1200):
            if condition():
                return True
            time.sleep(0.05)
        return False

    def test_no_planner_outlives_vantage(self):
        sleeper = f"86398.{os.getpid()}"
        script = f"(setsid sleep {sleeper} &); {HELLO} sleep {sleeper}"
        for sign, code in (signal.SIGKILL, -signal.SIGKILL), (signal.SIGINT, 130):
            with self.subTest(sign):
                shutil.rmtree(self.folder / "run", ignore_errors=True)
                process = self.started(script)
                self.assertTrue(self.wait_until(lambda: len(processes_with(sleeper)) >= 2), "started")
                process.send_signal(sign)
                self.assertEqual(process.wait(), code)
                self.assertTrue(self.wait_until(lambda: not processes_with(sleeper)), processes_with(sleeper))
        metrics = json.loads((self.folder / "run/metrics.json").read_text())
        self.assertEqual(metrics["status"], "interrupted")

    def test_the_examples_hold_their_own(self):
        planners = {"python": ["python3", SOURCE / "examples/arena/gain_rate.py"]}
        if shutil.which("node"):
            planners["javascript"] = ["node", SOURCE / "examples/arena/lookahead.js"]
        for language, command in planners.items():
            for episode, settings in ("tabletop", TABLETOP), ("office_small", OFFICE):
                with self.subTest(f"{language}, {episode}"):
                    metrics = self.run_episode(f"{language}-{episode}", episode,
                                               settings + external(*command) + ["budget.time_s=400"], more=["--lean"])
                    self.assertEqual(metrics["status"], "completed", metrics["reason"])
        if "javascript" not in planners:
            self.skipTest("there is no node")

    def test_the_examples_are_short(self):
        for path in (SOURCE / "examples/arena").rglob("*.*"):
            self.assertLessEqual(len(path.read_text().splitlines()), 100, path)


if __name__ == "__main__":
    result = unittest.main(exit=False).result
    for _, why in result.skipped:
        print(f"SKIPPED: {why}")
    raise SystemExit(not result.wasSuccessful())
