"""What the tests of planners of others share."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["VANTAGE_SOURCE"])
BINARY = Path(os.environ["VANTAGE_BINARY"])
HERE = Path(__file__).parent

#: Episodes of seconds.
TABLETOP = ["scans=4", "laser.scan_duration_s=2", "map.cells=[33,33,17]"]
OFFICE = ["scans=3", "map.cells=[76,51,17]", "metrics.predictors=[adaptive]", "metrics.pose_spacing_m=4"]


class InFolder(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def vantage(self, *arguments, code=0):
        done = subprocess.run([str(BINARY), *map(str, arguments)], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def run_episode(self, name, episode, settings, code=0, more=()):
        """Its metrics."""
        self.vantage("run", SOURCE / f"assets/episodes/{episode}.yaml", "--out", name, "-q", *more,
                     *[word for setting in settings for word in ("--set", setting)], code=code)
        return json.loads((self.folder / name / "metrics.json").read_text())

    def script(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path


def external(*command):
    return ["choice=external", "choice.command=" + json.dumps([str(word) for word in command])]


def processes_with(text):
    """Ids of the processes whose command line has that text."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                if text.encode() in (entry / "cmdline").read_bytes():
                    found.append(int(entry.name))
            except OSError:
                pass
    return found
