"""The same bits from every build: a short episode of each task, by gcc and clang, optimised and not, on one thread and two.
`./check bits`; what came of it is a row of docs/reliability.md for each task and machine."""

import json
import platform
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
import reliability_page  # noqa: E402

BUILDS = {"release": "gcc, optimised", "dev": "gcc, not optimised", "clang": "clang, optimised"}
THREADS = [1, 2]
EPISODES = {  # short ones: what is left out does not change what is computed
    "tabletop": ["scans=2", "laser.scan_duration_s=1", "map.cells=[25, 25, 13]"],
    "office_small": ["scans=3", "sweep.tilts_rad=[0]", "map.centre_m=[-5, -2, 1]", "map.size_m=[5, 5, 2]", "map.cells=[65, 65, 21]",
                     "metrics.pose_spacing_m=2"],
    "recognition": ["max_views=2"],
    "change_detection": ["max_views=2"],
    "trajectory": [],
}


def state_hash(build, episode, threads, folder):
    """Of one run. Ends the program if it fails."""
    out = folder / f"{episode}-{build}-{threads}"
    command = [ROOT / "build" / build / "vantage", "run", ROOT / "assets/episodes" / f"{episode}.yaml", "--out", out, "-q",
               "--set", f"threads={threads}", *EPISODES[episode]]
    done = subprocess.run(list(map(str, command)), cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stderr}")
    return json.loads((out / "metrics.json").read_text(encoding="utf-8"))["state_hash"]


def compare(episode, folder):
    """{(build, threads): state hash}"""
    return {(build, threads): state_hash(build, episode, threads, folder) for build in BUILDS for threads in THREADS}


def main():
    machine = next((line.split(":")[1].strip() for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
                    if line.startswith("model name")), platform.machine())
    differ = False
    with tempfile.TemporaryDirectory() as folder:
        for episode in EPISODES:
            hashes = compare(episode, Path(folder))
            same = len(set(hashes.values())) == 1
            differ = differ or not same
            for (build, threads), value in hashes.items():
                print(f"{episode:18} {BUILDS[build]:20} {threads} threads  {value}", flush=True)
            reliability_page.write_row("bits", [
                f"{episode}, {machine}", hashes["release", 1], "the same" if same else "differ: " + ", ".join(
                    f"{build} {threads}" for (build, threads), value in hashes.items() if value != hashes["release", 1]),
                reliability_page.commit(), reliability_page.today()])
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
