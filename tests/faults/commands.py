"""What is disturbed: a run, a sweep, a rendering and a training, each of seconds; and what must come of each."""

import csv
import hashlib
import json
import os
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
VANTAGE = Path(os.environ.get("VANTAGE_BINARY", ROOT / "build" / "release" / "vantage"))
RUN = ["threads=1", "scans=2", "laser.scan_duration_s=1", "map.cells=[17, 17, 9]"]
RENDER = ["objects=4", "step_deg=90", "videos=[1]", "supersampling=1"]
TRAIN = ["videos=[1]", "features=[soft_colour, standing_box, sift]", "feature_views=8", "costs_s=[0.001, 0.001, 0.001]"]
STUDY = f"""title: Two starts
episode: {ROOT}/assets/episodes/tabletop.yaml
set: {{threads: 1, scans: 1, laser.scan_duration_s: 1, map.cells: [17, 17, 9]}}
factors:
  start: {{start_0: {{robot.start_view: 0}}, start_5: {{robot.start_view: 5}}}}
report: {{reference: start_0, tables: [area]}}
"""
# The codes of docs/reference: what a fault of the machine may end in.
CODES = {0: "done", 2: "usage", 3: "bad input", 5: "output could not be written", 6: "no renderer",
         130: "interrupted", 143: "terminated"}
OF_THE_CLOCK = {"wall_time_s", "real_time_factor", "plan_time_s", "map_time_s", "feature_time_s", "selection_time_s"}


def settings(values):
    return [word for value in values for word in ("--set", value)]


def digest(file):
    return hashlib.sha256(file.read_bytes()).hexdigest()


def without_clock(value):
    if isinstance(value, dict):
        return {key: without_clock(inner) for key, inner in value.items() if key not in OF_THE_CLOCK}
    return [without_clock(inner) for inner in value] if isinstance(value, list) else value


class Command:
    """One command and its folder, whose name is the same for each try so that files can be compared."""

    def __init__(self, name, arguments, again, results_of):
        self.name, self.arguments, self.again, self.results_of = name, arguments, again, results_of
        self.expected, self.duration_s = None, 0.0

    def line(self, out, again=False):
        return [str(VANTAGE), *self.arguments(out), *(self.again if again else [])]

    def start(self, out, again=False, environment=None, **options):
        log = tempfile.TemporaryFile()  # noqa: SIM115
        process = subprocess.Popen(self.line(out, again), stdout=log, stderr=log, cwd=out.parent,
                                   env={**os.environ, **(environment or {})}, **options)
        process.log = log
        return process

    def run(self, out, again=False, environment=None, timeout=300, **options):
        """Exit code (negative: the signal that it died of) and what it said."""
        process = self.start(out, again, environment, **options)
        try:
            process.wait(timeout)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            return "hang", said(process)
        return process.returncode, said(process)

    def half_written(self, out):
        """Files under final names that are not whole, by what they hold."""
        return [f"{file.relative_to(out)} is not whole" for file in files_of(out) if not is_whole(file)]

    def wrong(self, out):
        """Why the folder's results are not those of an undisturbed command; empty if they are."""
        try:
            results = self.results_of(out)
        except (OSError, ValueError, KeyError) as error:
            return f"no results: {error}"
        different = [key for key in self.expected if results.get(key) != self.expected[key]]
        return f"differs in {different[:3]}" if different else ""


def said(process):
    process.log.flush()
    process.log.seek(0)
    text = process.log.read().decode(errors="replace")
    process.log.close()
    return text


def files_of(out):
    """Under final names: parts, and what goes on in the folder of an attempt, do not count."""
    if out.is_file():
        return [out]
    def is_final(file):
        names = file.relative_to(out).parts
        return not any(".part" in name for name in names) and "attempts" not in names
    return [file for file in sorted(out.rglob("*")) if file.is_file() and is_final(file)]


def is_whole(file):
    content = file.read_bytes()
    if file.suffix == ".json":
        try:
            json.loads(content)
        except ValueError:
            return False
    if file.suffix == ".png":
        return content.endswith(b"IEND\xaeB`\x82")
    if file.suffix in (".csv", ".tum", ".yaml", ".txt"):
        return not content or content.endswith(b"\n") or file.suffix == ".txt"
    return bool(content)


def run_results(out):
    metrics = json.loads((out / "metrics.json").read_text())
    if metrics["status"] != "completed":
        raise ValueError(f"status {metrics['status']}")
    results = {"metrics": without_clock(metrics)}
    for name in ("states.bin", "actions.csv", "story.bin", "map.bt", "map.ot", "cloud.ply", "voxels.bin", "trajectory.tum"):
        results[name] = digest(out / name)
    return results


def sweep_results(out):
    subprocess.run([VANTAGE, "sweep", "collect", out, "-q"], check=True, cwd=out.parent,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(out / "results.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {f"episode {i}": {k: v for k, v in row.items() if k not in OF_THE_CLOCK} for i, row in enumerate(rows)}


def file_results(out):
    return {str(file.relative_to(out)) if out.is_dir() else "file": digest(file) for file in files_of(out)
            if file.name != "contact_sheet.png"}


def rendering(options):
    return Command("render", lambda out: ["dataset", "render", str(out), *settings(options), "-q"], [], file_results)


def undisturbed(command, out):
    """Runs it once, to know what must come of it."""
    start = time.monotonic()
    code, text = command.run(out)
    command.duration_s = time.monotonic() - start
    if code != 0:
        raise SystemExit(f"{command.name} fails without a fault: {code}\n{text}")
    command.expected = command.results_of(out)


class Commands:
    """All four, run once without a fault."""

    def __init__(self, scratch):
        self.scratch = scratch
        (scratch / "small.yaml").write_text(STUDY)
        episode = ROOT / "assets/episodes/tabletop.yaml"
        recording = scratch / "recording"
        self.all = {
            "run": Command("run", lambda out: ["run", str(episode), "--out", str(out), *settings(RUN), "-q"],
                           ["--overwrite"], run_results),
            "sweep": Command("sweep", lambda out: ["sweep", "run", str(scratch / "small.yaml"), "--out", str(out),
                                                   "--jobs", "2", "-q"], [], sweep_results),
            "render": rendering(RENDER),
            "train": Command("train", lambda out: ["train", str(recording), "--out", str(out), *settings(TRAIN), "-q"],
                             ["--overwrite"], file_results),
        }
        for name, command in self.all.items():
            undisturbed(command, recording if name == "render" else self.folder())

    def rendering_of(self, objects):
        command = rendering([f"objects={objects}", *RENDER[1:]])
        undisturbed(command, self.folder())
        return command

    def folder(self):
        """A name for a result that is not there."""
        out = self.scratch / "tries" / "out"
        out.parent.mkdir(exist_ok=True)
        self.clean()
        return out

    def clean(self):
        for old in (self.scratch / "tries").glob("*"):
            shutil.rmtree(old, ignore_errors=True) if old.is_dir() else old.unlink()
