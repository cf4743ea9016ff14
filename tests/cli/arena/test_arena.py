"""`vantage arena`: planners side by side, the same to the byte each time, and one of somebody's among them."""

import csv
import json
import unittest

from support import HERE, SOURCE, InFolder

STUDY = f"""
title: Small
episode: {SOURCE}/assets/episodes/tabletop.yaml
set: {{scans: 3, budget.time_s: 60, laser.scan_duration_s: 1, map.cells: [33, 33, 17], metrics.predictors: [adaptive]}}
factors:
  scene:
    few: {{scene: models/scenes/tabletop_4/scene.xml}}
  planner:
    greedy: {{choice: greedy}}
    random: {{choice: random}}
seeds: [1, 2]
report: {{compare: planner, reference: greedy, panels: scene}}
"""

HELLO = "read hello; echo '{\"protocol\": \"vantage-planner\", \"version\": 1}'; "


class Arena(InFolder):
    def board(self):
        rows = (self.folder / "arena/leaderboard.csv").read_text().splitlines()
        return {row["planner"]: row for row in csv.DictReader(rows)}

    def files(self):
        """{name: content} of the arena's folder."""
        return {path.relative_to(self.folder): path.read_bytes()
                for path in (self.folder / "arena").rglob("*") if path.is_file()}

    def test_from_run_to_page(self):
        self.script("small.yaml", STUDY)
        told = self.vantage("arena", "run", "small.yaml", "--out", "arena", "--jobs", 2, "-q", "--json")
        told = json.loads(told[told.index("{"):told.rindex("}") + 1])
        self.assertEqual((told["episodes"], told["completed"]), (4, 4))
        self.vantage("arena", "run", "small.yaml", "--out", "again", "--jobs", 1, "-q")
        for file in "results.csv", "leaderboard.csv", "summary.json":
            self.assertEqual((self.folder / "arena" / file).read_bytes(), (self.folder / "again" / file).read_bytes(), file)
        self.assertNotIn("plan_time", (self.folder / "arena/results.csv").read_text())

        self.vantage("arena", "add", "arena", "copy", "-q", "--", "python3", HERE / "greedy.py")
        board = self.board()
        self.assertEqual(board["copy"]["kind"], "foreign")
        for key in "score", "seen_share", "path_length_m", "collisions":
            self.assertEqual(board["copy"][key], board["greedy"][key], key)
        self.vantage("arena", "add", "arena", "copy", "--", "python3", HERE / "greedy.py", code=2)

        broken = self.script("broken.sh", HELLO + "read request; exit 9")
        told = self.vantage("arena", "add", "arena", "broken", "-q", "--", "sh", broken, code=1)
        self.assertIn("exit code 9", told)
        self.assertEqual(self.board()["broken"]["failed"], "2")
        self.assertIn("it ended: exit code 9", (self.folder / "arena/arena.html").read_text())
        # Mended under the same name: the page changes with it.
        broken.write_text((HERE / "greedy.py").read_text())
        self.vantage("arena", "add", "arena", "broken", "-q", "--overwrite", "--", "python3", broken)
        self.assertEqual(self.board()["broken"]["failed"], "0")

        (self.folder / "arena/arena.html").unlink()
        self.vantage("arena", "page", "arena", "-q")
        self.assertIn("broken", (self.folder / "arena/arena.html").read_text())

    def test_what_cannot_begin_does_not_enter(self):
        self.script("small.yaml", STUDY.replace("seeds: [1, 2]", "seeds: [1]"))
        self.vantage("arena", "run", "small.yaml", "--out", "arena", "-q")
        mine = self.script("mine.sh", HELLO + "read request; exit 9")
        self.vantage("arena", "add", "arena", "mine", "-q", "--", "sh", mine, code=1)
        before = self.files()
        told = self.vantage("arena", "add", "arena", "absent", "-q", "--", "python3", "nofile.py", "--set", "a=1",
                            "b=2", code=1)
        self.assertIn("planner python3 nofile.py --set a=1 b=2: it ended: exit code 2, after it said: ", told)
        self.assertIn("can't open file './nofile.py'", told)
        told = self.vantage("arena", "add", "arena", "other", "-q", "--", "echo", "hello", code=1)
        self.assertIn("expected one JSON object in a line, got 'hello'", told)
        # Nor in the place of one that could.
        self.vantage("arena", "add", "arena", "mine", "-q", "--overwrite", "--", "false", code=1)
        told = self.vantage("arena", "add", "arena", "a/b", "-q", "--", "sh", mine, code=2)
        self.assertIn("NAME: 'a/b' may hold letters, digits and _ . - + only", told)
        self.assertNotIn("/tmp", told)
        self.assertEqual(self.files(), before)

    def test_what_it_does_not_take(self):
        self.script("flight.yaml", STUDY.replace("tabletop.yaml", "trajectory.yaml").replace(
            "set: {", "set: {} # {").replace("choice: greedy", "seed: 1").replace("choice: random", "seed: 2").replace(
            "few: {scene: models/scenes/tabletop_4/scene.xml}", "few: {}").replace("seeds: [1, 2]", ""))
        self.assertIn("chooses no views", self.vantage("arena", "run", "flight.yaml", code=2))
        self.vantage("arena", "page", ".", code=3)
        self.vantage("arena", "add", ".", "mine", "--", "true", code=3)
        self.vantage("arena", "add", ".", "mine", code=2)


if __name__ == "__main__":
    unittest.main()
