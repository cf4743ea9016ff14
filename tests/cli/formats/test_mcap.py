"""`vantage export --mcap`: whole by the specification, and what the run folder says."""

import base64
import csv
import json
import os
import shutil
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path

try:
    import jsonschema
except ImportError as missing:
    raise SystemExit(f"SKIPPED: {missing}; apt-get install python3-jsonschema")

from mcap_file import McapFile

SOURCE = Path(os.environ["VANTAGE_SOURCE"])
BINARY = os.environ["VANTAGE_BINARY"]
SHORT = ["--set", "scans=3", "--set", "laser.scan_duration_s=2", "--set", "map.cells=[33,33,17]"]
WELL_KNOWN = {"/tf": "FrameTransforms", "/pose": "PoseInFrame", "/pose_estimated": "PoseInFrame",
              "/views": "SceneUpdate", "/plan": "SceneUpdate", "/map/occupied": "PointCloud", "/cloud": "PointCloud",
              "/camera": "CompressedImage", "/camera/tf": "FrameTransforms",
              "/camera/calibration": "CameraCalibration", "/overview": "CompressedImage"}


def vantage(*arguments):
    return subprocess.run([BINARY, *map(str, arguments)], capture_output=True, text=True)


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def seconds(stamp):
    return stamp["sec"] + 1e-9 * stamp["nsec"]


def xyz(vector):
    return [vector[axis] for axis in "xyz"]


def axes(rotation):
    """The x, y and z axis of a frame in the world."""
    x, y, z, w = (rotation[axis] for axis in "xyzw")
    return ((1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)),
            (2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)),
            (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)))


def dot(a, b):
    return sum(p * q for p, q in zip(a, b, strict=True))


class Exported:
    """An MCAP file as messages by topic: (time in s, JSON)."""

    def __init__(self, path):
        self.file = McapFile(path.read_bytes())
        self.topics = {}
        for channel, time_ns, data in self.file.messages:
            topic = self.file.channels[channel][0]
            self.topics.setdefault(topic, []).append((1e-9 * time_ns, json.loads(data)))

    def schema(self, topic):
        schema_id, = [schema for name, schema, _ in self.file.channels.values() if name == topic]
        return self.file.schemas[schema_id]


def episode(folder, name, *arguments):
    done = vantage("run", SOURCE / f"assets/episodes/{name}.yaml", *arguments, "-q", "--out", folder / name)
    assert done.returncode in (0, 1), done.stderr
    file = folder / f"{name}.mcap"
    done = vantage("export", folder / name, "--mcap", file, "--image-period", 4)
    assert done.returncode == 0, done.stderr
    return folder / name, Exported(file)


class Mcap(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        cls.run_dir, cls.made = episode(cls.folder, "tabletop", *SHORT)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def near(self, a, b, within=1e-6):
        for one, other in zip(a, b, strict=True):
            self.assertAlmostEqual(float(one), float(other), delta=within)

    def check_messages(self, made):
        for topic, messages in made.topics.items():
            name, encoding, schema = made.schema(topic)
            self.assertEqual(encoding, "jsonschema")
            self.assertEqual(name, "vantage.Step" if topic == "/steps" else f"foxglove.{WELL_KNOWN[topic]}")
            schema = json.loads(schema)
            self.assertEqual(schema["title"], name)
            validator = jsonschema.Draft7Validator(schema)
            for time_s, message in messages:
                self.assertEqual([error.message for error in validator.iter_errors(message)], [], topic)
                if "timestamp" in message:
                    self.assertAlmostEqual(seconds(message["timestamp"]), time_s, delta=1e-8)

    def test_messages_are_as_their_schemas_say(self):
        self.assertEqual(set(self.made.topics), {*WELL_KNOWN, "/steps"})
        self.check_messages(self.made)
        times = [time_ns for _, time_ns, _ in self.made.file.messages]
        self.assertEqual(times, sorted(times))

    def test_poses_and_frames_are_those_of_the_run(self):
        truth = {}
        for topic, name in [("/pose", "trajectory.tum"), ("/pose_estimated", "trajectory_estimated.tum")]:
            lines = [line.split() for line in (self.run_dir / name).read_text().splitlines() if line[0] != "#"]
            messages = self.made.topics[topic]
            self.assertEqual(len(messages), len(lines))
            for (time_s, message), line in zip(messages, lines, strict=True):
                self.near([time_s, *xyz(message["pose"]["position"])], line[:4])
                turn = message["pose"]["orientation"]
                self.near([turn[axis] for axis in "xyzw"], line[4:8])
                if topic == "/pose":
                    truth[round(time_s, 3)] = xyz(message["pose"]["position"])
        met = 0
        for time_s, message in self.made.topics["/tf"]:
            base = message["transforms"][0]
            self.assertEqual(base["parent_frame_id"], "world")
            if round(time_s, 3) in truth:
                self.near(xyz(base["translation"]), truth[round(time_s, 3)], 2e-6)
                met += 1
        self.assertGreater(met, 20)

    def test_map_is_that_of_the_run(self):
        scans = rows(self.run_dir / "steps.csv")
        clouds = self.made.topics["/map/occupied"]
        self.assertEqual(len(clouds), len(scans))
        voxels = (self.run_dir / "voxels.bin").read_bytes()
        cell, low, high = (struct.unpack_from("<3d", voxels, 8 + 24 * i) for i in range(3))
        count, = struct.unpack_from("<Q", voxels, 80)
        expected = {struct.unpack_from("<3f", voxels, 88 + 16 * i) for i in range(count)
                    if voxels[88 + 16 * i + 14] == 0}
        data = base64.b64decode(clouds[-1][1]["data"])
        found = {struct.unpack_from("<3f", data, 12 * i) for i in range(len(data) // 12)}
        self.assertGreater(len(found), 100)
        self.assertEqual(len(found), len(expected))
        for point in found:
            index = [(p - a) / size for p, a, size in zip(point, low, cell)]
            self.near([(i - 0.5) - round(i - 0.5) for i in index], [0, 0, 0], 1e-3)
            self.assertTrue(all(a < p < b for a, p, b in zip(low, point, high)))
        ply = (self.run_dir / "cloud.ply").read_bytes()
        points = int(ply.split(b"element vertex ")[1].split()[0])
        self.assertEqual(len(base64.b64decode(self.made.topics["/cloud"][0][1]["data"])), 12 * points)

    def test_steps_are_the_rows(self):
        for row, (time_s, step) in zip(rows(self.run_dir / "steps.csv"), self.made.topics["/steps"], strict=True):
            self.assertEqual(list(step), list(row))
            self.assertAlmostEqual(time_s, float(row["time_s"]), delta=1e-8)
            for key, field in row.items():
                if field in ("true", "false"):
                    self.assertIs(step[key], field == "true")
                elif field == "":
                    self.assertIsNone(step[key])
                elif isinstance(step[key], (int, float)):
                    self.assertEqual(step[key], float(field))
                else:
                    self.assertEqual(step[key], field)

    def test_bytes_that_are_no_text_are_replaced(self):
        latin = self.folder / "latin"
        shutil.copytree(self.run_dir, latin)
        lines = (latin / "steps.csv").read_bytes().splitlines()
        (latin / "steps.csv").write_bytes(b"".join(line + b",caf\xe9\n" for line in lines))
        told = vantage("export", latin, "--mcap", self.folder / "latin.mcap", "--image-period", 0)
        self.assertEqual(told.returncode, 0, told.stderr)
        for _, step in Exported(self.folder / "latin.mcap").topics["/steps"]:
            self.assertEqual(step["caf\N{REPLACEMENT CHARACTER}"], "caf\N{REPLACEMENT CHARACTER}")

    def test_views_are_the_candidates(self):
        decisions = {}
        for row in rows(self.run_dir / "candidates.csv"):
            decisions.setdefault(row["decision"], []).append(row)
        self.assertEqual(len(self.made.topics["/views"]), len(decisions))
        for views, (_, message) in zip(decisions.values(), self.made.topics["/views"], strict=True):
            told, chosen = message["entities"]
            self.assertEqual([told["id"], chosen["id"]], ["views", "chosen"])
            self.assertEqual(len(told["arrows"]), len(views))
            for row, arrow in zip(views, told["arrows"], strict=True):
                self.near(xyz(arrow["pose"]["position"]), [row["x_m"], row["y_m"], row["z_m"]])
            best, = [row for row in views if row["chosen"] == "1"]
            self.near(xyz(chosen["arrows"][0]["pose"]["position"]), [best["x_m"], best["y_m"], best["z_m"]])
            reddest = max(told["arrows"], key=lambda arrow: arrow["color"]["r"])
            self.assertAlmostEqual(reddest["color"]["r"], 1.0)
        ways = [message for _, message in self.made.topics["/plan"] if message["entities"]]
        self.assertEqual(len(ways), len(decisions))
        for message in ways:
            self.assertGreater(len(message["entities"][0]["lines"][0]["points"]), 1)

    def test_images_are_images(self):
        for topic in ("/camera", "/overview"):
            images = [base64.b64decode(message["data"]) for _, message in self.made.topics[topic]]
            self.assertGreater(len(images), 3)
            for png in images:
                self.assertTrue(png.startswith(b"\x89PNG"))
                self.assertEqual(struct.unpack_from(">II", png, 16), (320, 240))
            self.assertGreater(len(set(images)), 1, topic)
        calibration = self.made.topics["/camera/calibration"][0][1]
        self.assertEqual((calibration["width"], calibration["height"]), (320, 240))
        self.assertGreater(calibration["K"][0], 100)
        self.assertEqual((calibration["K"][2], calibration["K"][5]), (159.5, 119.5))  # between the middle pixels
        image, frame = self.made.topics["/camera"][1][1], self.made.topics["/camera/tf"][1][1]["transforms"][0]
        self.assertEqual(image["frame_id"], frame["child_frame_id"])
        ahead = axes(frame["rotation"])[2]  # the optical axis
        base, = [message["transforms"][0] for time_s, message in self.made.topics["/tf"]
                 if abs(time_s - seconds(image["timestamp"])) < 1e-6]
        self.assertGreater(dot(ahead, axes(base["rotation"])[0]), 0.9)
        self.assertLess(dot(axes(frame["rotation"])[1], (0, 0, 1)), -0.9)  # y points down

    def test_metadata_is_the_manifest(self):
        entries = self.made.file.metadata["vantage"][0]
        manifest = json.loads((self.run_dir / "manifest.json").read_text())
        self.assertEqual(entries["seed"], str(manifest["seed"]))
        self.assertEqual(entries["config_hash"], manifest["config_hash"])

    def test_same_run_same_bytes(self):
        again = self.folder / "again.mcap"
        told = vantage("export", self.run_dir, "--mcap", again, "--image-period", 4, "--json")
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertEqual(again.read_bytes(), (self.folder / "tabletop.mcap").read_bytes())
        said = json.loads(told.stdout)
        self.assertEqual(said["messages"], len(self.made.file.messages))
        self.assertEqual(said["bytes"], again.stat().st_size)

    def test_a_flight(self):
        _, made = episode(self.folder, "recognition", "--set", "max_views=2")
        self.check_messages(made)
        self.assertLessEqual({"/tf", "/pose", "/plan", "/camera", "/steps"}, set(made.topics))
        heights = [message["pose"]["position"]["z"] for _, message in made.topics["/pose"]]
        self.assertGreater(max(heights), 0.5)

    def test_refuses(self):
        told = vantage("export", self.run_dir, "--mcap", self.folder / "tabletop.mcap")
        self.assertEqual(told.returncode, 2)
        self.assertIn("--overwrite", told.stderr)
        self.assertEqual(vantage("export", self.folder, "--mcap", self.folder / "x").returncode, 3)
        self.assertEqual(vantage("export", self.run_dir, "--mcap", "/no/such/folder/x").returncode, 5)
        lean = self.folder / "lean"
        self.assertEqual(vantage("run", *SHORT, "--lean", "-q", "--out", lean).returncode, 0)
        told = vantage("export", lean, "--mcap", self.folder / "x")
        self.assertEqual(told.returncode, 3)
        self.assertIn("lean", told.stderr)
        self.assertFalse(list(self.folder.glob("x*")))

    def test_the_checker_sees_damage(self):
        data = (self.folder / "tabletop.mcap").read_bytes()
        for at in range(11, len(data) - 40, len(data) // 60):
            hurt = bytearray(data)
            hurt[at] ^= 0x40
            with self.assertRaises((ValueError, KeyError, struct.error, subprocess.CalledProcessError)):
                McapFile(bytes(hurt))


if __name__ == "__main__":
    unittest.main()
