"""`vantage schema`: valid by the schema is what the program reads, and what it refuses is refused."""

import copy
import json
import os
import random
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

SOURCE = Path(os.environ["VANTAGE_SOURCE"])
BINARY = os.environ["VANTAGE_BINARY"]
KINDS = ["episode", "study", "robot", "sensor", "recipe", "dataset", "train", "evaluate"]
REFUSED = 60  # at least, of those tried at random


class Yaml12(yaml.SafeLoader):
    """Scalars as YAML 1.2 and editors have them: 1e-3 is a number, yes is a text."""


Yaml12.yaml_implicit_resolvers = {}
for tag, pattern, first in [
    ("bool", r"true|false", "tf"),
    ("null", r"~|null|", ["~", "n", ""]),
    ("int", r"[-+]?[0-9]+", "-+0123456789"),
    ("float", r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?", "-+.0123456789"),
]:
    Yaml12.add_implicit_resolver(f"tag:yaml.org,2002:{tag}", re.compile(f"^(?:{pattern})$"), list(first))
Yaml12.add_constructor("tag:yaml.org,2002:int", lambda loader, node: int(node.value))
Yaml12.add_constructor("tag:yaml.org,2002:float", lambda loader, node: float(node.value))


def vantage(*arguments):
    return subprocess.run([BINARY, *arguments], capture_output=True, text=True, cwd=SOURCE)


def schema(kind):
    return json.loads(vantage("schema", kind).stdout)


def load(path):
    return yaml.load(Path(path).read_text(), Yaml12)


def kind_of(path):
    parent = path.parent.name
    if parent == "recognition":
        return "train" if "training" in path.stem else "evaluate"
    return {"episodes": "episode", "studies": "study", "models": "recipe", "sensors": "sensor"}.get(parent, "robot")


def shipped():
    files = [*SOURCE.glob("assets/episodes/*.yaml"), *SOURCE.glob("assets/studies/**/*.yaml"),
             *SOURCE.glob("assets/models/*.yaml"), *SOURCE.glob("assets/sensors/*.yaml"),
             *SOURCE.glob("models/robots/*/robot.yaml")]
    return sorted(files)


def leaves(node, path=()):
    """Paths of everything below a value."""
    children = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    for key, child in children:
        yield (*path, key)
        yield from leaves(child, (*path, key))


def changed(root, path, value):
    made = copy.deepcopy(root)
    place = made
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = value
    return made


class Schema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.schemas = {kind: schema(kind) for kind in KINDS}
        cls.validators = {kind: jsonschema.Draft7Validator(of) for kind, of in cls.schemas.items()}

    def errors(self, kind, document):
        return [error.message for error in self.validators[kind].iter_errors(document)]

    def test_is_a_schema(self):
        for kind, made in self.schemas.items():
            jsonschema.Draft7Validator.check_schema(made)
            self.assertIn("title", made, kind)

    def test_defaults_of_a_sensor_are_those_that_views_are_scored_with(self):
        self.assertEqual({key: of["default"] for key, of in self.schemas["sensor"]["properties"].items()},
                         {"half_width_rad": 0.5044, "tilt_min_rad": -0.3927, "tilt_max_rad": 0.3927,
                          "range_min_m": 0.8, "range_max_m": 3.5, "panorama": False})

    def test_every_shipped_file_is_valid(self):
        files = shipped()
        self.assertGreater(len(files), 35)
        for path in files:
            with self.subTest(path=path):
                self.assertEqual(self.errors(kind_of(path), load(path)), [])

    def test_everything_that_a_run_writes_is_valid(self):
        for path in SOURCE.glob("assets/episodes/*.yaml"):
            told = vantage("run", str(path), "--print-config")
            if told.returncode == 0:
                self.assertEqual(self.errors("episode", yaml.load(told.stdout, Yaml12)), [], path)

    def test_wrong_files_are_refused(self):
        episode = {"task": "tabletop", "scans": 3}
        for wrong in [{"scns": 3}, {"scans": "three"}, {"scans": -1}, {"gain": "beer_lambrt"}, {"gain": {"a": 0.9}},
                      {"gain": {"name": "beer_lambert", "a": 1.5}}, {"gain": {"name": "simple", "a": 0.9}},
                      {"task": "tabeltop"}, {"task": "exploration", "laser": {}}, {"map": "automatic"},
                      {"map": {"cells": [1, 2]}}, {"robot": {"start_pose": [0, 0]}}, {"threads": 2.5}]:
            with self.subTest(wrong=wrong):
                self.assertNotEqual(self.errors("episode", {**episode, **wrong}), [])
        study = {"episode": "e.yaml", "seeds": "1..20"}
        self.assertEqual(self.errors("study", study), [])
        for wrong in [{"seeds": "1-20"}, {"seeds": [1, 1]}, {"set": {"gian": "simple"}}, {"set": {"gain.a": 2}},
                      {"factors": {"method": {"a b": None}}}, {"factors": {"method": {"a": {"gain": "smple"}}}},
                      {"report": {"curves": ["nothing"]}}, {"report": {"tables": ["nothing"]}}, {"split": []},
                      {"splits": {"a": {"method": []}}}, {"extra": 1}]:
            with self.subTest(wrong=wrong):
                self.assertNotEqual(self.errors("study", {**study, **wrong}), [])
        self.assertNotEqual(self.errors("study", {"seeds": [1]}), [])
        self.assertNotEqual(self.errors("study", {"episode": "e.yaml"}), [])

    def test_no_other_kind(self):
        told = vantage("schema", "episod")
        self.assertEqual(told.returncode, 2)
        self.assertIn("did you mean episode?", told.stderr)

    def test_is_as_strict_as_the_program(self):
        """What the schema refuses, the program refuses; what it lets pass and the program does not is a rule
        over several keys or a file that is missing, never a key, a type, a range or a name."""
        rng = random.Random(1)
        episodes = [load(path) for path in sorted(SOURCE.glob("assets/episodes/*.yaml"))]
        written = [yaml.load(vantage("run", str(path), "--print-config").stdout, Yaml12)
                   for path in (SOURCE / "assets/episodes").glob("*.yaml")]
        refused = 0
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "episode.yaml")
            for _ in range(4 * REFUSED):
                root = rng.choice(episodes + [config for config in written if config])
                place = rng.choice(list(leaves(root)))
                value = rng.choice([-1, -10**9, 10**12, 0.5, "word", True, None, [], [1], {}, {"wrong": 1}, "auto", 3])
                if rng.random() < 0.2:
                    if not all(isinstance(key, str) for key in place):
                        continue
                    place, value = (*place[:-1], f"{place[-1]}x"), 1
                document = changed(root, place, value)
                path.write_text(json.dumps(document))
                told = vantage("run", str(path), "--print-config")
                by_schema = self.errors("episode", document)
                about = f"{'.'.join(map(str, place))} = {value!r}: {told.stderr} {by_schema}"
                if told.returncode == 0:
                    self.assertEqual(by_schema, [], about)
                elif re.search(r"unknown|has no key|: expected |out of range", told.stderr):
                    self.assertNotEqual(by_schema, [], about)
                    refused += 1
        self.assertGreater(refused, REFUSED)


if __name__ == "__main__":
    unittest.main()
