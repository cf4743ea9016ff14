"""What the tests share."""

import os
import re
import tempfile
import unittest
from pathlib import Path

import numpy as np

import vantage

SOURCE = Path(os.environ["VANTAGE_SOURCE"])
BINARY = os.environ["VANTAGE_BINARY"]

#: A table-top episode of seconds.
SMALL = {"scans": 4, "map": {"cells": [33, 33, 17]}, "laser": {"scan_duration_s": 1}}
SMALL_FLAGS = ["--set", "scans=4", "--set", "map.cells=[33,33,17]", "--set", "laser.scan_duration_s=1"]


def blocks(page):
    """(language, code) of each fenced block of a page."""
    return re.findall(r"^```(\w*)\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL)


def room(shape=(40, 40, 20)):
    """A grid with a known floor, a block on it, some free space, and the rest unobserved."""
    p = np.full(shape, 0.5)
    p[:, :, 0] = 0.95
    p[16:24, 16:24, 1:8] = 0.95
    p[2:12, 2:38, 1:10] = 0.05
    return vantage.Grid.from_probabilities(p, (-2.0, -2.0, 0.0), 0.1)


class InFolder(unittest.TestCase):
    """A case with a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
