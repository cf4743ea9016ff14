"""Signals at random moments."""

import os
import signal
import subprocess
import time

from commands import CODES, said

SIGNALS = (signal.SIGKILL, signal.SIGTERM, signal.SIGINT)
ENDS_AFTER_S = 60.0


def one_kill(command, out, number, after_s):
    """What went wrong; nothing if all is well."""
    process = command.start(out, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))
    time.sleep(after_s)
    process.send_signal(number)
    try:
        process.wait(ENDS_AFTER_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
        return [f"{number.name} after {after_s:.2f} s: does not end"]
    findings, text, code = [], said(process), process.returncode
    wait_for_children(out)
    # A signal before the first line of main() has its default effect.
    good = {0, -number, 130 if number == signal.SIGINT else 143}
    if code not in good:
        findings.append(f"exit code {code} ({CODES.get(code, 'not in the contract')}): {text.strip()[-200:]}")
    findings += command.half_written(out) if out.exists() else []
    again_code, again_text = command.run(out, again=True)
    if again_code != 0:
        findings.append(f"cannot be run again: {again_code}: {again_text.strip()[-200:]}")
    else:
        findings += [why for why in [command.wrong(out)] if why]
    return [f"{number.name} after {after_s:.2f} s: {finding}" for finding in findings]


def wait_for_children(out):
    """A process that is killed takes its own with it, a moment later."""
    for _ in range(100):
        if not any(str(out) in line for line in command_lines()):
            return
        time.sleep(0.05)


def command_lines():
    for process in os.listdir("/proc"):
        if process.isdigit():
            try:
                with open(f"/proc/{process}/cmdline", "rb") as file:
                    yield file.read().replace(b"\0", b" ").decode(errors="replace")
            except OSError:
                continue


def kills(commands, rng, number):
    """25 of each command, unless another number is asked for in all."""
    each = max(1, (number or 100) // len(commands.all))
    for name, command in commands.all.items():
        findings = []
        for _ in range(each):
            findings += one_kill(command, commands.folder(), rng.choice(SIGNALS),
                                 rng.uniform(0.0, 1.1 * command.duration_s))
        yield f"killed: {name}", each, findings
