"""Small changes of a line of C++, as a slip of the pen would make them."""

import random
import re
from dataclasses import dataclass

# A change of one operator or name into another; both stand as whole words or between blanks.
OPERATORS = {
    " + ": [" - "], " - ": [" + "], " * ": [" / "], " / ": [" * "], " % ": [" * "],
    " += ": [" -= "], " -= ": [" += "], " *= ": [" /= "], " /= ": [" *= "],
    " < ": [" <= ", " > "], " <= ": [" < ", " > "], " > ": [" >= ", " < "], " >= ": [" > ", " < "],
    " == ": [" != "], " != ": [" == "], " && ": [" || "], " || ": [" && "],
}
WORDS = {
    "std::min": "std::max", "std::max": "std::min", "true": "false", "false": "true", "std::floor": "std::ceil",
    "std::ceil": "std::floor", "std::sin": "std::cos", "std::cos": "std::sin", "minCoeff": "maxCoeff",
    "maxCoeff": "minCoeff", "cwiseMin": "cwiseMax", "cwiseMax": "cwiseMin", "front": "back", "back": "front",
    "continue": "break", "break": "continue", "any_of": "all_of", "all_of": "any_of", "std::exp": "std::log",
    "upper_bound": "lower_bound", "lower_bound": "upper_bound", "min_element": "max_element",
    "max_element": "min_element",
}
NUMBER = re.compile(r"(?<![\w.'\"])(\d+\.\d*(?:e-?\d+)?|\d+(?:e-?\d+)?)(?=[FfUuLl]*(?![\w.]))")
# Whose arguments may stand in any order.
COMMUTATIVE = {"min", "max"}
PARAMETER = re.compile(r"(const )?[\w:<>]+[&*]* \w+( = .*)?$")  # of a declaration, not of a call
STATEMENT = re.compile(r"(if|for) \(|[^ (]+\(|[^ =]+ [-+*/|&]?= |[-+]{2}|[^ ]+([-+]{2});")
# Lines that decide nothing: what is left unchecked is asserted, said, only named, or how fast: memory
# asked for ahead of time, and threads, on which no result depends.
DULL = re.compile(r"^\s*(#|using |namespace |static_assert|template|class |struct |enum |///|//|public:|private:|"
                  r"protected:|case |default:|friend |throw |expects\(|log_|fmt::print)|\bexpects\(|static constexpr|"
                  r"\[\[nodiscard\]\].*;$|\.summary|\.source|\.formula|std::fprintf|\.reserve\(|\bint threads = 1\b")


@dataclass(frozen=True)
class Mutant:
    file: str  # from the repository's root
    line: int  # from 1
    old: str
    new: str

    def key(self):
        return f"{self.file}\n{self.old.strip()}\n{self.new.strip()}"

    def place(self):
        """The key, and which of lines that are alike."""
        return f"{self.key()}\n{self.line}"

    def diff(self):
        return f"{self.file}:{self.line}\n  - {self.old.strip()}\n  + {self.new.strip()}"


def code_of(text):
    """The lines with strings and comments blanked, so that places in them stay the same."""
    def blank(match):
        found = match.group(0)
        keep = found[0] + " " * (len(found) - 2) + found[-1] if found[0] in "\"'" and len(found) > 1 else ""
        return keep or re.sub(r"[^\n]", " ", found)
    pattern = r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|(?<![0-9])'(?:\\.|[^'\\\n])'"
    return re.sub(pattern, blank, text, flags=re.S).split("\n")


def other_numbers(text):
    if "." in text or "e" in text:
        value = float(text)
        others = [value * 2, value / 2] if value else [1.0]
        return [f"{other!r}" for other in others]
    value = int(text)
    return [str(value + 1)] + ([str(value - 1)] if value > 0 else [])


def closing(code, opening):
    """The place of the bracket that closes the one at `opening`; -1 if it is on another line."""
    depth = 0
    for i in range(opening, len(code)):
        depth += (code[i] in "([{") - (code[i] in ")]}")
        if depth == 0:
            return i
    return -1


def arguments_of(code, opening, end):
    """(begin, end) of each argument between two brackets; commas between < and > count, compilers tell."""
    found, depth, begin = [], 0, opening + 1
    for i in range(opening + 1, end + 1):
        if (code[i] == "," and depth == 0) or i == end:
            found.append((begin, i))
            begin = i + 1
        depth += (code[i] in "([{") - (code[i] in ")]}")
    return found


def swapped(line, code):
    for match in re.finditer(r"\b(\w*\w)\(", code):
        if match.group(1) in COMMUTATIVE:
            continue
        opening = match.end() - 1
        end = closing(code, opening)
        if end < 0:
            continue
        arguments = arguments_of(code, opening, end)
        for (a, b), (c, d) in zip(arguments, arguments[1:]):
            first, second = line[a:b].strip(), line[c:d].strip()
            if first and second and first != second and not PARAMETER.match(first) and not PARAMETER.match(second):
                gap = line[c:d][: len(line[c:d]) - len(line[c:d].lstrip())]
                lead = line[a:b][: len(line[a:b]) - len(line[a:b].lstrip())]
                yield line[:a] + lead + second + "," + gap + first + line[d:]


def negated(line, code):
    for match in re.finditer(r"\b(if|while) \(", code):
        opening = match.end() - 1
        end = closing(code, opening)
        if end > 0 and ";" not in code[opening:end]:
            yield f"{line[:opening]}(!({line[opening + 1:end]})){line[end + 1:]}"
    for match in re.finditer(r"(?<![\w)])!(?=[\w(])", code):
        yield line[: match.start()] + line[match.end():]


def without_statement(line, code):
    statement = code.strip()
    if not statement.endswith(";") or re.match(r"(return|break|continue|\}|\))", statement):
        return
    balanced = all(statement.count(a) == statement.count(b) for a, b in ("()", "{}", "[]"))
    if balanced and STATEMENT.match(statement):
        yield line[: len(line) - len(line.lstrip())] + ";"


def changes_of(line, code):
    """Every small change of the line, by kind."""
    found = {"operator": [], "number": [], "word": [], "statement": list(without_statement(line, code)),
             "arguments": list(swapped(line, code)), "condition": list(negated(line, code))}
    for old, others in OPERATORS.items():
        for match in re.finditer(re.escape(old), code):
            found["operator"] += [line[: match.start()] + new + line[match.end():] for new in others]
    for match in re.finditer(r"\+\+|--", code):
        found["operator"].append(line[: match.start()] + ("--" if match.group() == "++" else "++") + line[match.end():])
    for match in NUMBER.finditer(code):
        found["number"] += [line[: match.start()] + new + line[match.end():] for new in other_numbers(match.group())]
    for old, new in WORDS.items():
        for match in re.finditer(rf"(?<![\w:]){re.escape(old)}\b", code):
            found["word"].append(line[: match.start()] + new + line[match.end():])
    return {kind: changes for kind, changes in found.items() if changes}


def mutable_lines(root, files):
    """(file, line, text, changes) of every line that can be changed."""
    found = []
    for file in files:
        text = (root / file).read_text(encoding="utf-8")
        for number, (line, code) in enumerate(zip(text.split("\n"), code_of(text)), 1):
            if not code.strip() or DULL.search(line):
                continue
            changes = changes_of(line, code)
            if changes:
                found.append((file, number, line, changes))
    return found


def draws(root, files, seed):
    """Mutants without end, no two alike: first a line is drawn, then a kind of change, then one of that kind."""
    rng, seen = random.Random(seed), set()
    lines = mutable_lines(root, files)
    most = sum(len(changes) for *_, kinds in lines for changes in kinds.values())
    misses = 0
    while len(seen) < most and misses < 100000:
        file, number, line, kinds = rng.choice(lines)
        mutant = Mutant(file, number, line, rng.choice(kinds[rng.choice(sorted(kinds))]))
        if mutant in seen:
            misses += 1
            continue
        seen.add(mutant)
        yield mutant
