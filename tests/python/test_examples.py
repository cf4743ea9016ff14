"""Every example runs and leaves a picture that shows something."""

import os
import shutil
import subprocess
import sys
import unittest

import numpy as np
from support import SOURCE, InFolder


class Examples(InFolder):
    def test_run_and_leave_their_pictures(self):
        import matplotlib.image
        scripts = [path for path in sorted((SOURCE / "examples").glob("*.py")) if path.name != "common.py"]
        self.assertEqual(len(scripts), 5)
        listed = (SOURCE / "examples/README.md").read_text()
        for script in scripts:
            with self.subTest(script.name):
                self.assertIn(f"({script.name})", listed)
                done = subprocess.run([sys.executable, str(script), "--out", str(self.folder)], capture_output=True,
                                      text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                picture = matplotlib.image.imread(self.folder / f"{script.stem}.png")
                self.assertGreater(min(picture.shape[:2]), 300)
                self.assertGreater(np.std(picture[..., :3]), 0.05)

    def test_tell_what_is_missing(self):
        for name in ("recognise.py", "common.py"):
            shutil.copy(SOURCE / "examples" / name, self.folder)
        environment = {k: v for k, v in os.environ.items() if k != "VANTAGE_BINARY"}
        environment["PATH"] = str(self.folder)
        done = subprocess.run([sys.executable, "recognise.py", "--out", "."], cwd=self.folder, env=environment,
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"^/.*vantage: not there\..*VANTAGE_BINARY")
        self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    unittest.main()
