"""Breaks a line at a time in a copy of the tree and sees whether the tests of its folder notice. See ./mutate."""

import argparse
import fcntl
import hashlib
import json
import subprocess
import sys
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests" / "support"), str(Path(__file__).parent)]
import reliability_page  # noqa: E402
from mutations import Mutant, draws  # noqa: E402
from work_copy import WorkCopy, folder_of, run_tests  # noqa: E402

OUT = ROOT / "out" / "mutate"
HERE = Path(__file__).parent
PATHS = ["src", "planners", "sim"]
GOAL = 0.92


def source_files(paths):
    listed = subprocess.run(["git", "ls-files", "--", *paths], cwd=ROOT, capture_output=True, text=True, check=True)
    return sorted(file for file in listed.stdout.split() if file.endswith((".cpp", ".hpp")))


def equivalents():
    """Mutants that mean the same, found by hand: {key: why}."""
    entries = yaml.safe_load((HERE / "equivalent.yaml").read_text(encoding="utf-8")) or []
    return {Mutant(entry["file"], 0, entry["old"], entry["new"]).key(): entry["why"] for entry in entries}


def named():
    """Mutants that somebody has named; each stands in one line of its file."""
    found = []
    for entry in yaml.safe_load((HERE / "named.yaml").read_text(encoding="utf-8")):
        lines = (ROOT / entry["file"]).read_text(encoding="utf-8").split("\n")
        places = [i for i, line in enumerate(lines) if entry["old"] in line]
        place = places[entry.get("nth", 1) - 1] if len(places) >= entry.get("nth", 1) else None
        if place is None or ("nth" not in entry and len(places) > 1):
            sys.exit(f"named.yaml: {entry['file']}: '{entry['old']}' stands in {len(places)} lines, not in one")
        found.append(Mutant(entry["file"], place + 1, lines[place], lines[place].replace(entry["old"], entry["new"])))
    return found


def apply(copy, mutant):
    file = copy.folder / mutant.file
    lines = file.read_text(encoding="utf-8").split("\n")
    lines[mutant.line - 1] = mutant.new
    file.write_text("\n".join(lines), encoding="utf-8")


def verdict(copy, mutant):
    """killed, survived, same (the programs are those they were) or no program."""
    folder = folder_of(mutant.file)
    copy.prepare(folder)
    apply(copy, mutant)
    try:
        changed = copy.built(copy.programs[folder])
        if changed is None:
            return "no program"
        if not changed:
            return "same"
        nearest = [(program, program.suites.get(Path(mutant.file).stem)) for program in changed]
        for program, suites in [pair for pair in nearest if pair[1]] + [(program, None) for program in changed]:
            passed, _ = run_tests(program, suites, 10 + 4 * program.cpu_s)
            if not passed:
                return "killed"
        return "survived"
    finally:
        copy.restore(mutant.file)


class Record:
    """What came of each mutant, a line of JSON each, kept as long as the sources and tests are the same."""

    def __init__(self, file, sources):
        self.file = file
        file.parent.mkdir(parents=True, exist_ok=True)
        lines = file.read_text(encoding="utf-8").splitlines() if file.exists() else []
        same = bool(lines) and lines[0] == json.dumps(sources)
        self.known = {}
        for line in lines[1:] if same else []:
            try:
                key, result = json.loads(line)
            except ValueError:  # the last line of a run that was killed
                continue
            self.known[key] = result
        if not same:
            file.write_text(json.dumps(sources) + "\n", encoding="utf-8")

    def add(self, mutant, result):
        self.known[mutant.place()] = result
        with open(self.file, "a", encoding="utf-8") as file:
            file.write(json.dumps([mutant.place(), result]) + "\n")


def state_of_tree():
    """Of all that a verdict may depend on."""
    paths = [*PATHS, "tests", "cmake", "models", "assets", "CMakeLists.txt", "CMakePresets.json"]
    listed = subprocess.run(["git", "ls-files", "-z", "--", *paths], cwd=ROOT, capture_output=True, text=True, check=True)
    digest = hashlib.sha256()
    for file in sorted(name for name in listed.stdout.split("\0") if (ROOT / name).is_file()):
        digest.update(file.encode() + (ROOT / file).read_bytes())
    return digest.hexdigest()


def alone():
    """Holds the copy of the tree until the program ends: two would break each other's lines."""
    OUT.mkdir(parents=True, exist_ok=True)
    lock = open(OUT / "lock", "w", encoding="utf-8")
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        sys.exit(f"{OUT}: another ./mutate is at work there")
    return lock


def try_all(mutants, wanted, verdicts):
    """Counts by verdict, and the survivors; stops at `wanted` mutants that count."""
    lock = alone()  # noqa: F841: held
    record = Record(OUT / verdicts, state_of_tree())
    copy = WorkCopy(OUT / "tree")
    copy.update()
    by_hand, counts, survivors = equivalents(), {}, []
    for mutant in mutants:
        if counts.get("killed", 0) + counts.get("survived", 0) >= wanted:
            break
        result = "equivalent" if mutant.key() in by_hand else record.known.get(mutant.place())
        if result is None:
            result = verdict(copy, mutant)
            record.add(mutant, result)
        counts[result] = counts.get(result, 0) + 1
        if result == "survived":
            survivors.append(mutant)
        if result in ("killed", "survived"):
            print(f"{result:8} {mutant.diff()}", flush=True)
    return counts, survivors


def report(name, counts, survivors, seed):
    killed, lived = counts.get("killed", 0), counts.get("survived", 0)
    share = killed / max(1, killed + lived)
    print(f"\n{killed} of {killed + lived} mutants killed, {100 * share:.1f} %; left out: "
          f"{counts.get('no program', 0)} that do not compile, {counts.get('same', 0)} that compile to the same program, "
          f"{counts.get('equivalent', 0)} equivalent ones")
    for mutant in survivors:
        print("survived " + mutant.diff())
    reliability_page.write_row("mutate", [name, killed + lived, killed, f"{100 * share:.1f} %", seed,
                                          counts.get("equivalent", 0), reliability_page.commit(), reliability_page.today()])
    return share


def main():
    parser = argparse.ArgumentParser(prog="./mutate", description="Breaks a line at a time and runs the tests of its folder.")
    parser.add_argument("words", nargs="*", metavar="[N] [PATH...]",
                        help="N mutants that count (300), drawn in the files below PATH (src planners sim)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--named", action="store_true", help="those of tests/mutation/named.yaml; all must be killed")
    arguments = parser.parse_intermixed_args()
    if arguments.named:
        mutants = named()
        counts, survivors = try_all(mutants, len(mutants), "named.jsonl")
        report("named", counts, survivors, "-")
        return 0 if counts.get("killed", 0) == len(mutants) else 1  # one that does not compile shows nothing
    words = arguments.words
    number = int(words.pop(0)) if words and words[0].isdigit() else 300
    paths = words or PATHS
    files = source_files(paths)
    if not files:
        parser.error(f"{' '.join(paths)}: no sources of git's there")
    name = " ".join(paths)
    verdicts = f"{name.replace('/', '_').replace(' ', '-')}-{arguments.seed}.jsonl"
    counts, survivors = try_all(draws(ROOT, files, arguments.seed), number, verdicts)
    return 0 if report(name, counts, survivors, arguments.seed) >= GOAL else 1


if __name__ == "__main__":
    sys.exit(main())
