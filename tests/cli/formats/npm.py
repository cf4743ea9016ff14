"""Other people's readers, from npm."""

import shutil
import subprocess
import unittest

PACKAGES = ["@mcap/core@2", "@mcap/nodejs@1", "@foxglove/schemas@1", "fzstd@0.1"]


def install(folder):
    for tool in ("node", "npm"):
        if shutil.which(tool) is None:
            raise unittest.SkipTest(f"no {tool}")
    try:
        done = subprocess.run(["npm", "install", "--no-audit", "--no-fund", "--ignore-scripts", *PACKAGES], cwd=folder,
                              capture_output=True, text=True, timeout=120)
    except subprocess.TimeoutExpired:
        raise unittest.SkipTest("npm does not answer") from None
    if done.returncode != 0:
        raise unittest.SkipTest(f"npm: {done.stderr.strip().splitlines()[-1:]}")
