"""The package as `pip install --no-build-isolation .` and `cmake --install` put it: it runs from any folder, with its
data."""

import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import vantage
from support import SOURCE, InFolder

BUILD = Path(vantage.__file__).absolute().parents[2]
TRY = """
import vantage
run = vantage.run("tabletop", out="run", scans=2, map={"cells": [25, 25, 13]}, laser={"scan_duration_s": 1})
print(vantage.data_root(), run.metrics["status"], sep="\\n")
"""


class Installed(InFolder):
    def check(self, packages, data):
        elsewhere = self.folder / "elsewhere"
        elsewhere.mkdir()
        environment = {k: v for k, v in os.environ.items() if not k.startswith("VANTAGE")}
        environment["PYTHONPATH"] = str(packages)
        done = subprocess.run([sys.executable, "-c", TRY], cwd=elsewhere, env=environment, capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        root, status = done.stdout.split()
        self.assertEqual(Path(root).resolve(), data.resolve())
        self.assertEqual(status, "completed")

    def test_by_pip(self):
        source = self.folder / "source"  # setuptools writes beside its sources
        source.mkdir()
        for item in SOURCE.iterdir():
            if item.name == "python":
                shutil.copytree(item, source / item.name)
            elif item.name not in ("build", "out", ".git", ".cache"):
                (source / item.name).symlink_to(item)
        packages = self.folder / "packages"
        done = subprocess.run([sys.executable, "-m", "pip", "install", "--no-build-isolation", "--no-deps", "--no-index",
                               "--quiet", "--target", str(packages), "."], cwd=source, capture_output=True, text=True,
                              env={**os.environ, "VANTAGE_BUILD_DIR": str(BUILD)}, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((packages / "vantage/py.typed").is_file())
        self.assertTrue((packages / "vantage/_core.pyi").is_file())
        self.check(packages, packages / "vantage/share")

    def test_by_cmake(self):
        prefix = self.folder / "prefix"
        for component in ("python", "application"):
            subprocess.run(["cmake", "--install", str(BUILD), "--prefix", str(prefix), "--component", component],
                           check=True, stdout=subprocess.DEVNULL)
        self.check(prefix / "lib/python3/dist-packages", prefix / "share/vantage")


if __name__ == "__main__":
    unittest.main()
