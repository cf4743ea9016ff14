"""Every block of docs/protocol and docs/arena runs, in order, each page in a folder of its own."""

import contextlib
import io
import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["VANTAGE_SOURCE"])
BINARY = Path(os.environ["VANTAGE_BINARY"])
NAMED = re.compile(r"\A# ([\w-]+\.(?:py|yaml))\n")

#: Keeps what it is told, and takes view 1.
RECORDER = """
import json, sys
told = open({path!r}, "w")
hello = sys.stdin.readline()
print(json.dumps({{"protocol": "vantage-planner", "version": 1}}), flush=True)
told.write(hello)
for line in sys.stdin:
    told.write(line)
    told.flush()
    if json.loads(line)["type"] == "decide":
        print(json.dumps({{"view": 1}}), flush=True)
"""


def shape(value):
    """The keys of a message, of the first element of a list of objects too."""
    if isinstance(value, dict):
        return {key: shape(inner) for key, inner in value.items()}
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return [shape(value[0])]
    return None


class Pages(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.told = {}

    def run_sh(self, code):
        path = f"{BINARY.parent}:{os.environ['PATH']}"
        done = subprocess.run(["bash", "-euc", code], cwd=self.folder, capture_output=True, text=True,
                              env={**os.environ, "PATH": path, "VANTAGE_DATA": str(SOURCE)})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def save(self, code):
        named = NAMED.match(code)
        if named:
            (self.folder / named[1]).write_text(code)
        return named and named[1]

    def run_python(self, code):
        if not self.save(code):
            with contextlib.chdir(self.folder), contextlib.redirect_stdout(io.StringIO()):
                exec(compile(code, "page", "exec"), {})

    def run_yaml(self, code):
        self.run_sh(f"vantage validate {self.save(code)}")

    def messages(self):
        """What is really said, by type."""
        if not self.told:
            path = self.folder / "told.jsonl"
            (self.folder / "recorder.py").write_text(RECORDER.format(path=str(path)))
            self.run_sh("vantage run --set choice=external choice.command=[python3,recorder.py] scans=2 "
                        "laser.scan_duration_s=2 map.cells=[33,33,17] -q --out recorded")
            for line in path.read_text().splitlines():
                self.told[json.loads(line)["type"]] = json.loads(line)
        return self.told

    def run_json(self, code):
        for line in code.splitlines():
            message = json.loads(line)
            if "type" in message:
                self.assertEqual(shape(message), shape(self.messages()[message["type"]]))

    def run_page(self, page, languages):
        text = (SOURCE / page).read_text()
        blocks = re.findall(r"^```(\w*)\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
        self.assertEqual({language for language, _ in blocks}, languages)
        for number, (language, code) in enumerate(blocks):
            with self.subTest(f"{page}, block {number + 1}, {language}"):
                getattr(self, f"run_{language}")(code)

    def test_protocol(self):
        self.run_page("docs/protocol/README.md", {"python", "sh", "yaml", "json"})

    def test_arena(self):
        self.run_page("docs/arena/README.md", {"python", "sh", "yaml"})


if __name__ == "__main__":
    unittest.main()
