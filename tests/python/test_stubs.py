"""The type stubs name what the module has, no more and no less."""
import ast
import pathlib
import pydoc
from collections.abc import Mapping

import emmy
from emmy import _emmy

STUBS = ast.parse(pathlib.Path(emmy.__file__).with_name("_emmy.pyi").read_text())


def public(names):
    return {name for name in names if not name.startswith("_")}


def stub_classes():
    return [
        node for node in STUBS.body
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_")
    ]


def test_the_same_names():
    stubs = {
        node.name for node in STUBS.body
        if isinstance(node, (ast.ClassDef, ast.FunctionDef))
    }
    assert public(stubs) == public(vars(_emmy)) == set(emmy.__all__)


def test_the_same_members():
    for node in stub_classes():
        if node.name.endswith("Error"):
            continue
        stubs = {item.name for item in node.body
                 if isinstance(item, ast.FunctionDef)}
        if any(ast.unparse(base).startswith("Mapping") for base in node.bases):
            stubs |= set(dir(Mapping))
        assert public(stubs) == public(vars(getattr(_emmy, node.name))), node.name


def members():
    """Qualified name, node of the stubs and object of the module."""
    for node in STUBS.body:
        if not isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            continue
        if node.name.startswith("_"):
            continue
        yield node.name, node, getattr(_emmy, node.name)
        for item in getattr(node, "body", []):
            if isinstance(item, ast.FunctionDef):
                name = f"{node.name}.{item.name}"
                yield name, item, getattr(getattr(_emmy, node.name), item.name)


def test_help_says_what_the_stubs_say():
    texts = 0
    for name, node, item in members():
        text = ast.get_docstring(node)
        if text:
            assert text in (item.__doc__ or ""), name
            texts += 1
    assert texts > 20
    shown = pydoc.render_doc(emmy.Simulation, renderer=pydoc.plaintext)
    assert "one thread at a time" in shown and "Goes on without" in shown


def parameters(node):
    """Name, whether it needs its name, and default of each parameter."""
    a = node.args
    plain = [*a.posonlyargs, *a.args]
    defaults = [None] * (len(plain) - len(a.defaults)) + a.defaults
    found = [(x.arg, False, d) for x, d in zip(plain, defaults)]
    found += [(x.arg, True, d) for x, d in zip(a.kwonlyargs, a.kw_defaults)]
    return [(name, needs_name, d and ast.unparse(d))
            for name, needs_name, d in found if name not in ("self", "cls")]


def test_the_same_parameters():
    checked = 0
    for name, node, item in members():
        if not isinstance(node, ast.FunctionDef) or isinstance(item, property):
            continue
        # Of pybind11: the first line of the text.
        signature = (item.__doc__ or "").split("\n")[0]
        given = ast.parse(f"def {signature}: ...").body[0]
        if node.name.startswith("__") and node.name != "__init__":
            assert len(parameters(given)) == len(parameters(node)), name
        else:
            assert parameters(given) == parameters(node), name
        checked += 1
    assert checked >= 8


def test_types_are_shipped():
    assert pathlib.Path(emmy.__file__).with_name("py.typed").exists()
