"""Two processes on one folder, and many renderings in a row."""

import re
import time

from commands import CODES, said

RUNNING = re.compile(r"\b[1-9][0-9]* running of [0-9]+ episodes")


def two_processes(commands, rng, _number):
    """Both begin at nearly the same time. Each ends with the results or says why not, and they are whole."""
    tries = 8
    for name, command in commands.all.items():
        findings = []
        for _ in range(tries):
            out = commands.folder()
            first = command.start(out, again=True)
            time.sleep(rng.uniform(0.0, 0.5 * command.duration_s) * rng.choice((0, 1)))
            second = command.start(out, again=True)
            for process in (first, second):
                process.wait(300)
            codes, texts = [first.returncode, second.returncode], [said(first), said(second)]
            for code, text in zip(codes, texts):
                if code == 1 and RUNNING.search(text):  # a sweep that the other has not finished
                    continue
                if code not in (0, 2, 5):
                    findings.append(f"exit code {code} ({CODES.get(code, 'not in the contract')}): {text.strip()[-200:]}")
            if 0 not in codes:
                findings.append(f"neither is done: {codes} {' '.join(texts)[-300:]}")
            findings += [why for why in [command.wrong(out)] if why] + command.half_written(out)
        yield f"two processes on one folder: {name}", tries, findings


def renderings(commands, _rng, number):
    """Of forty objects, in a row, by as many processes as there are cores; each gives the same files."""
    command, findings, tries = commands.rendering_of(40), [], number or 3
    for _ in range(tries):
        out = commands.folder()
        code, text = command.run(out)
        findings += [f"exit code {code}: {text.strip()[-200:]}"] if code != 0 else []
        findings += [why for why in [command.wrong(out)] if why]
    yield "renderings of 40 objects in a row", tries, findings
