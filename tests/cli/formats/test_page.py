"""Every block of docs/formats runs, in order, in one folder; JavaScript where its packages can be had from npm."""

import contextlib
import io
import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

try:
    import jsonschema
    import yaml
except ImportError as missing:
    raise SystemExit(f"SKIPPED: {missing}; apt-get install python3-jsonschema python3-yaml")

from npm import install

SOURCE = Path(os.environ["VANTAGE_SOURCE"])
BINARY = Path(os.environ["VANTAGE_BINARY"])
PAGE = SOURCE / "docs/formats/README.md"


class Page(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.names = {}
        self.told = []

    def run_sh(self, code):
        path = f"{BINARY.parent}:{os.environ['PATH']}"
        done = subprocess.run(["bash", "-euc", code], cwd=self.folder, capture_output=True, text=True,
                              env={**os.environ, "PATH": path, "VANTAGE_DATA": str(SOURCE)})
        self.assertEqual(done.returncode, 0, done.stderr)

    def run_python(self, code):
        with contextlib.chdir(self.folder), contextlib.redirect_stdout(io.StringIO()):
            exec(compile(code, str(PAGE), "exec"), self.names)

    def run_javascript(self, code):
        install(self.folder)
        done = subprocess.run(["node", "-e", code], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(done.stdout.splitlines()), 3, done.stdout)

    def run_yaml(self, code):
        schema = json.loads((self.folder / re.search(r"\$schema=(\S+)", code)[1]).read_text())
        jsonschema.Draft7Validator(schema).validate(yaml.safe_load(code))
        (self.folder / "named.yaml").write_text(code)
        self.run_sh("vantage validate named.yaml")

    def test_every_block_runs(self):
        blocks = re.findall(r"^```(\w*)\n(.*?)^```", PAGE.read_text(), re.MULTILINE | re.DOTALL)
        self.assertEqual({language for language, _ in blocks}, {"sh", "python", "javascript", "yaml"})
        self.assertGreater(len(blocks), 7)
        for number, (language, code) in enumerate(blocks):
            with self.subTest(f"block {number + 1}, {language}"):
                getattr(self, f"run_{language}")(code)

    def test_the_table_of_topics_is_what_is_written(self):
        rows = re.findall(r"^\| (`/[^|]*) \|", PAGE.read_text(), re.MULTILINE)
        told = {topic for row in rows for topic in re.findall(r"`(/[\w/]*)`", row)}
        written = set()
        for source in (SOURCE / "src/mcap").glob("*_streams.cpp"):
            written |= set(re.findall(r'"(/[a-z][a-z_/]*)"', source.read_text()))
        self.assertEqual(told, written)


if __name__ == "__main__":
    result = unittest.main(exit=False).result
    for _, why in result.skipped:
        print(f"SKIPPED: {why}")
    raise SystemExit(not result.wasSuccessful())
