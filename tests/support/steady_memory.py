"""steady_memory.py RESETS [BUILD_DIR]: resets an environment of the Python package so often, and writes into
docs/reliability.md how much memory the process held on the way. Exit code 1 if that grows; ./check runs it."""

import os
import re
import subprocess
import sys
from pathlib import Path

import reliability_page

ROOT = Path(__file__).resolve().parents[2]
TEST = ROOT / "tests" / "python" / "test_fuzz.py"
TOLD = re.compile(r"^(\d+) resets: (\d+) kB$", re.MULTILINE)


def resident_kb(text):
    """{resets so far: kB}, as the test tells."""
    return {int(resets): int(kb) for resets, kb in TOLD.findall(text)}


def row(kb, good):
    """Where it stood at the first and the last line, and the growth of the last two thirds."""
    first, last = min(kb), max(kb)
    third = min(kb, key=lambda resets: abs(resets - last / 3))
    growth = 1000 * (kb[last] - kb[third]) / (last - third)
    mb = lambda value: f"{value / 1000:.1f}"
    return ["tabletop", last, mb(kb[first]), mb(kb[third]), mb(kb[last]), mb(growth), "steady" if good else "GROWS",
            reliability_page.commit(), reliability_page.today()]


def run(resets, build):
    environment = {**os.environ, "PYTHONPATH": str(build / "python"), "VANTAGE_BINARY": str(build / "vantage"),
                   "VANTAGE_SOURCE": str(ROOT), "VANTAGE_FUZZ_RESETS": str(resets), "PYTHONDONTWRITEBYTECODE": "1"}
    done = subprocess.run([sys.executable, "-W", "error", str(TEST), "Fuzz.test_resets_do_not_grow"], cwd=TEST.parent,
                          env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    print(done.stdout, end="")
    return done.returncode == 0, resident_kb(done.stdout)


def main():
    resets = int(sys.argv[1])
    if resets < 300:
        sys.exit(f"RESETS: {resets} is below 300, of which memory tells nothing")
    good, kb = run(resets, Path(sys.argv[2]) if len(sys.argv) > 2 else ROOT / "build" / "release")
    if len(kb) > 2:
        reliability_page.write_row("resets", row(kb, good))
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
