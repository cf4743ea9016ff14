"""The stubs say what the compiled module has: every name, every argument with its type, which have defaults, what comes
back; and every name has a docstring."""

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


def bound_types(function):
    """{name: type}, and what comes back as 'return', of a bound function or of a property's getter."""
    first = function.__doc__.strip().splitlines()[0].replace("->", "=>")
    inside, back = re.match(r"\w*\((.*)\) => (.*)", first).groups()
    types = dict(part.split(" = ")[0].split(": ", 1) for part in split_arguments(inside) if ": " in part)
    return {name: text.replace("=>", "->") for name, text in {**types, "return": back}.items()}


def stub_types(function):
    """The same of a stub's."""
    given = function.args
    types = {arg.arg: ast.unparse(arg.annotation) for arg in given.args + given.kwonlyargs if arg.annotation}
    return {**types, "return": ast.unparse(function.returns)}


def array_agrees(element, stub, given):
    exact = {"float64": "_Floats", "bool": "NDArray[np.bool_]"}.get(element, f"NDArray[np.{element}]")
    return stub == exact or (given and stub == "ArrayLike") or (element is None and stub.startswith("NDArray["))


def agrees(bound, stub, given):
    """Whether the stub's type says what pybind11 takes (given) or hands back."""
    if optional := re.fullmatch(r"Optional\[(.*)\]", bound):
        return stub.endswith(" | None") and agrees(optional[1], stub.removesuffix(" | None"), given)
    if bound.startswith("vantage._core."):
        return (stub.removesuffix(" | None") if given else stub) == bound.removeprefix("vantage._core.")
    if array := re.match(r"numpy\.ndarray(?:\[(?:numpy\.)?(\w+).*\])?$", bound):
        return array_agrees(array[1], stub, given)
    if several := re.fullmatch(r"List\[(\w+)(\[3\])?\]", bound):
        return stub in ([f"Sequence[{several[1]}]", "ArrayLike"] if given else [f"list[{several[1]}]"])
    if bound in ("dict", "list", "tuple"):
        return stub.startswith((f"{bound}[", "Mapping[") if given else f"{bound}[")
    if bound == "str":
        return stub == "str" or stub.startswith("Literal[")
    return bound == "object" or stub == {"os.PathLike": "_Path"}.get(bound, bound)  # objects are looked at in C++


def stub_members(node):
    return {item.name: item for item in node.body if isinstance(item, ast.FunctionDef)}


class Stubs(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        tree = ast.parse(STUB.read_text())
        self.functions = {node.name: node for node in tree.body
                          if isinstance(node, ast.FunctionDef) and not node.name.startswith("_")}
        self.classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}

    def assert_types(self, node, function):
        bound = bound_types(function)
        for name, stub in stub_types(node).items():
            if name in bound:  # keywords of ** have none
                self.assertTrue(agrees(bound[name], stub, name != "return"), f"{name}: {bound[name]}, the stub: {stub}")

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
                self.assert_types(node, getattr(_core, name))

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
                    if member != "__len__":
                        self.assert_types(item, value.fget if isinstance(value, property) else getattr(bound, member))
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
