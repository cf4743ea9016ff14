"""The changes that ./mutate makes, by known answers; what somebody has named stands in the sources."""

import subprocess
import sys
import unittest
from pathlib import Path

try:
    import yaml  # noqa: F401: by mutate
except ImportError as missing:
    raise SystemExit(f"SKIPPED: {missing}; apt-get install python3-yaml")

sys.path.insert(0, str(Path(__file__).parent))
import mutate  # noqa: E402
from mutations import changes_of, code_of, draws  # noqa: E402


def changes(line):
    return changes_of(line, code_of(line)[0])


class Changes(unittest.TestCase):
    def test_operators(self):
        self.assertEqual(changes("  x = a + b;")["operator"], ["  x = a - b;"])
        self.assertEqual(changes("  return a < b;")["operator"], ["  return a <= b;", "  return a > b;"])
        self.assertEqual(changes("  return a && b;")["operator"], ["  return a || b;"])

    def test_numbers(self):
        self.assertEqual(changes("  return 3;")["number"], ["  return 4;", "  return 2;"])
        self.assertEqual(changes("  return 0.5;")["number"], ["  return 1.0;", "  return 0.25;"])
        self.assertNotIn("number", changes("  return level2;"))

    def test_statements(self):
        self.assertEqual(changes("  observe(grid);")["statement"], ["  ;"])
        self.assertEqual(changes("  return f(grid);").get("statement"), None)

    def test_arguments(self):
        self.assertEqual(changes("  return f(a, b);")["arguments"], ["  return f(b, a);"])
        self.assertNotIn("arguments", changes("void f(int a, int b);"))

    def test_conditions(self):
        self.assertEqual(changes("  if (a) return;")["condition"], ["  if (!(a)) return;"])
        self.assertEqual(changes("  return !a;")["condition"], ["  return a;"])

    def test_strings_and_comments_stay(self):
        self.assertEqual(changes('  say("a + b");  // 1 + 1').get("operator"), None)
        self.assertEqual(changes('  say("a + b");  // 1 + 1').get("number"), None)


class Draws(unittest.TestCase):
    def test_are_of_their_seed(self):
        files = ["planners/swept_blocks.cpp", "src/core/rng.cpp"]

        def first(seed):
            return [mutant for mutant, _ in zip(draws(mutate.ROOT, files, seed), range(20))]

        self.assertEqual(first(1), first(1))
        self.assertNotEqual(first(1), first(2))
        self.assertEqual(len(set(first(1))), 20)

    def test_change_the_line_they_name(self):
        for mutant, _ in zip(draws(mutate.ROOT, ["src/core/rng.cpp"], 3), range(50)):
            line = (mutate.ROOT / mutant.file).read_text(encoding="utf-8").split("\n")[mutant.line - 1]
            self.assertEqual(line, mutant.old)
            self.assertNotEqual(line, mutant.new)


class CommandLine(unittest.TestCase):
    def test_paths_may_follow_the_seed(self):
        done = subprocess.run([sys.executable, Path(mutate.__file__), "5", "--seed", "2", "nowhere"],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("nowhere: no sources", done.stderr)


class Named(unittest.TestCase):
    def test_stand_in_the_sources(self):  # mutate.named() ends the program where one does not
        self.assertGreaterEqual(len(mutate.named()), 15)

    def test_equivalents_stand_in_the_sources(self):
        for key in mutate.equivalents():
            file, old, _ = key.split("\n")
            self.assertIn(old, (mutate.ROOT / file).read_text(encoding="utf-8"), key)


if __name__ == "__main__":
    unittest.main()
