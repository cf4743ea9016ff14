"""Every example runs and leaves a picture that shows something."""

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


if __name__ == "__main__":
    unittest.main()
