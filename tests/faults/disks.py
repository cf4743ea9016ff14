"""Disks that are full, broken or read-only, and little memory."""

import contextlib
import errno
import resource
import shutil
import subprocess
from pathlib import Path

from commands import CODES

MOST_WRITES = 30  # of a command that are let fail: the first ten, and others at random
SOURCE = Path(__file__).parent / "failing_writes.c"


def judged(command, out, code, text, what, also=()):
    """Findings: the code is of the contract, the line says what happened, no file is half written."""
    findings = []
    if code == 0:
        findings += [why for why in [command.wrong(out)] if why]
    elif code not in {5, *also}:
        findings.append(f"exit code {code} ({CODES.get(code, 'not in the contract')}): {text.strip()[-300:]}")
    elif not text.strip():
        findings.append(f"exit code {code} without a word")
    if out.exists():
        findings += command.half_written(out)
    return [f"{what}: {finding}" for finding in findings]


def library(scratch):
    made = scratch / "failing_writes.so"
    if not made.exists():
        subprocess.run(["cc", "-O1", "-shared", "-fPIC", SOURCE, "-o", made, "-ldl"], check=True)
    return made


def failing_writes(commands, rng, _):
    preload = library(commands.scratch)
    for name, command in commands.all.items():
        counts = commands.scratch / "counts"
        environment = {"LD_PRELOAD": str(preload), "VANTAGE_FAULT_UNDER": str(commands.scratch / "tries"),
                       "VANTAGE_FAULT_COUNT": str(counts)}
        counts.unlink(missing_ok=True)
        command.run(commands.folder(), environment=environment)
        most = max(int(line) for line in counts.read_text().split())
        places = sorted({*range(1, min(most, 10) + 1), *(rng.randint(1, most) for _ in range(MOST_WRITES - 10))})
        findings, tries = [], 0
        for at in places:
            for number in (errno.ENOSPC, errno.EIO):
                out = commands.folder()
                fault = {**environment, "VANTAGE_FAULT_AT": str(at), "VANTAGE_FAULT_ERRNO": str(number)}
                if rng.random() < 0.5:
                    fault["VANTAGE_FAULT_ONCE"] = "1"
                code, text = command.run(out, environment=fault)
                what = f"{errno.errorcode[number]} at write {at} of {most}"
                findings += judged(command, out, code, text, what)
                findings += after(command, out, what)
                tries += 1
        yield f"no write from the n-th on: {name}", tries, findings


def after(command, out, what):
    """Once the fault is mended, the same command gives the same results."""
    code, text = command.run(out, again=True)
    why = command.wrong(out) if code == 0 else f"exit code {code}: {text.strip()[-200:]}"
    return [f"{what}, run again: {why}"] if why else []


@contextlib.contextmanager
def mounted(folder, options):
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", folder], check=True)
    try:
        yield folder
    finally:
        subprocess.run(["umount", "-l", folder], check=False)


def can_mount(scratch):
    try:
        with mounted(scratch / "mount", "size=64k"):
            return True
    except (OSError, subprocess.CalledProcessError):
        return False


def full_disk(commands, _rng, _number):
    """A tmpfs that is too small, for root."""
    if not can_mount(commands.scratch):
        return
    for name, command in commands.all.items():
        findings, sizes = [], ("16k", "64k", "256k", "1m", "4m")
        for size in sizes:
            with mounted(commands.folder().parent / "disk", f"size={size}") as disk:
                code, text = command.run(disk / "out")
                findings += judged(command, disk / "out", code, text, f"disk of {size}")
        yield f"full disk: {name}", len(sizes), findings


def read_only(commands, _rng, _number):
    """A folder that nothing can be written into: mounted so for root, else without the permission."""
    root = can_mount(commands.scratch)
    for name, command in commands.all.items():
        out = commands.folder()
        with contextlib.ExitStack() as stack:
            folder = out.parent / "closed"
            if root:
                stack.enter_context(mounted(folder, "ro"))
            else:
                folder.mkdir()
                folder.chmod(0o555)
            code, text = command.run(folder / "out")
            findings = judged(command, folder / "out", code, text, "read-only folder")
            if code == 0:
                findings.append("read-only folder: it was written into")
            if str(folder) not in text:
                findings.append(f"read-only folder: the message does not name it: {text.strip()[-200:]}")
        shutil.rmtree(folder, ignore_errors=True)
        yield f"read-only folder: {name}", 1, findings


def little_memory(commands, _rng, _number):
    """An address space of less and less: an ordinary end with a line, or the results."""
    for name, command in commands.all.items():
        findings, sizes_mb = [], (64, 128, 256, 512, 1024, 2048)
        for size_mb in sizes_mb:
            out, limit = commands.folder(), size_mb << 20
            code, text = command.run(out, preexec_fn=lambda limit=limit: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
            # 127: the loader finds no room for the libraries, before there is a program that could speak.
            findings += judged(command, out, code, text, f"{size_mb} MB", also=(1, 3, 6, 70, 127))
            findings += after(command, out, f"{size_mb} MB")
        yield f"little memory: {name}", len(sizes_mb), findings
