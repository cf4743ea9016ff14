"""The stubs say what the compiled module has: every name, every argument, which have defaults; and every name
has a docstring."""

import ast
import inspect
import re
import unittest
from pathlib import Path

import vantage
from vantage import _core

STUB = Path(vantage.__file__).with_name("_core.pyi")


def stub_arguments(function):
    """[(name, has a default)] of a stub's function, self left out; '**' stands for keywords."""
    given = function.args
    plain = [arg.arg for arg in given.args]
    rows = [(name, i >= len(plain) - len(given.defaults)) for i, name in enumerate(plain)]
    rows += [(arg.arg, default is not None) for arg, default in zip(given.kwonlyargs, given.kw_defaults)]
    rows += [("**", False)] if given.kwarg else []
    return [row for row in rows if row[0] != "self"]


def split_arguments(text):
    """At the commas that are in no bracket."""
    parts, depth, start = [], 0, 0
    for i, letter in enumerate(text):
        depth += (letter in "[({<") - (letter in "])}>")
        if letter == "," and depth == 0:
            parts.append(text[start:i])
            start = i + 1
    return [part.strip() for part in [*parts, text[start:]] if part.strip()]


def bound_arguments(function):
    """The same of a bound function, by the signature that begins its docstring."""
    first = function.__doc__.splitlines()[0].replace("->", "=>")
    inside = re.match(r"\w+\((.*)\) =>", first).group(1)
    rows = []
    for part in split_arguments(inside):
        if part in ("*", "/"):
            continue
        rows.append(("**", False) if part.startswith("**") else (part.split(":")[0], "=" in part.split(":", 1)[1]))
    return [row for row in rows if row[0] != "self"]


def stub_members(node):
    return {item.name: item for item in node.body if isinstance(item, ast.FunctionDef)}


class Stubs(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        tree = ast.parse(STUB.read_text())
        self.functions = {node.name: node for node in tree.body
                          if isinstance(node, ast.FunctionDef) and not node.name.startswith("_")}
        self.classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}

    def test_name_what_there_is(self):
        here = {name: value for name, value in vars(_core).items() if not name.startswith("_")}
        functions = {name for name, value in here.items() if inspect.isbuiltin(value)} | {"binary_entropy_bits"}
        classes = {name for name, value in here.items() if inspect.isclass(value)}
        self.assertEqual(functions, set(self.functions))
        self.assertEqual(classes, set(self.classes))

    def test_functions_take_what_they_say(self):
        for name, node in self.functions.items():
            if name == "binary_entropy_bits":  # of numpy's making
                continue
            with self.subTest(name):
                self.assertEqual(stub_arguments(node), bound_arguments(getattr(_core, name)))

    def test_classes_have_what_they_say(self):
        for name, node in self.classes.items():
            bound = getattr(_core, name)
            if issubclass(bound, Exception):
                self.assertEqual([base.id for base in node.bases], [base.__name__ for base in bound.__bases__])
                continue
            members = stub_members(node)
            here = {n for n in vars(bound) if not n.startswith("_") or n == "__len__"} | (
                {"__init__"} if "__init__" in vars(bound) and name not in ("Request", "Situation") else set())
            self.assertEqual(here, set(members), name)
            for member, item in members.items():
                value = inspect.getattr_static(bound, member)
                with self.subTest(f"{name}.{member}"):
                    is_property = any(isinstance(d, ast.Name) and d.id == "property" for d in item.decorator_list)
                    self.assertEqual(isinstance(value, property), is_property)
                    if not is_property and member != "__len__":
                        self.assertEqual(stub_arguments(item), bound_arguments(getattr(bound, member)))

    def test_every_public_name_is_documented(self):
        for name in vantage.__all__:
            value = getattr(vantage, name)
            if callable(value):
                self.assertGreater(len((value.__doc__ or "").strip()), 20, name)
            if inspect.isclass(value) and value.__module__.startswith("vantage"):
                for member, item in vars(value).items():
                    if not member.startswith("_") and (callable(item) or isinstance(item, property)):
                        self.assertTrue((item.__doc__ or "").strip() or member == "unwrapped", f"{name}.{member}")


if __name__ == "__main__":
    unittest.main()
