"""The package as pip installs it the way docs/python/README.md says, and as `cmake --install` puts it: it runs from any
folder, with its data."""

import os
import shutil
import subprocess
import sys
import tomllib
import unittest
from pathlib import Path

import vantage
from support import SOURCE, InFolder, blocks

BUILD = Path(vantage.__file__).absolute().parents[2]
TRY = """
import vantage
run = vantage.run("tabletop", out="run", scans=2, map={"cells": [25, 25, 13]}, laser={"scan_duration_s": 1})
print(vantage.data_root(), run.metrics["status"], sep="\\n")
"""


def commands():
    """How the page says to install it."""
    return [code for language, code in blocks(SOURCE / "docs/python/README.md") if language == "sh"]


class Installed(InFolder):
    def check(self, data, python=sys.executable, packages=None):
        elsewhere = self.folder / "elsewhere"
        elsewhere.mkdir()
        environment = {k: v for k, v in os.environ.items() if not k.startswith(("VANTAGE", "PYTHONPATH"))}
        if packages:
            environment["PYTHONPATH"] = str(packages)
        done = subprocess.run([python, "-c", TRY], cwd=elsewhere, env=environment, capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        root, status = done.stdout.split()
        self.assertEqual(Path(root).resolve(), data.resolve())
        self.assertEqual(status, "completed")

    def source(self):
        """The sources, as links but for what setuptools writes beside."""
        source = self.folder / "source"
        source.mkdir()
        for item in SOURCE.iterdir():
            if item.name == "python":
                shutil.copytree(item, source / item.name)
            elif item.name not in ("build", "out", ".git", ".cache", ".venv"):
                (source / item.name).symlink_to(item)
        return source

    def test_by_pip(self):
        made = subprocess.run([sys.executable, "-m", "venv", str(self.folder / "tried")], capture_output=True,
                              text=True, check=False)
        if made.returncode != 0:
            self.skipTest(f"python3 -m venv: {made.stdout}{made.stderr}")  # without python3-venv
        source = self.source()
        environment = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
        environment.update(PATH=f"{Path(sys.executable).parent}:{os.environ['PATH']}", PIP_NO_INDEX="1",
                           VANTAGE_BUILD_DIR=str(BUILD))
        self.assertEqual(len(commands()), 1)
        done = subprocess.run(["bash", "-ec", commands()[0]], cwd=source, capture_output=True, text=True, check=False,
                              env=environment)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        packages, = (source / ".venv/lib").glob("python3*/site-packages")
        self.assertTrue((packages / "vantage/py.typed").is_file())
        self.assertTrue((packages / "vantage/_core.pyi").is_file())
        self.check(packages / "vantage/share", source / ".venv/bin/python3")

    def test_the_readme_says_the_same(self):
        self.assertIn(f"`{' && '.join(commands()[0].splitlines())}`", (SOURCE / "README.md").read_text())

    def test_asks_for_a_python_that_can_run_it(self):
        project = tomllib.loads((SOURCE / "pyproject.toml").read_text())["project"]
        self.assertEqual(project["requires-python"], ">=3.10")  # slices of Path.parents

    def test_by_cmake(self):
        prefix = self.folder / "prefix"
        for component in ("python", "application"):
            subprocess.run(["cmake", "--install", str(BUILD), "--prefix", str(prefix), "--component", component],
                           check=True, stdout=subprocess.DEVNULL)
        self.check(prefix / "share/vantage", packages=prefix / "lib/python3/dist-packages")


if __name__ == "__main__":
    unittest.main()
