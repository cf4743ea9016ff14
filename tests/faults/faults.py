"""Kills, full disks and other faults of the machine. See ./faults."""

import argparse
import os
import random
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests" / "support"), str(Path(__file__).parent)]
import disks  # noqa: E402
import kills  # noqa: E402
import reliability_page  # noqa: E402
import together  # noqa: E402
from commands import Commands  # noqa: E402

SUITES = {
    "kills": kills.kills, "writes": disks.failing_writes, "full": disks.full_disk, "readonly": disks.read_only,
    "memory": disks.little_memory, "together": together.two_processes, "render": together.renderings,
}


def main():
    parser = argparse.ArgumentParser(prog="./faults", description="Faults of the machine, of bounded length.")
    parser.add_argument("suite", nargs="?", choices=sorted(SUITES), help="one of them; else all")
    parser.add_argument("number", nargs="?", type=int, help="of kills (100), of renderings (3)")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    failures = 0
    with tempfile.TemporaryDirectory(prefix="vantage-faults-") as scratch:
        commands = Commands(Path(scratch))
        for name in [arguments.suite] if arguments.suite else list(SUITES):
            rng = random.Random(f"{name} {arguments.seed}")
            for what, tries, findings in SUITES[name](commands, rng, arguments.number):
                for finding in findings:
                    print(f"{what}: {finding}", flush=True)
                print(f"{what}: {tries} tries, {len(findings)} findings", flush=True)
                reliability_page.write_row("faults", [what, tries, len(findings), arguments.seed,
                                                      reliability_page.commit(), reliability_page.today()])
                failures += len(findings)
    return 1 if failures else 0


if __name__ == "__main__":
    os.umask(0o022)
    sys.exit(main())
