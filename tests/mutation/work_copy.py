"""A copy of the tree to break, its build, and its test programs."""

import hashlib
import os
import re
import resource
import shutil
import signal
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# Folders without tests of their own, and whose tests hold them.
TESTED_BY = {"recipe": "cli", "mcap": "cli"}
MEMORY_BYTES = 8 << 30
# A read past an end, or of what nothing was written to, fails as a test would, instead of by luck.
CHECKS = ["-D_GLIBCXX_ASSERTIONS", "-DEIGEN_INITIALIZE_MATRICES_BY_NAN"]


def folder_of(file):
    """The folder of tests for a source: planners, sim, or that of the folder of src."""
    parts = Path(file).parts
    folder = parts[1] if parts[0] == "src" else parts[0]
    return TESTED_BY.get(folder, folder)


@dataclass
class Program:
    name: str
    path: Path
    also: Path | None = None  # the program that it runs
    digest: str = ""
    cpu_s: float = 0.0
    suites: dict = field(default_factory=dict)  # {stem of a test file: names of its suites}


class WorkCopy:
    """out/mutate/tree: what git knows of, as it lies in the tree. Only what changed is copied, so that only that is
    built again."""

    def __init__(self, folder):
        self.folder = folder
        self.build = folder / "build" / "release"
        self.programs = {}

    def update(self):
        listed = subprocess.run(["git", "ls-files", "-z", "-c", "-o", "--exclude-standard"], cwd=ROOT,
                                capture_output=True, text=True, check=True).stdout.split("\0")
        files = {name for name in listed if name and (ROOT / name).is_file()}
        for name in sorted(files):
            self.restore(name)
        for old in [p for p in self.folder.rglob("*") if p.is_file() and "build" not in p.relative_to(self.folder).parts[:1]]:
            if str(old.relative_to(self.folder)) not in files:
                old.unlink()
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        # A line that changes has one file compiled again, not all of its batch.
        options = ["-DVANTAGE_BUILD_BENCH=OFF", "-DVANTAGE_BUILD_PYTHON=OFF", "-DVANTAGE_UNITY_BUILD=OFF"]
        self._run(["cmake", "--preset", "release", *options, f"-DCMAKE_CXX_FLAGS={' '.join(CHECKS)}", *launcher])

    def restore(self, name):
        source, copy = ROOT / name, self.folder / name
        if copy.exists() and copy.read_bytes() == source.read_bytes():
            return
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, copy)  # of now, so that it is built again

    def _run(self, command, **options):
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False, **options)
        if done.returncode != 0:
            raise SystemExit(f"{' '.join(map(str, command))}:\n{done.stdout[-3000:]}{done.stderr[-3000:]}")

    def prepare(self, folder):
        """Builds the test programs of the folder as they should be, and sees them pass."""
        if folder in self.programs:
            return
        tests = self.folder / "tests" / folder
        if not (tests / "CMakeLists.txt").exists():
            raise SystemExit(f"{folder}: has no tests of its own")
        listing = "\n".join(file.read_text() for file in sorted(tests.rglob("CMakeLists.txt")))
        names = [f"test_{name}" for name in re.findall(r"^\s*vantage_test\((\w+)", listing, re.M)]
        self._run(["cmake", "--build", self.build, "--target", *names])
        programs = []
        for name in names:
            also = self.build / "vantage" if f"add_dependencies({name} vantage)" in listing else None
            program = Program(name, next(self.build.rglob(name)), also)
            program.digest = digest_of(program)
            program.suites = self._suites(tests)
            passed, program.cpu_s = run_tests(program, None, 3600)
            if not passed:
                raise SystemExit(f"{name} fails without any change")
            programs.append(program)
        self.programs[folder] = programs

    def _suites(self, tests):
        pattern = re.compile(r"^(?:TEST|TEST_F|TEST_P|TYPED_TEST|RC_GTEST_PROP|RC_GTEST_FIXTURE_PROP)\(\s*(\w+)", re.M)
        return {file.stem.removesuffix("_test"): set(pattern.findall(file.read_text())) for file in tests.rglob("*_test.cpp")}

    def built(self, programs):
        """Those of the programs that are others than they should be; None if it does not compile."""
        environment = {**os.environ, "CCACHE_DISABLE": "1"}
        done = subprocess.run(["cmake", "--build", str(self.build), "--target", *[p.name for p in programs]],
                              cwd=self.folder, capture_output=True, text=True, check=False, env=environment)
        if done.returncode != 0:
            return None
        return [program for program in programs if digest_of(program) != program.digest]


def digest_of(program):
    digest = hashlib.sha256(program.path.read_bytes())
    if program.also is not None:
        digest.update(program.also.read_bytes())
    return digest.hexdigest()


def run_tests(program, suites, cpu_limit_s):
    """Whether all passed, and the CPU time. What takes far more time or memory than before has failed."""
    command = [str(program.path), "--gtest_brief=1", "--gtest_fail_fast"]
    if suites is not None:
        command.append("--gtest_filter=" + ":".join(f"*{suite}.*:*{suite}/*" for suite in sorted(suites)))

    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (int(cpu_limit_s), int(cpu_limit_s) + 5))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        os.setpgid(0, 0)

    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    environment = {**os.environ, "RC_PARAMS": os.environ.get("RC_PARAMS", "seed=1")}
    # In the folder of its own: what it finds by the working directory is the copy's.
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, preexec_fn=limit,
                          env=environment, cwd=program.path.parent) as process:
        try:
            passed = process.wait(timeout=60 + 10 * cpu_limit_s) == 0
        except subprocess.TimeoutExpired:  # waits for what does not come
            passed = False
        finally:
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return passed, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
