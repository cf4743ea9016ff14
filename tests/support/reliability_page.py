"""Rows of the tables of docs/reliability.md. ./fuzz, ./mutate, ./faults and ./check resets write them, nobody else.

A table stands below a line `<!-- rows: NAME -->`; a row is known by its first cell.
"""

import datetime
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "reliability.md"


def commit():
    """The commit at hand; -dirty if the program or its tests differ from it; empty without git. As CMakeLists.txt has it."""
    say = lambda *arguments: subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True).stdout.strip()
    dirty = say("status", "--porcelain", "--untracked-files=no", "--", ".", ":!bench/results", ":!bench/RESULTS.md",
                ":!docs/reliability.md")
    return say("rev-parse", "--short", "HEAD") + ("-dirty" if dirty else "")


def today():
    return datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d")


def _table(lines, name):
    """First and last line of the table's rows, its head left out."""
    begin = lines.index(f"<!-- rows: {name} -->") + 1
    while not lines[begin].startswith("|"):
        begin += 1
    begin += 2
    end = begin
    while end < len(lines) and lines[end].startswith("|"):
        end += 1
    return begin, end


def _cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def rows(name, page=PAGE):
    """{first cell: all cells}, as the page has them."""
    lines = page.read_text(encoding="utf-8").split("\n")
    begin, end = _table(lines, name)
    return {_cells(line)[0]: _cells(line) for line in lines[begin:end]}


def write_row(name, cells, page=PAGE):
    """Puts the row in place of the one of that first cell, or after the others."""
    lines = page.read_text(encoding="utf-8").split("\n")
    begin, end = _table(lines, name)
    row = "| " + " | ".join(str(cell) for cell in cells) + " |"
    for i in range(begin, end):
        if _cells(lines[i])[0] == str(cells[0]):
            lines[i] = row
            break
    else:
        lines.insert(end, row)
    part = page.with_suffix(".part")
    part.write_text("\n".join(lines), encoding="utf-8")
    part.replace(page)
