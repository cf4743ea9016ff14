"""Runs libFuzzer on the targets beside this file. See ./fuzz."""

import argparse
import concurrent.futures
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests" / "support"), str(Path(__file__).parent)]
import reliability_page  # noqa: E402
import seeds  # noqa: E402

OUT = ROOT / "out" / "fuzz"
BUILD = ROOT / "build" / "fuzz"
TARGETS = sorted(file.stem for file in (Path(__file__).parent / "targets").glob("*.cpp"))
# Readers that go by way of other libraries take longer inputs than they can be fed often.
MAX_BYTES = {"mjcf": 4096, "episode": 4096, "study": 4096, "recipe": 4096, "onnx": 16384}
LIMITS = ["-rss_limit_mb=1024", "-timeout=5", "-timeout_exitcode=78", "-detect_leaks=1"]


def build(targets):
    if not (BUILD / "build.ninja").exists():
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        subprocess.run(["cmake", "--preset", "fuzz", *launcher], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    names = [f"fuzz_{name}" for name in targets]
    subprocess.run(["cmake", "--build", "--preset", "fuzz", "--target", *names], cwd=ROOT, check=True, stdout=sys.stderr)


def environment(scratch):
    """Leaks of other libraries, when an error of theirs is caught, are named in leaks.txt."""
    suppressions = Path(__file__).parent / "leaks.txt"
    return {**os.environ, "TMPDIR": str(scratch), "OPENCV_LOG_LEVEL": "OFF",
            "ASAN_OPTIONS": "detect_leaks=1:allocator_may_return_null=0",
            "LSAN_OPTIONS": f"suppressions={suppressions}:print_suppressions=0",
            "UBSAN_OPTIONS": "print_stacktrace=1"}


def program(name):
    return BUILD / "tests" / "fuzz" / f"fuzz_{name}"


def run(name, seconds, scratch):
    """Runs one target; its number of inputs and the files of its findings."""
    corpus, findings = OUT / "corpus" / name, OUT / "findings"
    for folder in (corpus, findings):
        folder.mkdir(parents=True, exist_ok=True)
    before = set(findings.glob(f"{name}-*"))
    dictionary = OUT / "words" / f"{name}.txt"
    command = [program(name), *LIMITS, f"-max_total_time={seconds:.0f}", f"-max_len={MAX_BYTES.get(name, 65536)}",
               "-print_final_stats=1", "-close_fd_mask=3", f"-artifact_prefix={findings / name}-"]
    if dictionary.exists():
        command.append(f"-dict={dictionary}")
    log = OUT / f"{name}.log"
    with open(log, "wb") as file:
        code = subprocess.run([*map(str, command), str(corpus), str(OUT / "seeds" / name)], stdout=file, stderr=file,
                              env=environment(scratch), cwd=scratch, check=False).returncode
    text = log.read_text(encoding="utf-8", errors="replace")
    found = re.search(r"number_of_executed_units: (\d+)", text)
    new = sorted(set(findings.glob(f"{name}-*")) - before)
    if code != 0 and not new:
        new = [log]
    return int(found.group(1)) if found else 0, new


def write_row(name, inputs, findings):
    former = reliability_page.rows("fuzz").get(name)
    so_far = int(former[1].replace(" ", "")) if former else 0
    spaced = lambda number: f"{number:,}".replace(",", " ")
    reliability_page.write_row("fuzz", [name, spaced(so_far + inputs), spaced(inputs), len(findings),
                                        reliability_page.commit(), reliability_page.today()])


def again(file):
    name = next((target for target in TARGETS if Path(file).name.startswith(target + "-")), None)
    if name is None:
        sys.exit(f"{file}: starts with the name of no target; known: {' '.join(TARGETS)}")
    build([name])
    with tempfile.TemporaryDirectory(prefix="vantage-fuzz-", dir=scratch_root()) as scratch:
        return subprocess.run([program(name), *LIMITS, str(Path(file).resolve())], env=environment(scratch),
                              cwd=scratch, check=False).returncode


def scratch_root():
    return "/dev/shm" if os.access("/dev/shm", os.W_OK) else None


def fuzz(minutes, targets, jobs):
    build(targets)
    seeds.make(targets, OUT)
    seconds = 60.0 * minutes * jobs / len(targets)
    total, all_findings = 0, []
    with tempfile.TemporaryDirectory(prefix="vantage-fuzz-", dir=scratch_root()) as scratch, \
            concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        runs = {pool.submit(run, name, max(2.0, seconds), scratch): name for name in targets}
        for done in concurrent.futures.as_completed(runs):
            inputs, findings = done.result()
            total += inputs
            all_findings += findings
            write_row(runs[done], inputs, findings)
            print(f"{runs[done]}: {inputs} files, {len(findings)} findings", *findings, flush=True)
    print(f"{total} files in all, {len(all_findings)} findings")
    return 1 if all_findings else 0


def main():
    parser = argparse.ArgumentParser(prog="./fuzz", description="Hands made-up files to every reader.")
    parser.add_argument("minutes", help="of all targets together; or `list`, or `again`")
    parser.add_argument("targets", nargs="*", metavar="TARGET", help="all if none is named")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="targets at a time (all cores)")
    arguments = parser.parse_args()
    if arguments.minutes == "list":
        print("\n".join(TARGETS))
        return 0
    if arguments.minutes == "again":
        return max(again(file) for file in arguments.targets)
    unknown = sorted(set(arguments.targets) - set(TARGETS))
    if unknown:
        parser.error(f"no target {unknown[0]}; known: {' '.join(TARGETS)}")
    try:
        minutes = float(arguments.minutes)
    except ValueError:
        parser.error(f"'{arguments.minutes}' is no number of minutes")
    return fuzz(minutes, arguments.targets or TARGETS, arguments.jobs)


if __name__ == "__main__":
    sys.exit(main())
